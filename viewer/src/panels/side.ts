// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The panel beside the view: tabs for what was found, relations, and how it was made.
import type { App } from '../app';
import { h } from '../dom';
import { foundPanel } from './found';
import { madePanel } from './made';
import { relationsPanel } from './relations';

const kTabs = ['Found', 'Relations', 'How it was made'] as const;

export function sidePanel(app: App): HTMLElement {
  let tab: (typeof kTabs)[number] = 'Found';
  const body = h('div', { class: 'side-body', role: 'tabpanel', id: 'side-body', tabindex: '-1' });
  const tabs = kTabs.map((name) => h('button', { type: 'button', role: 'tab', id: `tab-${name.replace(/ /g, '-')}`, 'aria-controls': 'side-body', onclick: () => show(name) }, name));
  const list = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Panels' }, ...tabs);
  const scenes = h('div', { class: 'segments', role: 'group', 'aria-label': 'Scene of the panels' });

  function show(name: (typeof kTabs)[number]) {
    tab = name;
    draw();
  }
  function draw() {
    const view = app.current;
    const hasRelations = view.model?.structures.some((s) => s.kind === 'graph' || s.kind === 'normals') ?? false;
    if (tab === 'Relations' && !hasRelations) tab = 'Found';
    kTabs.forEach((name, k) => {
      const on = name === tab;
      tabs[k]!.setAttribute('aria-selected', String(on));
      tabs[k]!.tabIndex = on ? 0 : -1;
      if (name === 'Relations') tabs[k]!.hidden = !hasRelations;
    });
    body.setAttribute('aria-labelledby', tabs[kTabs.indexOf(tab)]!.id);
    scenes.hidden = app.scenes.length < 2;
    scenes.replaceChildren(...app.scenes.map((s, i) => h('button', { type: 'button', 'aria-pressed': String(i === app.active), onclick: () => app.activate(i) },
      h('b', {}, 'AB'[i] ?? String(i + 1)), ` ${app.titleOf(s)}`)));
    if (!view.model) body.replaceChildren(h('div', { class: 'panel-body' }, h('p', { class: 'note warning' }, view.error ?? 'There is no scene.')));
    else body.replaceChildren(tab === 'Found' ? foundPanel(app, view) : tab === 'Relations' ? relationsPanel(app, view) : madePanel(app, view));
    body.scrollTop = 0;
  }
  list.addEventListener('keydown', (e) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (!step) return;
    e.preventDefault();
    e.stopPropagation();
    const open = kTabs.filter((_, k) => !tabs[k]!.hidden);
    const next = open[(open.indexOf(tab) + step + open.length) % open.length]!;
    show(next);
    tabs[kTabs.indexOf(next)]!.focus();
  });
  // The edge towards the picture can be moved.
  const width = (px: number) => document.documentElement.style.setProperty('--side', `${Math.round(Math.min(Math.max(300, px), 0.7 * innerWidth))}px`);
  const edge = h('div', { class: 'side-edge', role: 'separator', 'aria-orientation': 'vertical', 'aria-label': 'Width of the panel', tabindex: '0', title: 'Drag to widen' });
  edge.addEventListener('pointerdown', (e) => {
    if (e.button !== 0) return;
    e.preventDefault();
    edge.setPointerCapture(e.pointerId);
  });
  edge.addEventListener('pointermove', (e) => {
    if (edge.hasPointerCapture(e.pointerId)) width(innerWidth - e.clientX);
  });
  edge.addEventListener('keydown', (e) => {
    const step = { ArrowLeft: 40, ArrowRight: -40 }[e.key];
    if (!step) return;
    e.preventDefault();
    e.stopPropagation();
    width(edge.parentElement!.getBoundingClientRect().width + step);
  });
  app.on('active', draw);
  queueMicrotask(draw);
  return h('aside', { class: 'side', 'aria-label': 'Result' }, edge, scenes, list, body);
}
