// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A cloud of millions of points, for timing.
import { Buffers, encodeScene, random } from './make_scene.mjs';

export function cloudScene(n) {
  const b = new Buffers(), rnd = random(5);
  const p = new Uint16Array(3 * n), labels = new Int32Array(n);
  for (let i = 0; i < n; ++i) {
    // Sorted, as the writer leaves them: slabs along x.
    const x = i / n, wall = i % 5;
    p[3 * i] = 65535 * x;
    p[3 * i + 1] = wall === 0 ? 0 : wall === 1 ? 65535 : 65535 * rnd();
    p[3 * i + 2] = wall === 2 ? 0 : wall === 3 ? 65535 : 65535 * rnd();
    labels[i] = wall === 4 ? -1 : wall + 4 * Math.floor(8 * x);
  }
  return encodeScene({
    scene: 1, title: 'A large cloud', capability: 'planes', version: '0.2.0', command: 'unseen planes cloud.ply -o out', facts: [], summary: { seconds: {}, energy: {}, counts: {}, warnings: [] }, options: [], input: {},
    structures: [{ id: 'points', kind: 'points', name: 'Points', visible: true, positions: b.delta(p, 3, 'u16', { low: [0, 0, 0], high: [40, 12, 5] }),
                   quantities: [{ id: 'plane', name: 'Plane', kind: 'label', array: b.delta(labels, 1, 'i32') },
                                { id: 'height', name: 'Height', kind: 'scalar', unit: 'm', array: b.delta(Uint8Array.from({ length: n }, (_, i) => p[3 * i + 2] >> 8), 1, 'u8', { low: [0], high: [5] }), low: 0, high: 5 }] }],
    tables: [],
  }, b);
}
