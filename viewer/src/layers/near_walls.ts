// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Which planes enclose the scene, so that those between the camera and the inside can be faded.
import * as THREE from 'three';
import type { View } from './layer';

export interface Shell {
  /** Whether a plane has (nearly) nothing behind it. */
  outer: Uint8Array;
  /** Outward normals, three numbers a plane. */
  outward: Float32Array;
  centroids: Float32Array;
  areas: Float32Array;
  /** Share of the area that lies inside. */
  inside: number;
}

const kBehind = 0.12;
const kDepth = 0.06;

export function shellOf(count: number, vertices: Float32Array, triangles: ArrayLike<number>, owner: ArrayLike<number>,
                        normals: Float32Array, bounds: THREE.Box3): Shell {
  const areas = new Float32Array(count);
  const centroids = new Float32Array(3 * count);
  const m = triangles.length / 3;
  const samples = new Float32Array(4 * m);
  const a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3();
  for (let t = 0; t < m; ++t) {
    a.fromArray(vertices, 3 * triangles[3 * t]!);
    b.fromArray(vertices, 3 * triangles[3 * t + 1]!);
    c.fromArray(vertices, 3 * triangles[3 * t + 2]!);
    const mid = [(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3];
    const area = b.sub(a).cross(c.sub(a)).length() / 2;
    const p = owner[t]!;
    areas[p] = areas[p]! + area;
    for (let k = 0; k < 3; ++k) {
      centroids[3 * p + k] = centroids[3 * p + k]! + area * mid[k]!;
      samples[4 * t + k] = mid[k]!;
    }
    samples[4 * t + 3] = area;
  }
  let total = 0;
  for (let p = 0; p < count; ++p) {
    total += areas[p]!;
    for (let k = 0; k < 3; ++k) centroids[3 * p + k] = centroids[3 * p + k]! / (areas[p]! || 1);
  }
  const center = bounds.getCenter(new THREE.Vector3());
  const depth = kDepth * bounds.getSize(new THREE.Vector3()).length();
  const outer = new Uint8Array(count);
  const outward = new Float32Array(3 * count);
  const step = Math.max(1, Math.floor((m * count) / 2e7));
  let inside = 0;
  for (let p = 0; p < count; ++p) {
    let nx = normals[3 * p]!, ny = normals[3 * p + 1]!, nz = normals[3 * p + 2]!;
    const d = nx * centroids[3 * p]! + ny * centroids[3 * p + 1]! + nz * centroids[3 * p + 2]!;
    const sign = nx * center.x + ny * center.y + nz * center.z > d ? -1 : 1;
    nx *= sign; ny *= sign; nz *= sign;
    outward.set([nx, ny, nz], 3 * p);
    let behind = 0, all = 0;
    for (let t = 0; t < m; t += step) {
      const area = samples[4 * t + 3]!;
      all += area;
      if (nx * samples[4 * t]! + ny * samples[4 * t + 1]! + nz * samples[4 * t + 2]! - sign * d > depth) behind += area;
    }
    outer[p] = behind < kBehind * all ? 1 : 0;
    if (!outer[p]) inside += areas[p]!;
  }
  return { outer, outward, centroids, areas, inside: total > 0 ? inside / total : 0 };
}

/** Whether a plane of the shell stands between the camera and the inside. */
export function inFront(shell: Shell, p: number, view: View): boolean {
  if (!shell.outer[p]) return false;
  const x = shell.outward[3 * p]!, y = shell.outward[3 * p + 1]!, z = shell.outward[3 * p + 2]!;
  if (view.ortho) return -(x * view.forward.x + y * view.forward.y + z * view.forward.z) > 0.05;
  const dx = view.eye.x - shell.centroids[3 * p]!, dy = view.eye.y - shell.centroids[3 * p + 1]!, dz = view.eye.z - shell.centroids[3 * p + 2]!;
  const along = x * dx + y * dy + z * dz;
  return along > 0.02 * Math.hypot(dx, dy, dz);
}
