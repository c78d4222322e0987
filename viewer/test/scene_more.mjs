// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The other kinds of scenes: a drawing, a collision, boxes that carry each other, a person among furniture, a large cloud.
import { Buffers, encodeScene, random } from './make_scene.mjs';
import { png } from './png.mjs';

const base = (title, capability, more) => ({
  scene: 1, title, capability, version: '0.2.0', command: `unseen ${capability} input -o out`, facts: [], summary: { status: 'solved', seconds: { all: 1.5 }, energy: { total: 2.5 }, counts: {}, warnings: [] },
  options: [], input: { path: 'input', sha256: '' }, tables: [], ...more });

export function planScene() {
  const b = new Buffers(), rnd = random(3);
  const walls = [[0, 0, 10, 0], [10, 0, 10, 7], [10, 7, 0, 7], [0, 7, 0, 0], [4, 0, 4, 4], [4, 5, 4, 7], [6.5, 4, 10, 4], [4, 4, 5.5, 4]];
  const askew = [[6, 1, 8.2, 1.5], [8.2, 1.5, 7.95, 2.6], [7.95, 2.6, 5.75, 2.1], [5.75, 2.1, 6, 1]];
  const all = [...walls, ...askew];
  const vertices = all.flatMap(([x, y, z, w]) => [x, y, 0, z, w, 0]);
  const points = [], labels = [];
  all.forEach(([x0, y0, x1, y1], i) => {
    const n = Math.round(400 * Math.hypot(x1 - x0, y1 - y0));
    for (let k = 0; k < n; ++k) {
      const t = rnd();
      points.push(x0 + t * (x1 - x0) + 0.05 * (rnd() - 0.5), y0 + t * (y1 - y0) + 0.05 * (rnd() - 0.5), 0);
      labels.push(i);
    }
  });
  return encodeScene(base('Lines of plan.png', 'planes', {
    flat: true, facts: [{ name: 'lines', value: String(all.length) }, { name: 'orientation frames', value: '2' }],
    structures: [
      { id: 'points', kind: 'points', name: 'Points', visible: true, positions: b.quantised(points), quantities: [{ id: 'line', name: 'Line', kind: 'label', array: b.delta(labels, 1, 'i32'), structure: 'lines' }] },
      { id: 'lines', kind: 'lines', name: 'Lines', visible: true, vertices: b.plain(vertices, 3), before: b.plain(vertices.map((v, i) => (i % 3 < 2 ? v + 0.12 * (rnd() - 0.5) : v)), 3),
        quantities: [{ id: 'frame', name: 'Orientation frame', kind: 'label', array: b.plain(all.map((_, i) => (i < walls.length ? 0 : 1)), 1, 'i32') }] },
    ],
    tables: [{ title: 'Lines', structure: 'lines', columns: [{ name: 'line' }, { name: 'length', unit: 'm', digits: 2 }], rows: all.map(([x, y, z, w], i) => [i, Math.hypot(z - x, w - y)]) }],
  }), b);
}

/** What a camera at `eye` sees that looks along +y and 20° down; row by row. */
const pose = (eye) => {
  const c = Math.cos(0.35), s = Math.sin(0.35);
  return [1, 0, 0, eye[0], 0, -s, c, eye[1], 0, -c, -s, eye[2], 0, 0, 0, 1];
};

