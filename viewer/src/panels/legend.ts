// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What the colours mean.
import type { App, SceneView } from '../app';
import { h, isRoomy, number } from '../dom';
import { kRelation, rangeOf } from '../layers/coloring';
import type { Layer } from '../layers/layer';
import { css, kNone, labelColor, relationColor, scalarColor } from '../palette';

const kMost = 10;

function entry(color: string, text: string): HTMLElement {
  return h('li', {}, h('i', { class: 'swatch', style: `background:${color}` }), text);
}

function legendOf(view: SceneView, layer: Layer): { key: string; element: HTMLElement } | null {
  const model = view.model!;
  if (layer.color === kRelation) {
    const names = ['selected', 'same direction', ...model.relationNames];
    return { key: kRelation, element: h('div', {}, h('h4', {}, 'Relation to the selection'),
      h('ul', {}, ...names.map((n) => entry(css(relationColor(model, n)), n)), entry(css(relationColor(model, undefined)), 'none'))) };
  }
  const choice = layer.choices().find((c) => c.id === layer.color);
  const q = choice?.quantity;
  if (!q || q.kind === 'color' || q.kind === 'vector') return null;
  const head = h('h4', {}, q.name, q.unit ? h('span', { class: 'unit' }, ` ${q.unit}`) : null);
  if (q.kind === 'scalar') {
    const [low, high] = rangeOf(model, q);
    const stops = Array.from({ length: 9 }, (_, i) => css(scalarColor(i / 8))).join(',');
    return { key: `${q.name} ${low} ${high}`, element: h('div', {}, head, h('div', { class: 'ramp', style: `background:linear-gradient(to right,${stops})` }),
      h('div', { class: 'ends' }, h('span', {}, number(low)), h('span', {}, number((low + high) / 2)), h('span', {}, number(high)))) };
  }
  const names = q.names ?? [];
  if (names.length === 0) {
    if (q.structure) return null;
    const values = new Set<number>();
    const all = model.stored(q.array);
    for (let i = 0; i < Math.min(all.length, 200000) && values.size < 400; ++i) values.add(all[i]! | 0);
    const sorted = [...values].filter((v) => v >= 0).sort((a, b) => a - b);
    if (sorted.length > kMost) return { key: q.name, element: h('div', {}, head, h('p', { class: 'quiet' }, `${sorted.length} labels, one colour each; eight hues, then lighter and darker ones`)) };
    return { key: q.name, element: h('div', {}, head, h('ul', {}, ...sorted.map((v) => entry(css(labelColor(v)), String(v))), values.has(-1) && entry(css(kNone), 'none'))) };
  }
  const named = names.map((n, i) => ({ n, i })).filter(({ n }) => n !== '');
  return { key: q.name, element: h('div', {}, head, h('ul', {}, ...named.slice(0, kMost).map(({ n, i }) => entry(css(labelColor(i)), n)),
    named.length > kMost && h('li', { class: 'quiet' }, `and ${named.length - kMost} more`))) };
}

export function legend(app: App, view: SceneView): HTMLElement {
  // Where there is room its heading is not needed; on a phone, upright or not, it is folded.
  const roomy = isRoomy();
  const body = h('div', { class: 'legend-body' });
  const card = h('details', { class: 'card legend', 'aria-label': 'Legend', open: roomy.matches }, h('summary', {}, 'Legend'), body);
  const draw = () => {
    const parts = new Map<string, HTMLElement>();
    for (const layer of view.viewport!.layers.values()) {
      if (!layer.visible) continue;
      const part = legendOf(view, layer);
      if (part) parts.set(part.key, part.element);
    }
    card.hidden = parts.size === 0;
    body.replaceChildren(...[...parts.values()].slice(0, 3));
  };
  roomy.addEventListener('change', () => (card.open = roomy.matches));
  let before = card.open;
  app.on('print', () => {
    if (app.printing) before = card.open;
    card.open = app.printing || before;
  });
  app.on('layers', draw);
  draw();
  return card;
}
