// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What elements are called, at their places in the picture.
import type { SceneView } from '../app';
import { h } from '../dom';

export function labelsOver(view: SceneView): HTMLElement[] {
  const viewport = view.viewport!;
  const labels = view.model!.structures.flatMap((structure) => (structure.labels ?? []).map((text, index) => ({ structure, index, element: h('div', { class: 'over', 'aria-hidden': 'true' }, text) })));
  if (labels.length === 0) return [];
  const place = () => {
    for (const { structure, index, element } of labels) {
      const layer = viewport.layers.get(structure.id);
      const at = layer?.visible ? layer.anchor(index) : null;
      const p = at && viewport.project(at);
      element.hidden = !p?.ahead;
      if (p) element.style.transform = `translate(${p.x.toFixed(1)}px, ${p.y.toFixed(1)}px) translate(-50%, -50%)`;
      const related = view.relations.get(structure.id);
      element.classList.toggle('away', view.selection !== null && !related?.has(index));
    }
  };
  viewport.onFrame(place);
  return labels.map((l) => l.element);
}
