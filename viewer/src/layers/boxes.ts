// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Boxes: the part that was seen is solid; what was inferred is translucent with dashed edges.
import * as THREE from 'three';
import type { BoxesStructure } from '../format';
import { FatLines } from '../view/fat_lines';
import { TriMesh } from '../view/tri_mesh';
import { labelColor } from '../palette';
import { ColoredLayer, inkTable, setInk } from './colored';
import type { Hit, LayerContext, Look } from './layer';
import { hitBox } from './ray';
import { boxCorners, edgesOf, kBoxFaces } from './solids';

interface Poses {
  centers: Float32Array;
  rotations: Float32Array;
  sizes: Float32Array;
}

export class BoxesLayer extends ColoredLayer {
  private readonly after: Poses;
  private readonly free?: Poses;
  private readonly seen?: Float32Array;
  private readonly solid: TriMesh;
  private readonly shell?: TriMesh;
  private readonly solidEdges: FatLines;
  private readonly dashedEdges?: FatLines;
  private readonly outline: FatLines;
  private readonly partial: number[];  // boxes of which a part was not seen
  private readonly of: ArrayLike<number>;  // the element that each box is part of
  private readonly boxes: number;
  private readonly ink = inkTable();
  private drawn = -1;

  constructor(context: LayerContext, structure: BoxesStructure) {
    super(context, structure, context.model.count(structure), (i) => labelColor(i));
    const { model, shared } = context;
    const poses = (p: { centers: BoxesStructure['centers']; rotations: BoxesStructure['rotations']; sizes: BoxesStructure['sizes'] }) => ({
      centers: model.floats(p.centers), rotations: model.floats(p.rotations), sizes: model.floats(p.sizes) });
    this.after = poses(structure);
    this.free = structure.before && poses(structure.before);
    this.seen = structure.seen && model.floats(structure.seen);
    this.boxes = structure.centers.count;
    this.of = structure.of ? model.stored(structure.of) : Array.from({ length: this.boxes }, (_, i) => i);
    const owner = Array.from({ length: 8 * this.boxes }, (_, i) => this.of[Math.floor(i / 8)]!);
    const faces = Array.from({ length: this.boxes }, (_, i) => kBoxFaces.map((c) => 8 * i + c)).flat();
    const edges = Array.from({ length: 12 * this.boxes }, (_, i) => this.of[Math.floor(i / 12)]!);
    const solid = this.corners(0, this.seen !== undefined), whole = this.corners(0, false);
    this.partial = Array.from({ length: this.boxes }, (_, i) => i).filter((i) =>
      solid.subarray(24 * i, 24 * i + 24).some((v, k) => Math.abs(v - whole[24 * i + k]!) > 1e-5));
    this.solid = new TriMesh(shared, this.table, solid, owner, faces);
    this.solidEdges = new FatLines(shared, this.table, { width: 1.6, shade: 0.55 });
    this.solidEdges.set(this.allEdges(solid), edges);
    this.object.add(this.solid.object, this.solidEdges.object);
    if (this.seen) {
      this.shell = new TriMesh(shared, this.table, whole.slice(), owner, faces, undefined, 0.2);
      this.dashedEdges = new FatLines(shared, this.table, { width: 1.8, dash: 5, shade: 0.8 });
      this.dashedEdges.set(this.inferredEdges(whole), Array.from({ length: 12 * this.partial.length }, (_, k) => this.of[this.partial[Math.floor(k / 12)]!]!));
      this.object.add(this.shell.object, this.dashedEdges.object);
    }
    this.outline = new FatLines(shared, this.ink, { width: 2.6, onTop: true });
    this.object.add(this.outline.object);
    this.bounds.setFromArray(whole);
  }