export function collisionScene() {
  const b = new Buffers();
  const n = 61, times = Array.from({ length: n }, (_, i) => i / 30), hit = 1;
  const at = (t) => [[-1 + 0.9 * Math.min(t, hit) - 0.35 * Math.max(0, t - hit), 2, 1 + 1.6 * t - 0.9 * t * t], [0.9 - 0.8 * Math.min(t, hit) + 0.5 * Math.max(0, t - hit), 2.1, 1.1 + 1.5 * t - 0.9 * t * t]];
  const turn = (t, w) => [Math.cos(w * t), 0.3 * Math.sin(w * t), 0.4 * Math.sin(w * t), Math.sqrt(0.75) * Math.sin(w * t)];
  const [w, h, f] = [320, 180, 260];
  const eye = [0, -1.5, 2.3], T = pose(eye);
  const project = (p) => {
    const d = p.map((x, k) => x - eye[k]);
    const c = [0, 1, 2].map((k) => T[k] * d[0] + T[4 + k] * d[1] + T[8 + k] * d[2]);
    return [(f * c[0]) / c[2] + w / 2, (f * c[1]) / c[2] + h / 2, (0.2 * f) / c[2]];
  };
  const frameTimes = times.filter((_, i) => i % 6 === 0);
  const frames = frameTimes.map((t) => {
    const [p, q] = at(t).map(project);
    return b.plain(png(w, h, (x, y) => (Math.hypot(x - p[0], y - p[1]) < p[2] ? [20, 110, 170] : Math.hypot(x - q[0], y - q[1]) < q[2] ? [225, 160, 20] : [210 - y / 4, 205 - y / 4, 198 - y / 4])), 1, 'u8');
  });
  return encodeScene(base('Collision of shot.json', 'collision', {
    time: { start: 0, end: 2 }, facts: [{ name: 'restitution', value: '0.62' }, { name: 'mass ratio', value: '1.4' }],
    structures: [
      { id: 'floor', kind: 'mesh', name: 'Floor', visible: true, vertices: b.plain([-2, 0, 0, 2, 0, 0, 2, 4, 0, -2, 4, 0], 3), triangles: b.plain([0, 1, 2, 0, 2, 3], 3, 'u32') },
      { id: 'bodies', kind: 'trajectory', name: 'Bodies', visible: true, times: b.plain(times), positions: b.plain([0, 1].flatMap((k) => times.flatMap((t) => at(t)[k])), 3),
        rotations: b.plain([0, 1].flatMap((k) => times.flatMap((t) => turn(t, k ? 2 : -3))), 4), shapes: [{ kind: 'box', size: [0.4, 0.25, 0.3] }, { kind: 'sphere', size: [0.36, 0.36, 0.36] }] },
      { id: 'impulses', kind: 'arrows', name: 'Impulses at the contact', visible: true, origins: b.plain([0, 2.05, 1.7, 0, 2.05, 1.7], 3), vectors: b.plain([-2, 0, 0.2, 2, 0, -0.2], 3),
        quantities: [{ id: 'on', name: 'On', kind: 'label', array: b.plain([0, 1], 1, 'i32'), names: ['box', 'ball'] }] },
      { id: 'camera', kind: 'camera', name: 'Camera', visible: true, T_world_camera: T, fx: f, fy: f, cx: w / 2, cy: h / 2, width: w, height: h, image: 'video' },
      { id: 'video', kind: 'image', name: 'Frames of the shot', visible: true, width: w, height: h, format: 'image/png', frames, times: b.plain(frameTimes) },
    ],
    charts: [{ title: 'Residuals', x: { name: 'frame', seconds: 1 / 30 }, y: { name: 'distance', unit: 'px' }, marks: [{ x: 30, name: 'impact' }],
      series: [0, 1].map((k) => ({ name: ['box', 'ball'][k], color: k, hollow: k === 1, x: b.plain(times.map((_, i) => i)), y: b.plain(times.map((t) => 0.4 + 0.3 * Math.sin(7 * t + k))) })) }],
    tables: [{ title: 'Bodies', structure: 'bodies', columns: [{ name: 'body' }, { name: 'mass', unit: 'kg', digits: 2 }], rows: [[0, 1.4], [1, 1]] }],
  }), b);
}

