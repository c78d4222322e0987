// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What is known about the selected element, and what it is related to.
import type { App, SceneView } from '../app';
import { h, number } from '../dom';
import type { Selection } from '../model';
import { css, relationColor } from '../palette';
import { cellText } from './table';

export function nameIn(view: SceneView, selection: Selection): string {
  const model = view.model!;
  const table = model.table(selection.structure);
  const tag = table?.columns.findIndex((c) => /^(tag|name|class|kind|category)$/i.test(c.name)) ?? -1;
  const text = tag > 0 || !model.givenName(selection) ? table?.rows[selection.index]?.[tag] : undefined;
  return model.nameOf(selection) + (text ? ` · ${text}` : '');
}

const kMostChips = 24;

export function factsOf(app: App, view: SceneView): HTMLElement | null {
  const { selection, model } = view;
  if (!selection || !model) return null;
  const structure = model.get(selection.structure)!;
  const list = h('dl');
  const add = (name: string, value: string) => list.append(h('dt', {}, name), h('dd', {}, value));
  const table = model.table(selection.structure);
  const row = table?.rows[selection.index];
  if (table && row) table.columns.forEach((c, k) => add(c.name, cellText(row[k], c.digits) + (c.unit && row[k] !== null && row[k] !== '' ? ` ${c.unit}` : '')));
  else {
    for (const q of structure.quantities ?? []) {
      if (q.array.count <= selection.index) continue;
      if (q.kind === 'label') {
        const label = model.stored(q.array)[selection.index]! | 0;
        add(q.name, label < 0 ? 'none' : (q.names?.[label] ?? String(label)));
      } else if (q.kind === 'scalar') add(q.name, number(model.floats(q.array)[selection.index]!) + (q.unit ? ` ${q.unit}` : ''));
    }
  }

  // Grouped by the name of the relation.
  const groups = new Map<string, Selection[]>();
  for (const [id, map] of view.relations) {
    const related = model.get(id);
    if (related?.kind === 'normals') continue;
    for (const [index, name] of map) {
      if (id === selection.structure && index === selection.index) continue;
      // A node says it all for itself only where no elements do, as what carries boxes and is no box.
      if (related?.kind === 'graph' && structure.kind !== 'graph' && (!related.elements || related.elements.of_node[index]?.length)) continue;
      const label = name === 'selected' ? 'stands for' : name;
      groups.set(label, [...(groups.get(label) ?? []), { structure: id, index }]);
    }
  }
  const related = [...groups].map(([name, members]) => h('div', { class: 'relation' },
    h('span', { class: 'relation-name' }, h('i', { class: 'swatch', style: `background:${css(relationColor(model, name === 'stands for' ? 'selected' : name))}` }), name, h('span', { class: 'count' }, String(members.length))),
    h('div', { class: 'chips' },
      ...members.slice(0, kMostChips).map((m) => h('button', { type: 'button', class: 'chip', title: nameIn(view, m), onclick: () => app.select(m, app.scenes.indexOf(view)) },
        model.get(m.structure)!.kind === 'graph' ? model.nameOf(m) : (model.givenName(m) ?? String(m.index)))),
      members.length > kMostChips && h('span', { class: 'quiet' }, `and ${members.length - kMostChips} more`))));
  return h('section', { class: 'selection', 'aria-label': 'Selected' },
    h('header', {}, h('h3', {}, nameIn(view, selection)),
      h('button', { type: 'button', class: 'link', title: 'Clear the selection (Esc)', onclick: () => app.select(null, app.scenes.indexOf(view)) }, 'Clear')),
    list, ...related);
}
