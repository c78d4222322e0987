// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Sliders below the view: before and after, and time.
import type { App } from '../app';
import { h, icon } from '../dom';
import type { Structure } from '../format';

export function hasBefore(s: Structure): boolean {
  return (s.kind === 'planes' || s.kind === 'lines' || s.kind === 'boxes') && s.before !== undefined;
}

export function sliders(app: App): HTMLElement {
  const parts: HTMLElement[] = [];
  if (app.scenes.some((v) => v.model?.structures.some(hasBefore))) {
    const slider = h('input', { type: 'range', min: '0', max: '1', step: '0.01', 'aria-label': 'Before and after: from the free fit to the result', oninput: () => app.setBefore(Number(slider.value)) });
    const sync = () => (slider.value = String(app.before));
    app.on('before', sync);
    sync();
    parts.push(h('div', { class: 'card bar-slider', title: 'From the free fit of each plane to the result' },
      h('button', { type: 'button', class: 'link', onclick: () => app.setBefore(0) }, 'Free fit'), slider, h('button', { type: 'button', class: 'link', onclick: () => app.setBefore(1) }, 'Result')));
  }
  const range = app.timeRange;
  if (range) {
    const slider = h('input', { type: 'range', id: 'time', min: String(range.start), max: String(range.end), step: 'any', 'aria-label': 'Time in seconds', oninput: () => { app.setPlaying(false); app.setTime(Number(slider.value)); } });
    const text = h('output', { for: 'time' });
    const play = h('button', { type: 'button', class: 'tool', onclick: () => app.setPlaying(!app.playing) });
    const sync = () => {
      slider.value = String(app.time);
      text.textContent = `${app.time.toFixed(range.end - range.start < 5 ? 3 : 2)} s`;
      slider.setAttribute('aria-valuetext', text.textContent);
    };
    const state = () => {
      play.replaceChildren(icon(app.playing ? 'pause' : 'play'));
      const label = app.playing ? 'Pause (space)' : 'Play (space)';
      play.title = label;
      play.setAttribute('aria-label', label);
    };
    app.on('time', sync);
    app.on('playing', state);
    sync();
    state();
    parts.push(h('div', { class: 'card bar-slider time' }, play, slider, text));
  }
  return h('div', { class: 'sliders' }, ...parts);
}
