// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Says things to people who do not see the picture; with `show`, to all.
import { h } from '../dom';

const region = h('div', { class: 'announce', role: 'status', 'aria-live': 'polite' });
let timer = 0;

export function announceRegion(): HTMLElement {
  return region;
}

export function announce(text: string, show = false) {
  region.textContent = text;
  region.classList.toggle('show', show);
  window.clearTimeout(timer);
  timer = window.setTimeout(() => region.classList.remove('show'), 2500);
}
