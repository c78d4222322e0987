// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// How the result was made: command, times, energies, options, input.
import type { App, SceneView } from '../app';
import { h, number, optionText } from '../dom';

function bars(title: string, unit: string, values: Record<string, unknown> | undefined): HTMLElement | null {
  const entries = Object.entries(values ?? {}).filter((e): e is [string, number] => typeof e[1] === 'number');
  if (entries.length === 0) return null;
  const most = Math.max(...entries.map(([, v]) => Math.abs(v)), 1e-12);
  const sum = unit === 's' ? entries.reduce((a, [, v]) => a + v, 0) : null;
  return h('section', { class: 'block' }, h('h3', {}, title, sum !== null && h('span', { class: 'count' }, `${number(sum)} s`)),
    h('table', { class: 'bars' }, h('tbody', {}, ...entries.map(([name, v]) => h('tr', {}, h('th', { scope: 'row' }, name.replace(/_/g, ' ')),
      h('td', { class: 'extent' }, h('i', { style: `width:${((100 * Math.abs(v)) / most).toFixed(1)}%` })), h('td', { class: 'right' }, number(v) + (unit ? ` ${unit}` : '')))))));
}

async function copyText(text: string, button: HTMLButtonElement) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Without the permission: by way of a selected field.
    const field = h('textarea', { class: 'off-screen' });
    field.value = text;
    document.body.append(field);
    field.select();
    document.execCommand('copy');
    field.remove();
  }
  const before = button.textContent;
  button.textContent = 'Copied';
  window.setTimeout(() => (button.textContent = before), 1500);
}

export function madePanel(_app: App, view: SceneView): HTMLElement {
  const header = view.model!.header;
  const { summary, options, input, command } = header;
  const copy = h('button', { type: 'button', class: 'button' }, 'Copy');
  copy.addEventListener('click', () => void copyText(command ?? '', copy));
  return h('div', { class: 'panel-body' },
    command ? h('section', { class: 'block' }, h('h3', {}, 'The same again'), h('div', { class: 'command' }, h('code', { tabindex: '0' }, command), copy)) : null,
    bars('Time', 's', summary?.seconds),
    bars('Energy', '', summary?.energy),
    summary?.counts && Object.keys(summary.counts).length > 0
      ? h('section', { class: 'block' }, h('h3', {}, 'Counts'), h('dl', {}, ...Object.entries(summary.counts).flatMap(([n, v]) => [h('dt', {}, n.replace(/_/g, ' ')), h('dd', {}, typeof v === 'number' ? number(v) : String(v))])))
      : null,
    options?.length
      ? h('section', { class: 'block' }, h('h3', {}, 'Options'), h('ul', { class: 'options' }, ...options.map((o) => h('li', {},
          h('div', {}, h('code', {}, o.name), h('b', {}, optionText(o.value, o.unit))),
          o.help ? h('p', { class: 'quiet' }, o.help) : null))))
      : null,
    h('section', { class: 'block' }, h('h3', {}, 'Input'), h('dl', {},
      ...(input?.path ? [h('dt', {}, 'file'), h('dd', {}, input.path)] : []),
      ...(input?.sha256 ? [h('dt', {}, 'SHA-256'), h('dd', { class: 'hash' }, input.sha256)] : []),
      ...(header.offset?.some((x) => x !== 0) ? [h('dt', {}, 'offset'), h('dd', {}, `${header.offset.map((x) => number(x)).join(', ')} m`)] : []),
      h('dt', {}, 'made by'), h('dd', {}, `unseen ${header.version ?? ''}`))));
}
