// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Places for the nodes of a graph (Fruchterman and Reingold), the same in every run.

export function layoutOf(count: number, edges: ArrayLike<number>, edgeCount: number): Float32Array {
  const p = new Float32Array(2 * count);
  for (let i = 0; i < count; ++i) {
    // A sunflower: even, and no two at one place.
    const r = Math.sqrt((i + 0.5) / Math.max(1, count)), a = i * 2.399963;
    p[2 * i] = r * Math.cos(a);
    p[2 * i + 1] = r * Math.sin(a);
  }
  if (count < 3 || count > 1500) return p;
  const k = 1.1 / Math.sqrt(count);
  const rounds = Math.min(200, Math.ceil(3e7 / (count * count + edgeCount)));
  const d = new Float32Array(2 * count);
  for (let round = 0; round < rounds; ++round) {
    d.fill(0);
    for (let i = 0; i < count; ++i)
      for (let j = 0; j < i; ++j) {
        const x = p[2 * i]! - p[2 * j]!, y = p[2 * i + 1]! - p[2 * j + 1]!;
        const f = (k * k) / Math.max(1e-6, x * x + y * y);
        d[2 * i] = d[2 * i]! + x * f;
        d[2 * i + 1] = d[2 * i + 1]! + y * f;
        d[2 * j] = d[2 * j]! - x * f;
        d[2 * j + 1] = d[2 * j + 1]! - y * f;
      }
    // Dense graphs would fall into one heap.
    const pull = Math.min(1, (1.5 * count) / Math.max(1, edgeCount));
    for (let e = 0; e < edgeCount; ++e) {
      const i = edges[2 * e]!, j = edges[2 * e + 1]!;
      const x = p[2 * i]! - p[2 * j]!, y = p[2 * i + 1]! - p[2 * j + 1]!;
      const f = (pull * Math.hypot(x, y)) / k;
      d[2 * i] = d[2 * i]! - x * f;
      d[2 * i + 1] = d[2 * i + 1]! - y * f;
      d[2 * j] = d[2 * j]! + x * f;
      d[2 * j + 1] = d[2 * j + 1]! + y * f;
    }
    const heat = 0.12 * (1 - round / rounds) ** 1.5 + 0.002;
    for (let i = 0; i < count; ++i) {
      const x = d[2 * i]! - 0.6 * p[2 * i]!, y = d[2 * i + 1]! - 0.6 * p[2 * i + 1]!;
      const length = Math.hypot(x, y) || 1;
      p[2 * i] = p[2 * i]! + (x / length) * Math.min(length, heat);
      p[2 * i + 1] = p[2 * i + 1]! + (y / length) * Math.min(length, heat);
    }
  }
  // Into the square from -1 to 1.
  for (let c = 0; c < 2; ++c) {
    let low = Infinity, high = -Infinity;
    for (let i = c; i < p.length; i += 2) {
      low = Math.min(low, p[i]!);
      high = Math.max(high, p[i]!);
    }
    for (let i = c; i < p.length; i += 2) p[i] = ((p[i]! - low) / (high - low || 1)) * 2 - 1;
  }
  return p;
}
