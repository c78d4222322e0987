// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Shortcuts of the whole page.
import type { App } from './app';
import { exportPng } from './panels/picture';

export function addKeyboard(app: App, help: HTMLDialogElement) {
  const click = (selector: string) => document.querySelector<HTMLElement>(selector)?.click();
  const keys: Record<string, () => void> = {
    f: () => app.fit(),
    1: () => app.view('perspective'),
    2: () => app.view('top'),
    3: () => app.view('front'),
    4: () => app.view('side'),
    5: () => app.camera && app.lookThrough(app.camera),
    o: () => app.setOrtho(!app.rig.ortho),
    w: () => app.setFading(!app.fading),
    s: () => click('#tool-section'),
    d: () => app.setDark(!app.dark),
    l: () => click('.stage .layers summary'),
    b: () => app.setBefore(app.before > 0.5 ? 0 : 1),
    p: () => app.viewports.length > 0 && void exportPng(app),
    '?': () => help.showModal(),
    '+': () => app.rig.zoom(0.85),
    '=': () => app.rig.zoom(0.85),
    '-': () => app.rig.zoom(1 / 0.85),
    Escape: () => {
      const popover = document.querySelector<HTMLElement>('.popover:not([hidden])');
      if (popover) popover.dispatchEvent(new Event('close'));
      else app.select(null);
    },
  };
  const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  document.addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || help.open) return;
    const target = e.target as HTMLElement;
    const range = target instanceof HTMLInputElement && target.type === 'range';
    if (target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && !range && target.type !== 'checkbox')) return;
    const onControl = range || target.closest('button, summary, label, input') !== null;
    if (e.key === ' ') {
      if (onControl && !range) return;
      if (app.timeRange) {
        e.preventDefault();
        app.setPlaying(!app.playing);
      }
      return;
    }
    const arrow = arrows[e.key];
    if (arrow) {
      if (range || target.closest('.side, [role=toolbar]')) return;
      e.preventDefault();
      const time = app.timeRange;
      for (const v of app.viewports) v.moving();
      if (time && arrow[0] !== 0 && !e.shiftKey) {
        app.setPlaying(false);
        app.setTime(app.time + arrow[0] * time.step);
      } else if (e.shiftKey || app.rig.flat) app.rig.pan(-arrow[0] * 0.12, arrow[1] * 0.12);
      else app.rig.orbit(-arrow[0] * 0.12, arrow[1] * 0.08);
      return;
    }
    const action = keys[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (action) {
      e.preventDefault();
      action();
    }
  });
}
