// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The list of shortcuts.
import type { App } from '../app';
import { h, iconButton } from '../dom';
import { hasBefore } from './sliders';

export function helpDialog(app: App): HTMLDialogElement {
  const keys: [string, string][] = [
    ['Drag', app.rig.flat ? 'move the drawing' : 'turn the view; with Shift or the right button: move it'],
    ['Wheel, pinch, + −', 'nearer and farther'],
    ['Click, tap', 'select; Esc clears'],
    ['F', 'fit the scene'],
    ...(app.rig.flat ? [] : [['1 2 3 4', 'from a corner, above, front, side'], ...(app.camera ? [['5', 'through the camera']] : []), ['O', 'perspective or parallel projection'], ['W', 'fade walls in front'], ['S', 'section plane']] as [string, string][]),
    ...(app.timeRange ? [['Space', 'play and pause'], ['← →', 'frame by frame']] as [string, string][] : [['Arrows', 'turn the view (Shift: move it)']] as [string, string][]),
    ...(app.scenes.some((v) => v.model?.structures.some(hasBefore)) ? [['B', 'between free fit and result']] as [string, string][] : []),
    ['L', 'layers'], ['D', 'light or dark'], ['P', 'export the picture'], ['Tab', 'through all controls; arrow keys within tables, tabs, graph and sphere'],
  ];
  const dialog = h('dialog', { class: 'help', 'aria-labelledby': 'help-title' });
  dialog.append(h('header', {}, h('h2', { id: 'help-title' }, 'Shortcuts'), iconButton('close', 'Close (Esc)', () => dialog.close())),
    h('dl', {}, ...keys.flatMap(([k, what]) => [h('dt', {}, h('kbd', {}, k)), h('dd', {}, what)])));
  dialog.addEventListener('click', (e) => e.target === dialog && dialog.close());
  return dialog;
}
