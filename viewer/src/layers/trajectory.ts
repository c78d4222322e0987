// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Bodies that move: their shapes now, and the paths of their centres.
import * as THREE from 'three';
import type { TrajectoryStructure } from '../format';
import { labelColor } from '../palette';
import { FatLines } from '../view/fat_lines';
import { TriMesh } from '../view/tri_mesh';
import { ColoredLayer, inkTable, setInk } from './colored';
import type { Hit, LayerContext, Look } from './layer';
import { MeshLayer } from './mesh';
import { hitTriangles } from './ray';
import { boxCorners, edgesOf, kBoxFaces, sphere } from './solids';

interface Body {
  object: THREE.Group;
  vertices: Float32Array;
  triangles: ArrayLike<number>;
}

/** The step of a series of times that t lies in, and how far. */
export function stepAt(times: Float32Array, t: number): { i: number; f: number } {
  let low = 0, high = times.length - 1;
  if (high <= 0 || t <= times[0]!) return { i: 0, f: 0 };
  if (t >= times[high]!) return { i: Math.max(0, high - 1), f: 1 };
  while (high - low > 1) {
    const mid = (low + high) >> 1;
    if (times[mid]! <= t) low = mid;
    else high = mid;
  }
  return { i: low, f: (t - times[low]!) / (times[high]! - times[low]! || 1) };
}

export class TrajectoryLayer extends ColoredLayer {
  private readonly times: Float32Array;
  private readonly positions: Float32Array;
  private readonly rotations: Float32Array;
  private readonly bodies: Body[] = [];
  private readonly outline: FatLines;
  private readonly ink = inkTable();

  constructor(context: LayerContext, structure: TrajectoryStructure) {
    super(context, structure, structure.shapes.length, (i) => labelColor(i));
    const { model, shared } = context;
    this.times = model.floats(structure.times);
    this.positions = model.floats(structure.positions);
    this.rotations = model.floats(structure.rotations);
    const n = this.times.length;
    const segments: number[] = [], owner: number[] = [];
    for (let b = 0; b < this.count; ++b) {
      for (let i = 0; i + 1 < n; ++i) {
        const k = 3 * (b * n + i);
        for (let c = 0; c < 6; ++c) segments.push(this.positions[k + c]!);
        owner.push(b);
      }
      const body = this.body(b, structure.shapes[b]!);
      const mesh = new TriMesh(shared, this.table, body.vertices, new Uint32Array(body.vertices.length / 3).fill(b), body.triangles);
      body.object.add(mesh.object);
      if (structure.shapes[b]!.kind === 'box') {
        const edges = new FatLines(shared, this.table, { width: 1.4, shade: 0.55 });
        edges.set(edgesOf(body.vertices), new Uint32Array(12).fill(b));
        body.object.add(edges.object);
      }
      body.object.matrixAutoUpdate = false;
      this.bodies.push(body);
      this.object.add(body.object);
    }
    const path = new FatLines(shared, this.table, { width: 2.2 });
    path.set(new Float32Array(segments), owner);
    this.outline = new FatLines(shared, this.ink, { width: 2.6, onTop: true });
    this.object.add(path.object, this.outline.object);
    this.bounds.setFromArray(this.positions);
    const reach = Math.max(0, ...structure.shapes.map((s) => Math.max(0, ...(s.size ?? [])) / 2));
    this.bounds.expandByScalar(reach);
  }

  private body(_b: number, shape: TrajectoryStructure['shapes'][number]): Body {
    const object = new THREE.Group();
    const size = shape.size ?? [1, 1, 1];
    if (shape.kind === 'mesh') {
      const mesh = this.context.layers.get(shape.mesh ?? '');
      if (mesh instanceof MeshLayer) return { object, vertices: mesh.vertices.slice(), triangles: mesh.triangles };
    }
    if (shape.kind === 'sphere') return { object, ...sphere(size) };
    return { object, vertices: boxCorners(size.map((s) => -s / 2), size.map((s) => s / 2)), triangles: kBoxFaces };
  }

  override update(look: Look) {
    super.update(look);
    setInk(this.ink, look.dark);
    const { i, f } = stepAt(this.times, look.time);
    const n = this.times.length;
    const next = Math.min(n - 1, i + 1);
    this.bodies.forEach((body, b) => {
      const at = (k: number) => new THREE.Vector3().fromArray(this.positions, 3 * (b * n + k));
      const turn = (k: number) => {
        const r = 4 * (b * n + k);
        return new THREE.Quaternion(this.rotations[r + 1], this.rotations[r + 2], this.rotations[r + 3], this.rotations[r]);
      };
      body.object.matrix.compose(at(i).lerp(at(next), f), turn(i).slerp(turn(next), f), new THREE.Vector3(1, 1, 1));
      body.object.matrixWorldNeedsUpdate = true;
    });
    const edges = this.marked().flatMap((b) => {
      const box = new THREE.Box3().setFromArray(this.bodies[b]!.vertices);
      const corners = boxCorners(box.min.toArray(), box.max.toArray());
      const p = new THREE.Vector3();
      for (let k = 0; k < 8; ++k) p.fromArray(corners, 3 * k).applyMatrix4(this.bodies[b]!.object.matrix).toArray(corners, 3 * k);
      return [...edgesOf(corners)];
    });
    this.outline.set(new Float32Array(edges), new Uint8Array(edges.length / 6));
  }

  override pick(ray: THREE.Ray): Hit | null {
    let best: Hit | null = null;
    this.bodies.forEach((body, b) => {
      const local = ray.clone().applyMatrix4(body.object.matrix.clone().invert());
      const hit = hitTriangles(local, body.vertices, undefined, 0, body.triangles, () => true);
      if (hit && (!best || hit.distance < best.distance)) best = { selection: { structure: this.structure.id, index: b }, distance: hit.distance };
    });
    return best;
  }

  override anchor(b: number): THREE.Vector3 {
    return new THREE.Vector3().setFromMatrixPosition(this.bodies[b]!.object.matrix);
  }
}
