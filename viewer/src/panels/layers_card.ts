// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Structures on and off, what they are coloured by, and the size of points.
import type { App, SceneView } from '../app';
import { grouped, h, icon } from '../dom';
import { PointsLayer } from '../layers/points';

export function layersCard(app: App, view: SceneView, open: boolean): HTMLElement {
  const model = view.model!, viewport = view.viewport!;
  const scene = app.scenes.indexOf(view);
  const rows: HTMLElement[] = [];
  const syncs: (() => void)[] = [];
  for (const structure of model.structures) {
    const layer = viewport.layers.get(structure.id);
    if (!layer || structure.kind === 'image') continue;
    const box = h('input', { type: 'checkbox', onchange: () => app.setLayer(structure.id, box.checked, scene) });
    const choices = layer.choices();
    const color = choices.length > 1
      ? h('select', { 'aria-label': `Colour ${structure.name} by`, onchange: (e: Event) => app.setColor(structure.id, (e.target as HTMLSelectElement).value, scene) },
          ...choices.map((c) => h('option', { value: c.id }, c.name)))
      : null;
    const sync = () => {
      box.checked = layer.visible;
      if (color) color.value = layer.color;
    };
    sync();
    syncs.push(sync);
    rows.push(h('div', { class: 'layer' }, h('label', { class: 'check' }, box, h('span', {}, structure.name), structure.kind === 'floor' ? null : h('span', { class: 'count' }, grouped(model.count(structure)))), color));
  }
  app.on('layers', () => syncs.forEach((f) => f()));
  const hasPoints = [...viewport.layers.values()].some((l) => l instanceof PointsLayer);
  const size = h('input', { type: 'range', min: '1', max: '8', step: '0.5', value: String(startSize(view)), oninput: () => (viewport.pointSize = Number(size.value)) });
  if (hasPoints) viewport.pointSize = startSize(view);
  return h('details', { class: 'card layers', open },
    h('summary', { title: 'Layers (L)' }, icon('layers'), h('span', {}, 'Layers')),
    h('div', { class: 'card-body' }, ...rows, hasPoints ? h('label', { class: 'slider' }, 'Point size', size) : null));
}

function startSize(view: SceneView): number {
  let n = 0;
  for (const l of view.viewport!.layers.values()) if (l instanceof PointsLayer) n += l.count;
  return n > 1e6 ? 1.5 : n > 1e5 ? 2 : n > 2e4 ? 2.5 : 3;
}
