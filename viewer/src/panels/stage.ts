// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// One scene of the page: its picture with the cards that lie on it.
import type { App, SceneView } from '../app';
import { h, isRoomy } from '../dom';
import { imageCard } from './image_card';
import { labelsOver } from './labels';
import { layersCard } from './layers_card';
import { legend } from './legend';

export function stage(app: App, view: SceneView, index: number): HTMLElement {
  const label = app.scenes.length > 1 ? h('div', { class: 'stage-label' }, h('b', {}, 'AB'[index] ?? ''), app.titleOf(view)) : null;
  if (view.error && !view.viewport)
    return h('div', { class: 'stage' }, h('div', { class: 'fatal', role: 'alert' }, h('p', {}, view.error)));
  const { canvas } = view.viewport!;
  const structures = view.model!.structures.map((s) => s.name.toLowerCase()).join(', ');
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', `${view.model!.header.title}: ${structures}. The table lists what was found. Press ? for shortcuts.`);
  canvas.addEventListener('focus', () => app.activate(index));
  const box = h('div', { class: 'stage' }, canvas, label, ...labelsOver(view),
    h('div', { class: 'cards left' }, layersCard(app, view, isRoomy().matches && app.scenes.length < 2), legend(app, view)), imageCard(app, view));
  const mark = () => box.classList.toggle('active', app.scenes.length > 1 && app.active === index);
  app.on('active', mark);
  mark();
  new ResizeObserver(() => view.viewport!.resize(box.clientWidth, box.clientHeight)).observe(box);
  return box;
}
