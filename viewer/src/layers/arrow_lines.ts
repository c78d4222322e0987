// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Arrows as line segments: a shaft and two barbs each.
import * as THREE from 'three';

/** m: the factor that makes the longest of vectors an eighth of the scene. */
export function arrowScale(vectors: Float32Array, extent: number): number {
  let most = 0;
  for (let e = 0; e < vectors.length / 3; ++e) most = Math.max(most, Math.hypot(vectors[3 * e]!, vectors[3 * e + 1]!, vectors[3 * e + 2]!));
  return most > 0 ? extent / 8 / most : 0;
}

/** Three segments an arrow, six numbers each. */
export function arrowSegments(origins: ArrayLike<number>, vectors: Float32Array, scale: number): number[] {
  const out: number[] = [];
  for (let e = 0; e < vectors.length / 3; ++e) {
    const v = new THREE.Vector3().fromArray(vectors, 3 * e).multiplyScalar(scale);
    const from = new THREE.Vector3(origins[3 * e], origins[3 * e + 1], origins[3 * e + 2]);
    const to = from.clone().add(v);
    out.push(...from.toArray(), ...to.toArray());
    const aside = new THREE.Vector3(v.y, -v.x, 0);
    if (aside.lengthSq() < 1e-3 * v.lengthSq()) aside.set(v.z, 0, -v.x);
    aside.setLength(0.12 * v.length());
    for (const sign of [1, -1]) out.push(...to.toArray(), ...to.clone().addScaledVector(v, -0.22).addScaledVector(aside, sign).toArray());
  }
  return out;
}
