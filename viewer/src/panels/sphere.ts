// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Directions on the unit sphere as the camera sees it: grey dots before, coloured discs after. n and -n are one direction.
import type { App, SceneView } from '../app';
import { h } from '../dom';
import type { NormalsStructure } from '../format';
import { css } from '../palette';
import { nodeColors } from './graph';

const kSize = 260;

export function spherePanel(app: App, view: SceneView, normals: NormalsStructure): HTMLElement {
  const model = view.model!;
  const after = model.floats(normals.after);
  const before = normals.before && model.floats(normals.before);
  const weights = normals.weights && model.floats(normals.weights);
  const color = nodeColors(model, normals);
  const show = { before: true, after: true };
  const canvas = h('canvas', { class: 'sphere', tabindex: '0', role: 'img',
    'aria-label': `Sphere of directions: ${before ? `${before.length / 3} before, ` : ''}${after.length / 3} after. It turns with the view; a click selects a direction.` });
  const scale = Math.min(2, devicePixelRatio || 1);
  canvas.width = canvas.height = kSize * scale;
  const pen = canvas.getContext('2d')!;
  const scene = app.scenes.indexOf(view);
  let spots: { x: number; y: number; r: number; index: number }[] = [];

  function draw() {
    const style = getComputedStyle(canvas);
    const [line, dot, ink] = ['--line', '--quiet', '--ink'].map((v) => style.getPropertyValue(v).trim());
    const r = app.rig.right(), u = app.rig.up(), b = app.rig.back();
    const R = kSize / 2 - 14, c = kSize / 2;
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, kSize, kSize);
    pen.strokeStyle = line!;
    pen.lineWidth = 1;
    const circle = (axis: number) => {
      pen.beginPath();
      let down = false;
      for (let k = 0; k <= 96; ++k) {
        const a = (k / 48) * Math.PI;
        const v = axis === 2 ? [Math.cos(a), Math.sin(a), 0] : axis === 1 ? [Math.cos(a), 0, Math.sin(a)] : [0, Math.cos(a), Math.sin(a)];
        const at = (d: { x: number; y: number; z: number }) => v[0]! * d.x + v[1]! * d.y + v[2]! * d.z;
        if (at(b) < 0) { down = false; continue; }
        if (down) pen.lineTo(c + R * at(r), c - R * at(u));
        else pen.moveTo(c + R * at(r), c - R * at(u));
        down = true;
      }
      pen.stroke();
    };
    for (const axis of [0, 1, 2]) circle(axis);
    pen.beginPath();
    pen.arc(c, c, R, 0, 2 * Math.PI);
    pen.stroke();
    const project = (a: Float32Array, i: number) => {
      const x = a[3 * i]!, y = a[3 * i + 1]!, z = a[3 * i + 2]!;
      const toward = x * b.x + y * b.y + z * b.z < 0 ? -1 : 1;
      return { x: c + R * toward * (x * r.x + y * r.y + z * r.z), y: c - R * toward * (x * u.x + y * u.y + z * u.z) };
    };
    if (before && show.before) {
      pen.fillStyle = dot!;
      pen.globalAlpha = before.length > 6000 ? 0.35 : 0.7;
      for (let i = 0; i < before.length / 3; ++i) {
        const p = project(before, i);
        pen.fillRect(p.x - 1, p.y - 1, 2, 2);
      }
      pen.globalAlpha = 1;
    }
    spots = [];
    if (!show.after) return;
    const chosen = new Set(model.nodesFor(normals, view.selection));
    const graph = model.graphs.find((g) => g.elements?.structure === normals.elements?.structure);
    const around = new Set<number>();
    if (view.selection && graph)
      for (const n of model.neighbours(graph, model.nodesFor(graph, view.selection)).keys())
        for (const m of model.nodesFor(normals, { structure: graph.id, index: n })) around.add(m);
    const order = [...Array(after.length / 3).keys()].sort((i, j) => (weights?.[j] ?? 1) - (weights?.[i] ?? 1));
    for (const i of order) {
      const p = project(after, i);
      const radius = 3 + 8 * Math.sqrt(Math.min(1, Math.max(0, weights?.[i] ?? 0.3)));
      pen.globalAlpha = chosen.size > 0 && !chosen.has(i) && !around.has(i) ? 0.25 : 0.9;
      pen.fillStyle = css(color(i));
      pen.beginPath();
      pen.arc(p.x, p.y, radius, 0, 2 * Math.PI);
      pen.fill();
      if (chosen.has(i)) {
        pen.strokeStyle = ink!;
        pen.lineWidth = 2.5;
        pen.stroke();
      }
      spots.push({ ...p, r: radius, index: i });
    }
    pen.globalAlpha = 1;
  }
  canvas.addEventListener('click', (e) => {
    const box = canvas.getBoundingClientRect();
    const x = ((e.clientX - box.left) / box.width) * kSize, y = ((e.clientY - box.top) / box.height) * kSize;
    const near = [...spots].reverse().find((p) => Math.hypot(p.x - x, p.y - y) < p.r + 4);
    app.select(near ? { structure: normals.id, index: near.index } : null, scene);
  });
  canvas.addEventListener('keydown', (e) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[e.key];
    const n = after.length / 3;
    if (!step || n === 0) return;
    e.preventDefault();
    e.stopPropagation();
    app.select({ structure: normals.id, index: ((model.nodesFor(normals, view.selection)[0] ?? (step > 0 ? -1 : 0)) + step + n) % n }, scene);
  });
  app.on(['selection', 'theme', 'frame'], draw, canvas);
  queueMicrotask(draw);
  const toggle = (key: 'before' | 'after', label: string) => h('label', { class: 'check' },
    h('input', { type: 'checkbox', checked: true, onchange: (e: Event) => { show[key] = (e.target as HTMLInputElement).checked; draw(); } }), label);
  return h('section', { class: 'block' },
    h('h3', {}, normals.name, h('span', { class: 'count' }, `${after.length / 3} directions`)),
    h('div', { class: 'row' }, before ? toggle('before', 'before (grey)') : null, toggle('after', 'after, by weight')), canvas);
}
