// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A table of what was found: sorted by any column, only the rows in sight are in the page.
import type { App, SceneView } from '../app';
import { h, number } from '../dom';
import type { Cell, Table } from '../format';

const kRow = 30;
const kSlack = 8;

function compare(a: Cell | undefined, b: Cell | undefined): number {
  if (a === b) return 0;
  if (a === null || a === undefined) return 1;
  if (b === null || b === undefined) return -1;
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return String(a).localeCompare(String(b), 'en', { numeric: true });
}

export function cellText(cell: Cell | undefined, digits?: number): string {
  if (cell === null || cell === undefined) return '–';
  return typeof cell === 'number' ? number(cell, digits) : cell;
}

export function tablePanel(app: App, view: SceneView, table: Table): HTMLElement {
  let sorted = -1, descending = false;
  const order = table.rows.map((_, i) => i);
  const numeric = table.columns.map((_, c) => table.rows.some((r) => typeof r[c] === 'number'));
  const body = h('tbody');
  const heads = table.columns.map((column, c) => h('th', { scope: 'col', 'aria-sort': 'none', class: numeric[c] ? 'right' : '' },
    h('button', { type: 'button', onclick: () => sortBy(c), title: `Sort by ${column.name}` }, column.name, column.unit ? h('span', { class: 'unit' }, ` ${column.unit}`) : null)));
  const scroller = h('div', { class: 'table-scroll', tabindex: '0', role: 'region', 'aria-label': `${table.title}, ${table.rows.length} rows${table.structure ? '; arrow keys select' : ''}` },
    h('table', { class: table.structure ? 'selectable' : '', 'aria-rowcount': table.rows.length + 1 }, h('thead', {}, h('tr', {}, ...heads)), body));
  scroller.style.setProperty('--rows', String(Math.min(table.rows.length, 14) + 1.3));

  const selectedRow = () => (view.selection && view.selection.structure === table.structure ? view.selection.index : -1);
  let drawn = '';
  function draw(force = false, all = false) {
    const first = all ? 0 : Math.max(0, Math.floor(scroller.scrollTop / kRow) - kSlack);
    const last = all ? order.length : Math.min(order.length, Math.ceil((scroller.scrollTop + (scroller.clientHeight || 600)) / kRow) + kSlack);
    const selected = selectedRow();
    const key = `${first} ${last} ${selected}`;
    if (!force && key === drawn) return;
    drawn = key;
    const related = view.relations.get(table.structure ?? '');
    const rows: HTMLElement[] = [];
    if (first > 0) rows.push(h('tr', { 'aria-hidden': 'true', style: `height:${first * kRow}px` }));
    for (let k = first; k < last; ++k) {
      const i = order[k]!;
      const relation = related?.get(i);
      rows.push(h('tr', { 'data-row': i, 'aria-rowindex': k + 2, 'aria-selected': i === selected ? 'true' : 'false', class: relation && i !== selected ? 'related' : '',
                          title: relation && i !== selected ? relation : undefined },
        ...table.columns.map((column, c) => h('td', { class: numeric[c] ? 'right' : '' }, cellText(table.rows[i]![c], column.digits)))));
    }
    if (last < order.length) rows.push(h('tr', { 'aria-hidden': 'true', style: `height:${(order.length - last) * kRow}px` }));
    body.replaceChildren(...rows);
  }
  function sortBy(c: number) {
    descending = sorted === c ? !descending : false;
    sorted = c;
    const sign = descending ? -1 : 1;
    order.sort((a, b) => {
      const x = table.rows[a]![c], y = table.rows[b]![c];
      // Empty cells stay last in both directions.
      if (x === null || y === null || x === undefined || y === undefined) return compare(x, y) || a - b;
      return sign * compare(x, y) || a - b;
    });
    heads.forEach((th, k) => th.setAttribute('aria-sort', k === c ? (descending ? 'descending' : 'ascending') : 'none'));
    draw(true);
  }
  function reveal() {
    const k = order.indexOf(selectedRow());
    if (k < 0) return;
    const top = k * kRow, room = scroller.clientHeight - kRow * 1.5;
    if (top < scroller.scrollTop || top > scroller.scrollTop + room) scroller.scrollTop = Math.max(0, top - room / 2);
  }
  const pick = (row: number) => void (table.structure && app.select({ structure: table.structure, index: row }, app.scenes.indexOf(view)));

  scroller.addEventListener('scroll', () => draw());
  body.addEventListener('click', (e) => {
    const row = (e.target as HTMLElement).closest('tr')?.dataset.row;
    if (row !== undefined) pick(Number(row));
  });
  body.addEventListener('pointerover', (e) => {
    const row = (e.target as HTMLElement).closest('tr')?.dataset.row;
    if (row !== undefined && table.structure) app.hover({ structure: table.structure, index: Number(row) });
  });
  body.addEventListener('pointerleave', () => app.hover(null));
  if (table.structure) scroller.addEventListener('keydown', (e) => {
    const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10, Home: -1e9, End: 1e9 }[e.key];
    if (step === undefined || (e.target as HTMLElement).tagName === 'BUTTON') return;
    e.preventDefault();
    e.stopPropagation();
    const at = order.indexOf(selectedRow());
    const to = at < 0 ? 0 : Math.min(order.length - 1, Math.max(0, at + step));
    if (order.length > 0) pick(order[to]!);
  });
  app.on('selection', () => {
    reveal();
    draw(true);
  }, scroller);
  draw(true);
  new ResizeObserver(() => draw()).observe(scroller);
  app.on('print', () => draw(true, app.printing), scroller);
  return h('section', { class: 'block' }, h('h3', {}, table.title, h('span', { class: 'count' }, String(table.rows.length))), scroller);
}
