// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What elements are called, at their places in the picture.
import type { SceneView } from '../app';
import { h } from '../dom';

const kLetter = 6.4, kPadding = 14, kHeight = 19;  // px

export function labelsOver(view: SceneView): HTMLElement[] {
  const viewport = view.viewport!;
  const labels = view.model!.structures.flatMap((structure) => (structure.labels ?? []).map((text, index) => ({ structure, index, element: h('div', { class: 'over', 'aria-hidden': 'true' }, text) })));
  if (labels.length === 0) return [];
  const isChosen = (label: (typeof labels)[number]) => view.selection?.structure === label.structure.id && view.selection.index === label.index;
  // One that would lie on another is left out: what is selected comes first.
  const place = () => {
    const taken: [number, number, number][] = [];  // x and y of the middle, width
    for (const label of [...labels].sort((a, b) => Number(isChosen(b)) - Number(isChosen(a)))) {
      const { structure, index, element } = label;
      const layer = viewport.layers.get(structure.id);
      const at = layer?.visible ? layer.anchor(index) : null;
      const p = at && viewport.project(at);
      const width = kLetter * element.textContent!.length + kPadding;
      element.hidden = !p?.ahead || taken.some(([x, y, w]) => 2 * Math.abs(x - p.x) < width + w && Math.abs(y - p.y) < kHeight);
      if (!p || element.hidden) continue;
      taken.push([p.x, p.y, width]);
      element.style.transform = `translate(${p.x.toFixed(1)}px, ${p.y.toFixed(1)}px) translate(-50%, -50%)`;
      const related = view.relations.get(structure.id);
      element.classList.toggle('away', view.selection !== null && !related?.has(index));
    }
  };
  viewport.onFrame(place);
  return labels.map((l) => l.element);
}
