// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Series of dots or lines over a common axis, with marks across, stretches that speak for what is selected, and a line where the time is.
import type { App, SceneView } from '../app';
import { h, number, s } from '../dom';
import type { Chart } from '../format';
import { css, labelColor } from '../palette';

const kWidth = 340, kHeight = 170, kLeft = 36, kRight = 16, kTop = 8, kBottom = 30;

/** About four round steps from 0 or low to high. */
export function ticksOf(low: number, high: number): number[] {
  const rough = Math.max(high - low, 1e-12) / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((k) => k * power >= rough) ?? 10);
  const out: number[] = [];
  for (let t = Math.ceil(low / step) * step; t <= high + 1e-9 * step; t += step) out.push(Number(t.toPrecision(12)));
  return out;
}

/** With gaps where there is no number. */
function linePath(xs: Float32Array, ys: Float32Array, x: (v: number) => number, y: (v: number) => number): string {
  let open = false;
  return Array.from(xs, (v, i) => {
    const there = Number.isFinite(ys[i]!);
    const step = there ? `${open ? 'L' : 'M'}${x(v).toFixed(1)} ${y(ys[i]!).toFixed(1)}` : '';
    open = there;
    return step;
  }).join('');
}

export function chartPanel(app: App, view: SceneView, chart: Chart): HTMLElement {
  const model = view.model!;
  const series = chart.series.map((c) => ({ ...c, xs: model.floats(c.x), ys: model.floats(c.y) }));
  const all = (pick: (c: (typeof series)[number]) => Float32Array) => series.flatMap((c) => [...pick(c)].filter(Number.isFinite));
  const marks = chart.marks ?? [];
  const spans = chart.spans ?? [];
  const xs = [...all((c) => c.xs), ...marks.map((m) => m.x), ...spans.flatMap((p) => [p.from, p.to])];
  const left = xs.reduce((a, b) => Math.min(a, b), Infinity), right = Math.max(left + 1e-9, xs.reduce((a, b) => Math.max(a, b), -Infinity));
  const high = Math.max(1e-9, chart.y.high ?? 0, all((c) => c.ys).reduce((a, b) => Math.max(a, b), 0)) * 1.05;
  const x = (v: number) => kLeft + ((v - left) / (right - left)) * (kWidth - kLeft - kRight);
  const y = (v: number) => kHeight - kBottom - (v / high) * (kHeight - kTop - kBottom);

  const axes = [
    ...ticksOf(0, high).flatMap((t) => [s('line', { x1: kLeft, x2: kWidth - kRight, y1: y(t), y2: y(t), class: 'grid' }), s('text', { x: kLeft - 5, y: y(t) + 3.5, 'text-anchor': 'end' }, number(t))]),
    ...ticksOf(left, right).map((t) => s('text', { x: x(t), y: kHeight - kBottom + 14, 'text-anchor': 'middle' }, number(t))),
    s('text', { x: kWidth - kRight, y: kHeight - 3, 'text-anchor': 'end' }, chart.x.name),
  ];
  const crosses = marks.map((m) => s('line', { x1: x(m.x), x2: x(m.x), y1: kTop, y2: kHeight - kBottom, class: 'mark' }, s('title', {}, `${m.name}: ${chart.x.name} ${number(m.x)}`)));
  // Stretches of a colour lie in a lane of their own.
  const colors = [...new Set(spans.map((p) => p.color))].sort((a, b) => a - b);
  const lane = (kHeight - kTop - kBottom) / Math.max(1, colors.length);
  const stretches = spans.map((p) => s('rect', { x: x(p.from).toFixed(1), width: Math.max(1.5, x(p.to) - x(p.from)).toFixed(1), y: (kTop + lane * colors.indexOf(p.color)).toFixed(1), height: lane.toFixed(1), fill: css(labelColor(p.color)), class: 'span' }, s('title', {}, p.name)));
  const dots = series.map((c) => {
    const color = css(labelColor(c.color));
    if (c.line) return s('path', { d: linePath(c.xs, c.ys, x, y), fill: 'none', stroke: color, 'stroke-width': 1.6 });
    return s('g', c.hollow ? { fill: 'none', stroke: color } : { fill: color }, ...[...c.xs].map((v, i) => s('circle', { cx: x(v).toFixed(1), cy: y(c.ys[i]!).toFixed(1), r: 2.2 })));
  });
  const cursor = s('line', { y1: kTop, y2: kHeight - kBottom, class: 'cursor' });
  const per = chart.x.seconds;
  const mark = () => {
    const own = model.spansFor(chart, view.selection);
    stretches.forEach((r, i) => r.classList.toggle('on', own.includes(spans[i]!)));
  };
  const sync = () => {
    const at = per ? app.time / per : NaN;
    cursor.setAttribute('visibility', at >= left && at <= right ? 'visible' : 'hidden');
    if (at >= left && at <= right) for (const end of ['x1', 'x2']) cursor.setAttribute(end, x(at).toFixed(1));
  };
  const drawing = s('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, class: 'chart', role: 'img', 'aria-label': `${chart.title}: ${chart.y.name} (${chart.y.unit ?? ''}) over ${chart.x.name}, at most ${number(high / 1.05)}` },
    ...axes, ...stretches, ...crosses, ...dots, cursor);
  if (per) {
    drawing.classList.add('seek');
    drawing.addEventListener('click', (e) => {
      const box = drawing.getBoundingClientRect();
      const at = ((e as MouseEvent).clientX - box.left) * (kWidth / box.width);
      app.setPlaying(false);
      app.setTime((left + ((at - kLeft) / (kWidth - kLeft - kRight)) * (right - left)) * per);
    });
    app.on('time', sync, drawing);
  }
  if (spans.length > 0) app.on('selection', mark, drawing);
  mark();
  sync();
  return h('section', { class: 'block' }, h('h3', {}, chart.title),
    h('p', { class: 'quiet chart-legend' }, `${chart.y.name}${chart.y.unit ? ` (${chart.y.unit})` : ''}`,
      ...series.map((c) => h('span', {}, h('i', { class: c.hollow ? 'ring' : 'dot', style: `--dot:${css(labelColor(c.color))}` }), c.name))),
    drawing);
}
