// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A graph as a drawing: nodes are directions, boxes or people; a click selects what a node stands for.
import type { App, SceneView } from '../app';
import { h, s } from '../dom';
import type { GraphStructure } from '../format';
import type { Model } from '../model';
import { css, kNone, labelColor, relationColor, type Rgb } from '../palette';
import { layoutOf } from './layout';

/** The colour of what a node stands for: by a quantity of its own, else the frame (or first label) of its elements. */
export function nodeColors(model: Model, structure: { id: string; elements?: { structure: string; of_node: number[][] } }): (node: number) => Rgb {
  const own = model.get(structure.id)?.quantities?.find((q) => q.kind === 'label');
  if (own) {
    const values = model.stored(own.array);
    return (i) => labelColor(values[i]! | 0);
  }
  const of = model.get(structure.elements?.structure);
  const q = of?.quantities?.find((x) => x.id === 'frame' && x.kind === 'label') ?? of?.quantities?.find((x) => x.kind === 'label');
  if (!structure.elements || !q) return () => [86, 130, 170];
  const values = model.stored(q.array);
  return (i) => {
    const first = structure.elements!.of_node[i]?.[0];
    return first === undefined ? kNone : labelColor(values[first]! | 0);
  };
}

/** The first of some places along an edge where a text lies on no other, or the middle. A box is x, y (its middle), width, height. */
export function placeAlong(from: [number, number], to: [number, number], width: number, height: number, taken: [number, number, number, number][]): [number, number] {
  const at = (t: number): [number, number] => [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
  const free = ([x, y]: [number, number]) => taken.every(([u, v, w, h]) => 2 * Math.abs(x - u) >= width + w || 2 * Math.abs(y - v) >= height + h);
  const place = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8].map(at).find(free) ?? at(0.5);
  taken.push([...place, width, height]);
  return place;
}

const kWidth = 340;
const kLetter = 5.6, kLine = 12;  // of a label
const kMostLabels = 40;

export function graphPanel(app: App, view: SceneView, graph: GraphStructure): HTMLElement {
  const model = view.model!;
  const n = graph.node_names.length;
  const edges = model.stored(graph.edges);
  const height = n > 60 ? kWidth : 260;
  const pad = 26;
  const place = layoutOf(n, edges, graph.edges.count);
  const x = (i: number) => pad + ((place[2 * i]! + 1) / 2) * (kWidth - 2 * pad);
  const y = (i: number) => pad + ((place[2 * i + 1]! + 1) / 2) * (height - 2 * pad);
  const color = nodeColors(model, graph);
  const sizes = graph.node_names.map((_, i) => graph.elements?.of_node[i]?.length ?? 1);
  const base = n > 150 ? 3 : n > 50 ? 4.5 : 7;
  const most = Math.max(...sizes, 1);
  const scene = app.scenes.indexOf(view);
  const labelOf = (i: number) => (n <= kMostLabels ? graph.node_names[i]!.replace(/^direction /, '') : '');

  const lines: SVGLineElement[] = [];
  for (let e = 0; e < graph.edges.count; ++e) {
    const a = edges[2 * e]!, b = edges[2 * e + 1]!;
    lines.push(s('line', { x1: x(a), y1: y(a), x2: x(b), y2: y(b), class: 'edge' }, s('title', {}, `${graph.node_names[a]} – ${graph.node_names[b]}: ${graph.edge_names[e] ?? 'related'}`)));
  }
  const edgeLabels = s('g', { class: 'edge-labels' });
  const nodes = graph.node_names.map((name, i) => {
    const r = base * (0.8 + 0.9 * Math.sqrt(sizes[i]! / most));
    return s('g', { class: 'node', transform: `translate(${x(i).toFixed(1)} ${y(i).toFixed(1)})`, 'data-node': i },
      s('title', {}, `${name}${graph.elements ? `, ${sizes[i]} element${sizes[i] === 1 ? '' : 's'}` : ''}`),
      s('circle', { r: r.toFixed(1), fill: css(color(i)) }),
      s('text', { y: (-r - 3).toFixed(1), 'text-anchor': 'middle' }, labelOf(i)));
  });
  const drawing = s('svg', { viewBox: `0 0 ${kWidth} ${height}`, class: `graph${n > 80 ? ' dense' : ''}`, tabindex: '0', role: 'img',
    'aria-label': `${graph.name}: ${n} nodes, ${graph.edges.count} edges. Arrow keys step through the nodes.` },
    s('g', {}, ...lines), s('g', {}, ...nodes), edgeLabels);

  const current = () => model.nodesFor(graph, view.selection);
  function mark() {
    const chosen = new Set(current());
    const around = model.neighbours(graph, [...chosen]);
    nodes.forEach((node, i) => {
      node.classList.toggle('selected', chosen.has(i));
      node.classList.toggle('away', chosen.size > 0 && !chosen.has(i) && !around.has(i));
    });
    edgeLabels.replaceChildren();
    const taken = nodes.flatMap((_, i): [number, number, number, number][] => [[x(i), y(i), 2 * base, 2 * base], [x(i), y(i) - base - kLine / 2, kLetter * labelOf(i).length, kLine]]);
    lines.forEach((line, e) => {
      const a = edges[2 * e]!, b = edges[2 * e + 1]!;
      const on = chosen.has(a) || chosen.has(b);
      line.classList.toggle('on', on);
      line.classList.toggle('away', chosen.size > 0 && !on);
      line.style.stroke = on ? css(relationColor(model, graph.edge_names[e])) : '';
      if (on && edgeLabels.childElementCount < 30) {
        const name = graph.edge_names[e] ?? '';
        const [u, v] = placeAlong([x(a), y(a)], [x(b), y(b)], kLetter * name.length, kLine, taken);
        edgeLabels.append(s('text', { x: u.toFixed(1), y: (v + 3).toFixed(1), 'text-anchor': 'middle' }, name));
      }
    });
  }
  const choose = (i: number) => app.select({ structure: graph.id, index: i }, scene);
  drawing.addEventListener('click', (e) => {
    const node = (e.target as Element).closest('[data-node]')?.getAttribute('data-node');
    if (node) choose(Number(node));
    else app.select(null, scene);
  });
  drawing.addEventListener('pointerover', (e) => {
    const node = (e.target as Element).closest('[data-node]')?.getAttribute('data-node');
    app.hover(node ? { structure: graph.id, index: Number(node) } : null, scene);
  });
  drawing.addEventListener('keydown', (e) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[e.key];
    if (!step || n === 0) return;
    e.preventDefault();
    e.stopPropagation();
    choose(((current()[0] ?? (step > 0 ? -1 : 0)) + step + n) % n);
  });
  app.on('selection', mark, drawing);
  mark();
  return h('section', { class: 'block' }, h('h3', {}, graph.name, h('span', { class: 'count' }, `${n} nodes, ${graph.edges.count} relations`)), drawing);
}