  private frame_(i: number, t: number): { toWorld: THREE.Matrix4; size: THREE.Vector3 } {
    const of = (p: Poses) => ({
      c: new THREE.Vector3().fromArray(p.centers, 3 * i),
      q: new THREE.Quaternion(p.rotations[4 * i + 1], p.rotations[4 * i + 2], p.rotations[4 * i + 3], p.rotations[4 * i]),
      s: new THREE.Vector3().fromArray(p.sizes, 3 * i),
    });
    const a = of(this.after);
    if (this.free && t > 0) {
      const b = of(this.free);
      a.c.lerp(b.c, t);
      a.q.slerp(b.q, t);
      a.s.lerp(b.s, t);
    }
    return { toWorld: new THREE.Matrix4().compose(a.c, a.q, new THREE.Vector3(1, 1, 1)), size: a.s };
  }

  /** Before, a box was what was seen of it: the seen part grows into the whole while the box goes back to that. */
  private range(i: number, size: THREE.Vector3, seen: boolean, t: number): [number[], number[]] {
    const whole = [[-size.x / 2, -size.y / 2, -size.z / 2], [size.x / 2, size.y / 2, size.z / 2]] as [number[], number[]];
    if (!seen || !this.seen) return whole;
    const s = this.seen.subarray(6 * i, 6 * i + 6), back = this.free ? t : 0;
    return whole.map((end, e) => end.map((w, a) => s[3 * e + a]! + (w - s[3 * e + a]!) * back)) as [number[], number[]];
  }

  private corners(t: number, seen: boolean): Float32Array {
    const out = new Float32Array(24 * this.boxes);
    const p = new THREE.Vector3();
    for (let i = 0; i < this.boxes; ++i) {
      const { toWorld, size } = this.frame_(i, t);
      const corners = boxCorners(...this.range(i, size, seen, t));
      for (let k = 0; k < 8; ++k) p.fromArray(corners, 3 * k).applyMatrix4(toWorld).toArray(out, 24 * i + 3 * k);
    }
    return out;
  }

  private allEdges(corners: Float32Array): Float32Array {
    const out = new Float32Array(72 * this.boxes);
    for (let i = 0; i < this.boxes; ++i) out.set(edgesOf(corners.subarray(24 * i, 24 * i + 24)), 72 * i);
    return out;
  }

  private inferredEdges(corners: Float32Array): Float32Array {
    const all = this.allEdges(corners), out = new Float32Array(72 * this.partial.length);
    this.partial.forEach((i, k) => out.set(all.subarray(72 * i, 72 * i + 72), 72 * k));
    return out;
  }

  override update(look: Look) {
    super.update(look);
    setInk(this.ink, look.dark);
    if (look.before !== this.drawn && (this.free || this.drawn < 0)) {
      this.drawn = look.before;
      const solid = this.corners(look.before, this.seen !== undefined), whole = this.corners(look.before, false);
      this.solid.move(solid);
      this.solidEdges.move(this.allEdges(solid));
      this.shell?.move(whole);
      this.dashedEdges?.move(this.inferredEdges(whole));
    }
    const edges = this.allEdges(this.corners(look.before, false));
    const chosen = new Set(this.marked());
    const marked = Array.from({ length: this.boxes }, (_, i) => i).filter((i) => chosen.has(this.of[i]!));
    const out = new Float32Array(72 * marked.length);
    marked.forEach((m, k) => out.set(edges.subarray(72 * m, 72 * m + 72), 72 * k));
    this.outline.set(out, new Uint8Array(12 * marked.length));
  }

  override pick(ray: THREE.Ray): Hit | null {
    let best: Hit | null = null;
    for (let i = 0; i < this.boxes; ++i) {
      const { toWorld, size } = this.frame_(i, this.context.shared.uBefore.value);
      const [low, high] = this.range(i, size, false, 0);
      const distance = hitBox(ray, toWorld, new THREE.Vector3(...low), new THREE.Vector3(...high));
      if (distance !== null && (!best || distance < best.distance) && this.context.shared.shows(ray.at(distance, new THREE.Vector3())))
        best = { selection: { structure: this.structure.id, index: this.of[i]! }, distance };
    }
    return best;
  }

  /** The middle of its first box. */
  override anchor(i: number): THREE.Vector3 {
    const first = Array.from({ length: this.boxes }, (_, k) => k).find((k) => this.of[k] === i) ?? 0;
    return new THREE.Vector3().setFromMatrixPosition(this.frame_(first, this.context.shared.uBefore.value).toWorld);
  }
}