/** `named`: boxes have names of their own, a ground that is no box carries the first, and a table is of no structure. */
export function cuboidsScene({ named = false, options = [] } = {}) {
  const b = new Buffers();
  const boxes = [[0, 0, 0.35, 1.6, 0.9, 0.7, 0], [-0.4, 0.1, 0.85, 0.5, 0.4, 0.3, 0.3], [0.45, -0.1, 0.9, 0.3, 0.3, 0.4, -0.2], [-0.35, 0.1, 1.1, 0.3, 0.3, 0.2, 0.6]];
  const q = (a) => [Math.cos(a / 2), 0, 0, Math.sin(a / 2)];
  const carries = [[0, 1], [0, 2], [1, 3]];
  const names = ['table', 'crate', 'tin', 'parcel'];
  return encodeScene(base('Boxes of frame.json', 'cuboids', {
    facts: [{ name: 'boxes', value: '4' }], options,
    structures: [
      { id: 'boxes', kind: 'boxes', name: 'Boxes', visible: true, centers: b.plain(boxes.flatMap((x) => x.slice(0, 3)), 3), rotations: b.plain(boxes.flatMap((x) => q(x[6])), 4), sizes: b.plain(boxes.flatMap((x) => x.slice(3, 6)), 3),
        seen: b.plain(boxes.flatMap((x) => [-x[3] / 2, -x[4] / 2, -x[5] * 0.1, x[3] / 2, x[4] * 0.1, x[5] / 2]), 6),
        before: { centers: b.plain(boxes.flatMap((x) => [x[0] + 0.05, x[1], x[2] + 0.06]), 3), rotations: b.plain(boxes.flatMap((x) => q(x[6] + 0.1)), 4), sizes: b.plain(boxes.flatMap((x) => x.slice(3, 6).map((s) => 0.9 * s)), 3) } },
      { id: 'support', kind: 'graph', name: 'Who carries whom', visible: true, node_names: named ? [...names, 'ground 0'] : names, edges: b.plain((named ? [...carries, [4, 0]] : carries).flat(), 2, 'u32'), edge_names: (named ? [...carries, 0] : carries).map(() => 'supports'),
        elements: { structure: 'boxes', of_node: named ? [[0], [1], [2], [3], []] : [[0], [1], [2], [3]] }, positions: b.plain((named ? [...boxes, [0, 0, 0]] : boxes).flatMap((x) => x.slice(0, 3)), 3),
        vectors: b.plain([0, 0, 5, 0, 0, 2, 0, 0, 1, ...(named ? [0, 0, 8] : [])], 3) },
    ],
    tables: [{ title: 'Boxes', structure: 'boxes', columns: [{ name: 'box' }, { name: 'name' }, { name: 'height', unit: 'm', digits: 2 }], rows: boxes.map((x, i) => [named ? `box ${i + 6}` : i, names[i], x[5]]) },
      ...(named ? [{ title: 'Contacts', columns: [{ name: 'from' }, { name: 'force', unit: 'N', digits: 1 }], rows: Array.from({ length: 60 }, (_, i) => [`box ${i}`, -0.001 * i]) }] : [])],
  }), b);
}

