// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What was found: facts, warnings, the selected element and the tables.
import type { App, SceneView } from '../app';
import { grouped, h } from '../dom';
import { chartPanel } from './chart';
import { factsOf } from './facts';
import { tablePanel } from './table';

export function foundPanel(app: App, view: SceneView): HTMLElement {
  const { header } = view.model!;
  const { summary, thinned } = header;
  const selected = h('div', { class: 'selected-slot' });
  const show = () => {
    const facts = factsOf(app, view);
    selected.replaceChildren(...(facts ? [facts] : []));
    if (facts && matchMedia('(max-width: 799px)').matches) selected.closest('.side-body')?.scrollTo({ top: 0 });
  };
  app.on('selection', show, selected);
  queueMicrotask(show);
  const notes = [...(summary?.status && summary.status !== 'solved' ? [header.verdict ?? `Status: ${summary.status.replace(/_/g, ' ')}`] : []), ...(summary?.warnings ?? [])];
  return h('div', { class: 'panel-body' },
    selected,
    header.about ? h('p', { class: 'quiet' }, header.about) : null,
    header.facts?.length ? h('dl', { class: 'facts' }, ...header.facts.map((f) => h('div', f.help ? { title: f.help } : {}, h('dt', { class: f.help ? 'helped' : '' }, f.name), h('dd', {}, f.value)))) : null,
    ...notes.map((n) => h('p', { class: 'note warning' }, n)),
    thinned ? h('p', { class: 'note' }, `The page shows ${grouped(thinned.shown)} of ${grouped(thinned.of)} points; the result is of all.`) : null,
    ...(header.charts ?? []).map((c) => chartPanel(app, view, c)),
    ...(header.tables ?? []).map((t) => tablePanel(app, view, t)));
}
