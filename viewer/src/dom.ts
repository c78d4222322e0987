// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Elements in one line.

type Child = Node | string | null | undefined | false;
type Props = Record<string, unknown>;

function fill<T extends Element>(element: T, props: Props, children: Child[]): T {
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value as EventListener);
    else element.setAttribute(key, value === true ? '' : String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return fill(document.createElement(tag), props, children);
}

export function s<K extends keyof SVGElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), props, children);
}

const kIcons: Record<string, string> = {
  fit: 'M4 9V5a1 1 0 0 1 1-1h4M15 4h4a1 1 0 0 1 1 1v4M20 15v4a1 1 0 0 1-1 1h-4M9 20H5a1 1 0 0 1-1-1v-4',
  cube: 'M12 3 4 7.5v9L12 21l8-4.5v-9L12 3ZM4 7.5l8 4.5 8-4.5M12 12v9',
  top: 'M12 4 3 9l9 5 9-5-9-5ZM12 14v6M9 17.5l3 3 3-3',
  front: 'M4 6h16v12H4zM4 18l4-5 4 3 3-4 5 6',
  side: 'M9 5h10v14H9zM3 12h5M5.5 9.5 8 12l-2.500 2.500',
  section: 'M4 4h16v16H4zM12 2v20M14.500 8l3 0M14.500 12l3 0M14.500 16l3 0',
  walls: 'M4 20V8l8-4 8 4v12M4 20h16M9 20v-7h6v7',
  copy: 'M9 9h11v11H9zM5 15H4V4h11v1',
  download: 'M12 4v11M7.500 11 12 15.500 16.500 11M5 20h14',
  theme: 'M12 4a8 8 0 1 0 0 16V4Z M12 4a8 8 0 0 1 0 16',
  help: 'M9.200 9a2.900 2.900 0 1 1 4.200 2.600c-.9.500-1.400 1.100-1.400 2.100M12 17v.2',
  play: 'M8 5v14l11-7L8 5Z',
  pause: 'M8 5v14M16 5v14',
  close: 'M6 6l12 12M18 6 6 18',
  layers: 'M12 4 3 9l9 5 9-5-9-5ZM4 13.500l8 4.500 8-4.500',
  camera: 'M4 8h3l2-3h6l2 3h3v11H4zM12 16.500a3.500 3.500 0 1 0 0-7 3.500 3.500 0 0 0 0 7Z',
};

/** Whether cards may lie open on the picture: not on a phone, upright or not. */
export function isRoomy(): MediaQueryList {
  return matchMedia('(min-width: 800px) and (min-height: 500px)');
}

export function icon(name: string): SVGElement {
  return s('svg', { viewBox: '0 0 24 24', class: 'icon', 'aria-hidden': 'true' }, s('path', { d: kIcons[name] ?? '' }));
}

export function iconButton(name: string, label: string, onclick: () => void, props: Props = {}): HTMLButtonElement {
  return h('button', { type: 'button', class: 'tool', title: label, 'aria-label': label, onclick, ...props }, icon(name));
}

export function number(value: number, digits?: number): string {
  if (!Number.isFinite(value)) return '–';
  if (digits !== undefined) {
    const text = value.toFixed(digits);
    return Number(text) === 0 ? text.replace('-', '') : text;
  }
  if (Number.isInteger(value)) return grouped(value);
  return String(Number(value.toPrecision(4)));
}

/** 1 234 567 with thin spaces. */
export function grouped(value: number): string {
  return Math.round(value).toString().replace(/\B(?=(\d{3})+(?!\d))/g, '\u2009');
}

/** The value of an option; a share has the unit 1, which is none to read. */
export function optionText(value: unknown, unit?: string): string {
  if (value === null || value === undefined || value === '') return 'not set';
  return (typeof value === 'object' ? JSON.stringify(value) : String(value)) + (unit && unit !== '1' ? ` ${unit}` : '');
}
