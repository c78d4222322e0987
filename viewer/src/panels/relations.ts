// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Graphs and spheres of directions of a scene.
import type { App, SceneView } from '../app';
import { h } from '../dom';
import { factsOf } from './facts';
import { graphPanel } from './graph';
import { spherePanel } from './sphere';

export function relationsPanel(app: App, view: SceneView): HTMLElement {
  const slot = h('div', { class: 'selected-slot' });
  const show = () => {
    const facts = factsOf(app, view);
    slot.replaceChildren(...(facts ? [facts] : [h('p', { class: 'quiet' }, 'Select a node, a disc on the sphere or anything in the view: what it is related to stays lit.')]));
  };
  app.on('selection', show, slot);
  show();
  const parts: HTMLElement[] = [];
  for (const s of view.model!.structures) {
    if (s.kind === 'graph') parts.push(graphPanel(app, view, s));
    if (s.kind === 'normals') parts.push(spherePanel(app, view, s));
  }
  return h('div', { class: 'panel-body' }, ...parts, slot);
}
