// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// People as bones between joints, at the time that is shown.
import * as THREE from 'three';
import type { SkeletonStructure } from '../format';
import { labelColor } from '../palette';
import { FatLines } from '../view/fat_lines';
import { ColoredLayer } from './colored';
import type { Hit, LayerContext, Look, View } from './layer';
import { hitSegments } from './ray';
import { stepAt } from './trajectory';

export class SkeletonLayer extends ColoredLayer {
  private readonly times: Float32Array;
  private readonly joints: Float32Array;
  private readonly bones: ArrayLike<number>;
  private readonly jointCount: number;
  private readonly width: number;  // px
  private readonly steps: boolean;
  private readonly lines: FatLines;
  private segments = new Float32Array(0);
  private owner: number[] = [];

  constructor(context: LayerContext, structure: SkeletonStructure) {
    super(context, structure, context.model.count(structure), (i) => labelColor(i));
    const { model, shared } = context;
    this.times = model.floats(structure.times);
    this.joints = model.floats(structure.joints);
    this.bones = model.stored(structure.bones);
    this.jointCount = structure.joint_count;
    this.width = structure.width ?? 5;
    this.steps = structure.steps ?? false;
    this.lines = new FatLines(shared, this.table, { width: this.width, bias: 1e-4 });
    this.object.add(this.lines.object);
    const p = new THREE.Vector3();
    for (let i = 0; i < this.joints.length; i += 3)
      if (Number.isFinite(this.joints[i]!)) this.bounds.expandByPoint(p.fromArray(this.joints, i));
  }

  override update(look: Look) {
    super.update(look);
    const { i, f: between } = stepAt(this.times, look.time);
    const f = this.steps ? Math.round(between) : between;
    const n = this.times.length;
    const joint = (person: number, j: number): number[] | null => {
      const a = 3 * ((person * n + i) * this.jointCount + j), b = 3 * ((person * n + Math.min(n - 1, i + 1)) * this.jointCount + j);
      const [at, to] = [this.joints.subarray(a, a + 3), this.joints.subarray(b, b + 3)];
      const hasA = Number.isFinite(at[0]!), hasB = Number.isFinite(to[0]!);
      if (hasA && hasB) return [0, 1, 2].map((c) => at[c]! + f * (to[c]! - at[c]!));
      if (hasA && f < 0.5) return [...at];
      return hasB && f >= 0.5 ? [...to] : null;
    };
    const segments: number[] = [];
    this.owner = [];
    for (let person = 0; person < this.count; ++person)
      for (let k = 0; k < this.bones.length; k += 2) {
        const a = joint(person, this.bones[k]!), b = joint(person, this.bones[k + 1]!);
        if (!a || !b) continue;
        segments.push(...a, ...b);
        this.owner.push(person);
      }
    this.segments = new Float32Array(segments);
    this.lines.set(this.segments, this.owner);
    this.lines.width = this.width + (this.marked().length > 0 ? 2 : 0);
  }

  override pick(ray: THREE.Ray, view: View, at: THREE.Vector2): Hit | null {
    const hit = hitSegments(this.segments, view.camera, view.width, view.height, at, 8);
    if (!hit) return null;
    const p = new THREE.Vector3().fromArray(this.segments, 6 * hit.index);
    return { selection: { structure: this.structure.id, index: this.owner[hit.index]! }, distance: p.sub(ray.origin).dot(ray.direction) };
  }

  override anchor(person: number): THREE.Vector3 | null {
    const box = new THREE.Box3();
    this.owner.forEach((o, k) => o === person && box.expandByPoint(new THREE.Vector3().fromArray(this.segments, 6 * k)));
    return box.isEmpty() ? null : box.getCenter(new THREE.Vector3());
  }
}
