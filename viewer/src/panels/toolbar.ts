// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The bar above the view: title, views, section plane, pictures, theme.
import type { App, Axis } from '../app';
import { h, icon, iconButton, number } from '../dom';
import { copyPicture, exportPng } from './picture';

function sectionPopover(app: App): HTMLElement {
  const slider = h('input', { type: 'range', min: '0', max: '1000', step: '1', 'aria-label': 'Place of the section plane' });
  const value = h('output', { class: 'quiet' });
  const close = h('button', { type: 'button', class: 'link', title: 'Esc', onclick: () => close.parentElement!.dispatchEvent(new Event('close')) }, 'Close, keep the cut');
  const axes = (['off', 'x', 'y', 'z'] as const).map((a) => h('button', { type: 'button', 'aria-pressed': 'false', onclick: () => app.setSection(a === 'off' ? null : a) }, a === 'off' ? 'Off' : a));
  const flip = h('label', { class: 'check' }, h('input', { type: 'checkbox', onchange: (e: Event) => app.setSection(app.section.axis, app.section.value, (e.target as HTMLInputElement).checked) }), 'show the other side');
  const range = (axis: Axis): [number, number] => [app.box.min[axis], app.box.max[axis]];
  slider.addEventListener('input', () => {
    const { axis } = app.section;
    if (!axis) return;
    const [low, high] = range(axis);
    app.setSection(axis, low + (Number(slider.value) / 1000) * (high - low));
  });
  const show = () => {
    const { axis, value: at } = app.section;
    axes.forEach((b, k) => b.setAttribute('aria-pressed', String((['off', 'x', 'y', 'z'][k] === (axis ?? 'off')))));
    slider.disabled = !axis;
    if (!axis) value.textContent = 'Cuts the scene open along an axis.';
    else {
      const [low, high] = range(axis);
      slider.value = String(Math.round(((at - low) / (high - low || 1)) * 1000));
      value.textContent = `${axis} = ${number(at + (app.viewports[0]?.model.header.offset?.['xyz'.indexOf(axis)] ?? 0), 2)}${app.rig.flat ? '' : ' m'}`;
    }
  };
  app.on('section', show);
  show();
  return h('div', { class: 'popover', id: 'section-popover', hidden: true, role: 'group', 'aria-label': 'Section plane' }, h('div', { class: 'segments' }, ...axes), slider, value, flip, close);
}

export function toolbar(app: App, title: string, help: () => void): HTMLElement {
  const flat = app.rig.flat;
  const popover = sectionPopover(app);
  const has3d = app.viewports.length > 0;
  const open = (on: boolean) => {
    popover.hidden = !on;
    section.setAttribute('aria-expanded', String(on));
  };
  // The cut ends with the box, unless that is closed from within or by Escape.
  const section = iconButton('section', 'Section plane (S)', () => {
    open(popover.hidden);
    if (popover.hidden) app.setSection(null);
    else if (!app.section.axis) app.setSection('z');
  }, { 'aria-expanded': 'false', 'aria-controls': 'section-popover', id: 'tool-section' });
  const ortho = h('button', { type: 'button', class: 'tool text', title: 'Perspective or parallel projection (O)', onclick: () => app.setOrtho(!app.rig.ortho) });
  const walls = iconButton('walls', 'Fade walls between camera and inside (W)', () => app.setFading(!app.fading), { id: 'tool-walls' });
  const theme = iconButton('theme', 'Light or dark (D)', () => app.setDark(!app.dark));
  const show = () => {
    ortho.textContent = app.rig.ortho ? 'Parallel' : 'Perspective';
    ortho.setAttribute('aria-pressed', String(app.rig.ortho));
    walls.setAttribute('aria-pressed', String(app.fading));
    section.classList.toggle('on', app.section.axis !== null);
    theme.setAttribute('aria-pressed', String(app.dark));
  };
  app.on(['view', 'section', 'theme'], show);
  popover.addEventListener('close', () => open(false));
  show();
  const gap = () => h('span', { class: 'gap', 'aria-hidden': 'true' });
  return h('header', { class: 'bar' },
    h('h1', { title }, h('span', { class: 'brand' }, 'unseen'), h('span', { class: 'title' }, title)),
    h('div', { class: 'tools', role: 'toolbar', 'aria-label': 'View' },
      ...(has3d ? [
        iconButton('fit', 'Fit the scene (F)', () => app.fit()),
        ...(flat ? [] : [iconButton('cube', 'From a corner (1)', () => app.view('perspective')), iconButton('top', 'From above (2)', () => app.view('top')),
                         iconButton('front', 'From the front (3)', () => app.view('front')), iconButton('side', 'From the side (4)', () => app.view('side')),
                         app.camera && iconButton('camera', 'Through the camera (5)', () => app.lookThrough(app.camera!)), ortho, gap(), walls, section, popover]),
        gap(),
        iconButton('copy', 'Copy the picture', () => void copyPicture(app)), iconButton('download', 'Export the picture as PNG (P)', () => void exportPng(app)),
      ] : []),
      theme, h('button', { type: 'button', class: 'tool', title: 'Shortcuts (?)', 'aria-label': 'Shortcuts', onclick: help }, icon('help'))));
}