export function interactionsScene() {
  const b = new Buffers();
  const times = Array.from({ length: 31 }, (_, i) => i / 10);
  // Pelvis, neck, head, hands, feet.
  const joints = times.flatMap((t, i) => {
    const x = -1 + 0.6 * t, s = 0.25 * Math.sin(5 * t), z = t > 2 ? 0.95 - 0.4 * (t - 2) : 0.95;
    return [x, 0, z, x, 0, z + 0.5, x, 0, z + 0.72, x + s, 0.3, z + 0.1, i % 7 === 3 ? NaN : x - s, -0.3, z + 0.1, x - s, 0.1, 0.05, x + s, -0.1, 0.05];
  });
  return encodeScene(base('Interactions of take.json', 'interactions', {
    time: { start: 0, end: 3 }, facts: [{ name: 'people', value: '1' }, { name: 'furniture', value: '2' }],
    structures: [
      { id: 'people', kind: 'skeleton', name: 'People', visible: true, times: b.plain(times), joints: b.plain(joints, 3), bones: b.plain([0, 1, 1, 2, 1, 3, 1, 4, 0, 5, 0, 6], 2, 'u32'), joint_count: 7 },
      { id: 'floor', kind: 'floor', name: 'Floor', visible: true, low: [-2, -3], high: [2, 2], height: 0, cell: 1 },
      { id: 'evidence-picture', kind: 'image', name: 'Evidence', width: 8, height: 8, format: 'image/png', data: b.plain(png(8, 8, (x, y) => (x < 4 && y < 4 ? [0, 114, 178] : [0, 0, 0])), 1, 'u8') },
      { id: 'evidence', kind: 'floor', name: 'Evidence on the floor', visible: false, low: [-1, -1], high: [1, 1], height: 0.005, image: 'evidence-picture' },
      // A chair of seat and back, and a table.
      { id: 'furniture', kind: 'boxes', name: 'Furniture', visible: true, element: 'piece', labels: ['chair 0.90', 'table 0.70'], centers: b.plain([0.9, 0, 0.25, 1.15, 0, 0.75, -0.5, 1.2, 0.4], 3),
        rotations: b.plain([1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0], 4), sizes: b.plain([0.6, 0.6, 0.5, 0.1, 0.6, 0.5, 1.4, 0.6, 0.8], 3), of: b.plain([0, 0, 1], 1, 'i32'),
        quantities: [{ id: 'class', name: 'Class', kind: 'label', array: b.plain([0, 1], 1, 'i32'), names: ['chair', 'table'] }] },
      // What the camera sees: two people whose order changes from time to time.
      { id: 'camera', kind: 'camera', name: 'Camera', visible: true, T_world_camera: pose([0, -2.5, 1.5]), fx: 300, fy: 300, cx: 160, cy: 120, width: 320, height: 240 },
      { id: 'seen', kind: 'skeleton', name: 'Detections', visible: true, width: 2, steps: true, times: b.plain([0, 1]), joints: b.plain([-1, 0, 0, -1, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, -1, 0, 0, -1, 0, 1], 3), bones: b.plain([0, 1], 2, 'u32'), joint_count: 2 },
    ],
    charts: [{ title: 'Likelihood', x: { name: 'time', unit: 's', seconds: 1 }, y: { name: 'likelihood', high: 1 },
      series: [{ name: 'person', color: 4, line: true, x: b.plain(times), y: b.plain(times.map((t) => (t > 0.85 && t < 0.95 ? NaN : t > 2 ? 0.9 : 0.1))) }],
      spans: [{ from: 0.2, to: 0.8, name: 'chair', color: 4, weight: 0.3, elements: { structure: 'furniture', indices: [0] } }, { from: 2, to: 3, name: 'chair', color: 4, weight: 0.9, elements: { structure: 'furniture', indices: [0] } },
              { from: 1, to: 1.5, name: 'no object', color: 5, weight: 0.5 }] }],
    tables: [{ title: 'Furniture', structure: 'furniture', columns: [{ name: 'category' }, { name: 'confidence', digits: 2 }], rows: [['chair', 0.9], ['table', 0.7]] }],
  }), b);
}

/** Thousands of rows, and a graph of hundreds of nodes. */
export function manyScene(rows = 5000) {
  const b = new Buffers(), rnd = random(9), nodes = 240;
  const vertices = Array.from({ length: rows }, () => { const p = [rnd() * 20, rnd() * 20, rnd() * 3]; return [...p, p[0] + rnd(), p[1] + rnd(), p[2]]; }).flat();
  const edges = Array.from({ length: 900 }, () => [Math.floor(rnd() * nodes), Math.floor(rnd() * nodes)]).filter(([x, y]) => x !== y);
  return encodeScene(base('Many lines', 'planes', {
    structures: [{ id: 'lines', kind: 'lines', name: 'Lines', visible: true, vertices: b.plain(vertices, 3), quantities: [{ id: 'length', name: 'Length', kind: 'scalar', unit: 'm', array: b.plain(Array.from({ length: rows }, () => rnd())) }] },
                 { id: 'graph', kind: 'graph', name: 'Relations', visible: true, node_names: Array.from({ length: nodes }, (_, i) => `direction ${i}`), edges: b.plain(edges.flat(), 2, 'u32'), edge_names: edges.map((_, i) => (i % 3 ? '90°' : '45°')),
                   elements: { structure: 'lines', of_node: Array.from({ length: nodes }, (_, i) => [i]) } }],
    tables: [{ title: 'Lines', structure: 'lines', columns: [{ name: 'line' }, { name: 'length', digits: 3 }], rows: Array.from({ length: rows }, (_, i) => [i, i % 10 === 0 ? null : rnd()]) }],
  }), b);
}
