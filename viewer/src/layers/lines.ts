// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Line segments, as of a drawing.
import * as THREE from 'three';
import type { LinesStructure } from '../format';
import { FatLines } from '../view/fat_lines';
import { ColoredLayer, inkTable, setInk } from './colored';
import type { Hit, LayerContext, Look, View } from './layer';
import { hitSegments } from './ray';

export class LinesLayer extends ColoredLayer {
  private readonly vertices: Float32Array;
  private readonly before?: Float32Array;
  private readonly ink = inkTable();
  private readonly halo: FatLines;

  constructor(context: LayerContext, structure: LinesStructure) {
    super(context, structure, structure.vertices.count / 2, () => [86, 130, 170]);
    const { model, shared } = context;
    this.vertices = model.floats(structure.vertices);
    this.before = structure.before && model.floats(structure.before);
    this.bounds.setFromArray(this.vertices);
    const lines = new FatLines(shared, this.table, { width: 3.2, bias: 1e-4 });
    lines.set(this.vertices, Array.from({ length: this.count }, (_, i) => i), this.before);
    this.halo = new FatLines(shared, this.ink, { width: 8, bias: 5e-5 });
    this.halo.object.renderOrder = 4;
    this.object.add(lines.object, this.halo.object);
  }

  override update(look: Look) {
    super.update(look);
    setInk(this.ink, look.dark);
    const marked = this.marked();
    const take = (source: Float32Array) => {
      const out = new Float32Array(6 * marked.length);
      marked.forEach((m, i) => out.set(source.subarray(6 * m, 6 * m + 6), 6 * i));
      return out;
    };
    this.halo.set(take(this.vertices), marked.map(() => 0), this.before && take(this.before));
  }

  private now(): Float32Array {
    const t = this.context.shared.uBefore.value;
    if (!this.before || t === 0) return this.vertices;
    return this.vertices.map((v, i) => v + t * (this.before![i]! - v));
  }

  override pick(ray: THREE.Ray, view: View, at: THREE.Vector2): Hit | null {
    const hit = hitSegments(this.now(), view.camera, view.width, view.height, at, 7);
    if (!hit) return null;
    // Of lines and points at one place, the line.
    const middle = this.anchor(hit.index)!;
    return { selection: { structure: this.structure.id, index: hit.index }, distance: middle.sub(ray.origin).dot(ray.direction) * 0.98 - 0.02 };
  }

  override anchor(i: number): THREE.Vector3 {
    const v = this.vertices;
    return new THREE.Vector3((v[6 * i]! + v[6 * i + 3]!) / 2, (v[6 * i + 1]! + v[6 * i + 4]!) / 2, (v[6 * i + 2]! + v[6 * i + 5]!) / 2);
  }
}
