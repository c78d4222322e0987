// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Corners, faces and edges of boxes and spheres.

/** Corner k of a box from low to high: bit 0 is x, bit 1 y, bit 2 z. */
export const kBoxFaces = [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5];
export const kBoxEdges = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

export function boxCorners(low: number[], high: number[]): Float32Array {
  const out = new Float32Array(24);
  for (let k = 0; k < 8; ++k) {
    out[3 * k] = k & 1 ? high[0]! : low[0]!;
    out[3 * k + 1] = k & 2 ? high[1]! : low[1]!;
    out[3 * k + 2] = k & 4 ? high[2]! : low[2]!;
  }
  return out;
}

export function edgesOf(corners: Float32Array): Float32Array {
  const out = new Float32Array(3 * kBoxEdges.length);
  kBoxEdges.forEach((c, i) => out.set(corners.subarray(3 * c, 3 * c + 3), 3 * i));
  return out;
}

export function sphere(size: number[], rings = 16): { vertices: Float32Array; triangles: number[] } {
  const vertices: number[] = [], triangles: number[] = [];
  const around = 2 * rings;
  for (let i = 0; i <= rings; ++i)
    for (let j = 0; j < around; ++j) {
      const a = (Math.PI * i) / rings, b = (2 * Math.PI * j) / around;
      vertices.push((size[0]! / 2) * Math.sin(a) * Math.cos(b), (size[1]! / 2) * Math.sin(a) * Math.sin(b), (size[2]! / 2) * Math.cos(a));
    }
  for (let i = 0; i < rings; ++i)
    for (let j = 0; j < around; ++j) {
      const p = i * around + j, q = i * around + ((j + 1) % around);
      triangles.push(p, p + around, q, q, p + around, q + around);
    }
  return { vertices: new Float32Array(vertices), triangles };
}
