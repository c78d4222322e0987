// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A closed room with furniture: planes with holes, points, relations, directions.
import { Buffers, encodeScene, random } from './make_scene.mjs';

/** A rectangle: corner, two edges, orientation frame, holes as [u0, v0, u1, v1] in shares. */
const rect = (corner, u, v, frame, tag, holes = []) => ({ corner, u, v, frame, tag, holes });

function box(x, y, z, dx, dy, dz, angle, frame, tag) {
  const c = Math.cos(angle), s = Math.sin(angle);
  const e1 = [c * dx, s * dx, 0], e2 = [-s * dy, c * dy, 0], e3 = [0, 0, dz];
  const at = (a, b, h) => [x + a * e1[0] + b * e2[0], y + a * e1[1] + b * e2[1], z + h * dz];
  return [rect(at(0, 0, 1), e1, e2, frame, `${tag} top`), rect(at(0, 0, 0), e1, e3, frame, `${tag} front`), rect(at(0, 1, 0), e1, e3, frame, `${tag} back`),
          rect(at(0, 0, 0), e2, e3, frame, `${tag} left`), rect(at(1, 0, 0), e2, e3, frame, `${tag} right`)];
}

export function roomPlanes() {
  const [w, d, h] = [6, 4.5, 2.7];
  return [
    rect([0, 0, 0], [w, 0, 0], [0, d, 0], 0, 'floor'), rect([0, 0, h], [w, 0, 0], [0, d, 0], 0, 'ceiling'),
    rect([0, 0, 0], [w, 0, 0], [0, 0, h], 0, 'wall', [[0.1, 0, 0.25, 0.78]]), rect([0, d, 0], [w, 0, 0], [0, 0, h], 0, 'wall', [[0.2, 0.35, 0.45, 0.85], [0.55, 0.35, 0.8, 0.85]]),
    rect([0, 0, 0], [0, d, 0], [0, 0, h], 0, 'wall'), rect([w, 0, 0], [0, d, 0], [0, 0, h], 0, 'wall'),
    ...box(4.6, 0.5, 0, 1.2, 0.7, 0.9, 0, 0, 'cupboard'), ...box(1.4, 1.6, 0, 1.6, 0.9, 0.75, 0.35, 1, 'table'), ...box(4.2, 3.2, 0, 0.6, 0.6, 1.8, -0.2, 2, 'stove').slice(0, 4),
  ];
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.hypot(...a);
const unit = (a) => a.map((x) => x / norm(a));

export function roomScene({ points = 200000, title = 'Planes of room.ply', seed = 7, more = () => ({ structures: [], header: {} }) } = {}) {
  const b = new Buffers(), rnd = random(seed), planes = roomPlanes();
  const gauss = () => Math.sqrt(-2 * Math.log(rnd() + 1e-12)) * Math.cos(2 * Math.PI * rnd());
  const vertices = [], before = [], rings = [], triangles = [], owner = [], normals = [];
  const at = (p, s, t) => [0, 1, 2].map((k) => p.corner[k] + s * p.u[k] + t * p.v[k]);
  planes.forEach((p, i) => {
    const n = unit(cross(p.u, p.v));
    normals.push(...n);
    const tilt = [0.05 * gauss(), 0.05 * gauss(), 0.05 * gauss()];
    const put = (s, t) => {
      const v = at(p, s, t);
      vertices.push(...v);
      const x = (s - 0.5) * tilt[0] * norm(p.u) + (t - 0.5) * tilt[1] * norm(p.v) + 0.3 * tilt[2];
      before.push(...v.map((c, k) => c + x * n[k]));
      return vertices.length / 3 - 1;
    };
    const ring = (corners) => {
      rings.push(vertices.length / 3, i);
      return corners.map(([s, t]) => put(s, t));
    };
    ring([[0, 0], [1, 0], [1, 1], [0, 1]]);
    for (const [x0, y0, x1, y1] of p.holes) ring([[x0, y0], [x0, y1], [x1, y1], [x1, y0]]);
    // Triangles: cells of the grid that the holes' edges make; corners of their own, part of the last ring of the plane.
    const xs = [...new Set([0, 1, ...p.holes.flatMap((h) => [h[0], h[2]])])].sort((x, y) => x - y);
    const ys = [...new Set([0, 1, ...p.holes.flatMap((h) => [h[1], h[3]])])].sort((x, y) => x - y);
    const find = (s, t) => {
      const v = at(p, s, t);
      for (let k = firstOf(i); k < vertices.length / 3; ++k)
        if (Math.hypot(vertices[3 * k] - v[0], vertices[3 * k + 1] - v[1], vertices[3 * k + 2] - v[2]) < 1e-9) return k;
      return -1;
    };
    const firstOf = (plane) => { for (let r = 0; r < rings.length; r += 2) if (rings[r + 1] === plane) return rings[r]; return 0; };
    if (p.holes.length === 0) {
      const f = firstOf(i);
      triangles.push(f, f + 1, f + 2, f, f + 2, f + 3);
      owner.push(i, i);
    } else {
      // Grid corners that no ring has are thin rings of their own (no outline to be seen).
      const grid = new Map();
      const corner = (s, t) => {
        const key = `${s},${t}`;
        if (!grid.has(key)) {
          const k = find(s, t);
          if (k >= 0) grid.set(key, k);
          else { rings.push(vertices.length / 3, i); grid.set(key, put(s, t)); }
        }
        return grid.get(key);
      };
      for (let x = 0; x + 1 < xs.length; ++x)
        for (let y = 0; y + 1 < ys.length; ++y) {
          const mx = (xs[x] + xs[x + 1]) / 2, my = (ys[y] + ys[y + 1]) / 2;
          if (p.holes.some((h) => mx > h[0] && mx < h[2] && my > h[1] && my < h[3])) continue;
          const q = [corner(xs[x], ys[y]), corner(xs[x + 1], ys[y]), corner(xs[x + 1], ys[y + 1]), corner(xs[x], ys[y + 1])];
          triangles.push(q[0], q[1], q[2], q[0], q[2], q[3]);
          owner.push(i, i);
        }
    }
  });

  const areas = planes.map((p) => norm(cross(p.u, p.v)) * (1 - p.holes.reduce((a, h) => a + (h[2] - h[0]) * (h[3] - h[1]), 0)));
  const total = areas.reduce((x, y) => x + y, 0);
  const positions = [], labels = [], residuals = [], counts = [];
  planes.forEach((p, i) => {
    const n = normals.slice(3 * i, 3 * i + 3);
    const m = Math.round((points * 0.97 * areas[i]) / total);
    counts.push(m);
    for (let k = 0; k < m; ++k) {
      let s, t;
      do { s = rnd(); t = rnd(); } while (p.holes.some((h) => s > h[0] && s < h[2] && t > h[1] && t < h[3]));
      const r = 0.006 * gauss();
      positions.push(...at(p, s, t).map((c, j) => c + r * n[j]));
      labels.push(i);
      residuals.push(Math.abs(r));
    }
  });
  while (labels.length < points) {
    positions.push(2.5 + rnd(), 2.2 + rnd(), 0.8 + 0.6 * rnd());
    labels.push(-1);
    residuals.push(0);
  }

  // Directions: parallel planes together.
  const directions = [], ofPlane = [];
  planes.forEach((p, i) => {
    const n = normals.slice(3 * i, 3 * i + 3);
    let k = directions.findIndex((d) => Math.abs(d.n[0] * n[0] + d.n[1] * n[1] + d.n[2] * n[2]) > 0.9999);
    if (k < 0) k = directions.push({ n, planes: [], frame: p.frame, area: 0 }) - 1;
    directions[k].planes.push(i);
    directions[k].area += areas[i];
    ofPlane.push(k);
  });
  const edges = [], edgeNames = [];
  for (let i = 0; i < directions.length; ++i)
    for (let j = i + 1; j < directions.length; ++j) {
      const dot = Math.abs(directions[i].n.reduce((a, x, k) => a + x * directions[j].n[k], 0));
      if (dot < 1e-6) { edges.push(i, j); edgeNames.push('90°'); }
    }
  const elements = { structure: 'planes', of_node: directions.map((d) => d.planes) };
  const widest = Math.max(...directions.map((d) => d.area));
  const quantities = [
    { id: 'frame', name: 'Orientation frame', kind: 'label', array: b.plain(planes.map((p) => p.frame), 1, 'i32'), names: ['room', 'table', 'stove'] },
    { id: 'plane', name: 'Plane', kind: 'label', array: b.plain(planes.map((_, i) => i), 1, 'i32') },
    { id: 'rms', name: 'Residual', kind: 'scalar', unit: 'm', array: b.plain(planes.map(() => 0.005 + 0.002 * rnd())), low: 0.004, high: 0.008 },
  ];
  const extra = more(b, rnd);
  const header = {
    scene: 1, title, capability: 'planes', version: '0.2.0', command: 'unseen planes room.ply -o out --angles 90 --seed 7', offset: [1000, 2000, 50], flat: false,
    facts: [{ name: 'planes', value: String(planes.length) }, { name: 'orientation frames', value: '3' }, { name: 'relations', value: String(edgeNames.length) },
            { name: 'points on a plane', value: '97.0 %' }, { name: 'scale', value: '0.05 m' }],
    summary: { status: 'solved', seconds: { survey: 0.11, voxels: 0.31, normals: 0.52, patches: 0.44, selection: 0.23, refit: 0.05, assignment: 0.36, relations: 0.01 },
               energy: { 'data before': 41.2, data: 12.9, irregularity: 3.1, total: 16.0 }, counts: { points, planes: planes.length }, warnings: ['The normals in the file do not agree with the surfaces; they were not used.'] },
    options: [{ name: 'scale', value: '0.05', unit: 'm', help: 'larger structures are kept, smaller ones simplified' }, { name: 'angles', value: '90', unit: '°', help: 'generators of the angles that planes may have' },
              { name: 'lambda', value: '0.5', unit: '', help: 'how much regularity counts against the data' }],
    input: { path: 'room.ply', sha256: '9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08' },
    thinned: { shown: points, of: points * 3 },
    structures: [
      { id: 'points', kind: 'points', name: 'Points', visible: true, positions: b.quantised(positions),
        quantities: [{ id: 'plane', name: 'Plane', kind: 'label', array: b.delta(labels, 1, 'i32'), structure: 'planes' },
                     { id: 'residual', name: 'Residual', kind: 'scalar', unit: 'm', array: b.delta(residuals.map((r) => Math.min(255, Math.round((r / 0.02) * 255))), 1, 'u8', { low: [0], high: [0.02] }), low: 0, high: 0.02 },
                     { id: 'rgb', name: 'Colour', kind: 'color', array: b.delta(labels.flatMap((l) => (l < 0 ? [90, 160, 80] : [150 + (l * 37) % 90, 140 + (l * 17) % 80, 120])), 3, 'u8') }] },
      { id: 'planes', kind: 'planes', name: 'Planes', visible: true, vertices: b.plain(vertices, 3), rings: b.plain(rings, 2, 'u32'), triangles: b.plain(triangles, 3, 'u32'),
        triangle_plane: b.plain(owner, 1, 'u32'), normals: b.plain(normals, 3), before: b.plain(before, 3), quantities },
      { id: 'directions', kind: 'graph', name: 'Relations', visible: true, node_names: directions.map((_, i) => `direction ${i}`), edges: b.plain(edges, 2, 'u32'), edge_names: edgeNames, elements, quantities: [] },
      { id: 'normals', kind: 'normals', name: 'Normals', visible: true, before: b.plain(planes.flatMap((_, i) => unit(normals.slice(3 * i, 3 * i + 3).map((c) => c + 0.05 * gauss()))), 3),
        after: b.plain(directions.flatMap((d) => d.n), 3), weights: b.plain(directions.map((d) => d.area / widest)), elements, quantities: [] },
      ...extra.structures,
    ],
    tables: [{ title: 'Planes', structure: 'planes',
               columns: [{ name: 'plane' }, { name: 'tag' }, { name: 'frame' }, { name: 'direction' }, { name: 'area', unit: 'm²', digits: 2 }, { name: 'points' }, { name: 'rms', unit: 'm', digits: 4 }],
               rows: planes.map((p, i) => [i, p.tag, ['room', 'table', 'stove'][p.frame], ofPlane[i], areas[i], counts[i], 0.005 + 0.0001 * ((i * 7) % 20)]) },
             ...(extra.tables ?? [])],
    ...extra.header,
  };
  return encodeScene(header, b);
}
