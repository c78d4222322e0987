// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A ray against triangles, segments and boxes.
import * as THREE from 'three';

export interface TriangleHit {
  triangle: number;
  distance: number;
}

/** The nearest triangle that `accept` takes (Möller and Trumbore), both sides. */
export function hitTriangles(ray: THREE.Ray, vertices: Float32Array, before: Float32Array | undefined, t: number, triangles: ArrayLike<number>,
                             accept: (triangle: number, at: THREE.Vector3) => boolean): TriangleHit | null {
  const { origin: o, direction: d } = ray;
  const at = new THREE.Vector3();
  const v = before && t > 0 ? (i: number) => vertices[i]! + t * (before[i]! - vertices[i]!) : (i: number) => vertices[i]!;
  let best: TriangleHit | null = null;
  for (let k = 0; k < triangles.length; k += 3) {
    const i = 3 * triangles[k]!, j = 3 * triangles[k + 1]!, l = 3 * triangles[k + 2]!;
    const ax = v(i), ay = v(i + 1), az = v(i + 2);
    const ux = v(j) - ax, uy = v(j + 1) - ay, uz = v(j + 2) - az;
    const wx = v(l) - ax, wy = v(l + 1) - ay, wz = v(l + 2) - az;
    const px = d.y * wz - d.z * wy, py = d.z * wx - d.x * wz, pz = d.x * wy - d.y * wx;
    const det = ux * px + uy * py + uz * pz;
    if (Math.abs(det) < 1e-14) continue;
    const sx = o.x - ax, sy = o.y - ay, sz = o.z - az;
    const a = (sx * px + sy * py + sz * pz) / det;
    if (a < 0 || a > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const b = (d.x * qx + d.y * qy + d.z * qz) / det;
    if (b < 0 || a + b > 1) continue;
    const distance = (wx * qx + wy * qy + wz * qz) / det;
    if (distance <= 0 || (best && distance >= best.distance)) continue;
    if (accept(k / 3, ray.at(distance, at))) best = { triangle: k / 3, distance };
  }
  return best;
}

export interface PixelHit {
  index: number;
  depth: number;
}

/** The nearest in pixels among segments (six numbers each). */
export function hitSegments(segments: Float32Array, camera: THREE.Camera, width: number, height: number, at: THREE.Vector2, radius: number): PixelHit | null {
  const m = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const a = new THREE.Vector4(), b = new THREE.Vector4();
  let best: PixelHit | null = null;
  let nearest = radius;
  for (let i = 0; i < segments.length / 6; ++i) {
    a.set(segments[6 * i]!, segments[6 * i + 1]!, segments[6 * i + 2]!, 1).applyMatrix4(m);
    b.set(segments[6 * i + 3]!, segments[6 * i + 4]!, segments[6 * i + 5]!, 1).applyMatrix4(m);
    if (a.w <= 0 || b.w <= 0) continue;
    const ax = (a.x / a.w * 0.5 + 0.5) * width, ay = (0.5 - a.y / a.w * 0.5) * height;
    const bx = (b.x / b.w * 0.5 + 0.5) * width, by = (0.5 - b.y / b.w * 0.5) * height;
    const len = (bx - ax) ** 2 + (by - ay) ** 2;
    const t = len > 0 ? Math.min(1, Math.max(0, ((at.x - ax) * (bx - ax) + (at.y - ay) * (by - ay)) / len)) : 0;
    const d = Math.hypot(at.x - ax - t * (bx - ax), at.y - ay - t * (by - ay));
    if (d < nearest) {
      nearest = d;
      best = { index: i, depth: (1 - t) * a.w + t * b.w };
    }
  }
  return best;
}

/** Where a ray enters a box about the origin of its own coordinates, or null. */
export function hitBox(ray: THREE.Ray, toWorld: THREE.Matrix4, low: THREE.Vector3, high: THREE.Vector3): number | null {
  const inverse = toWorld.clone().invert();
  const local = ray.clone().applyMatrix4(inverse);
  const point = local.intersectBox(new THREE.Box3(low, high), new THREE.Vector3());
  return point ? point.applyMatrix4(toWorld).distanceTo(ray.origin) : null;
}
