// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A triangle mesh, in one colour or by a quantity of its vertices.
import * as THREE from 'three';
import type { MeshStructure } from '../format';
import { TriMesh } from '../view/tri_mesh';
import { ColoredLayer } from './colored';
import type { Hit, LayerContext } from './layer';
import { hitTriangles } from './ray';

export class MeshLayer extends ColoredLayer {
  readonly vertices: Float32Array;
  readonly triangles: ArrayLike<number>;

  constructor(context: LayerContext, structure: MeshStructure) {
    super(context, structure, structure.vertices.count, () => [160, 172, 184]);
    this.vertices = context.model.floats(structure.vertices);
    this.triangles = context.model.stored(structure.triangles);
    const owner = Array.from({ length: this.count }, (_, i) => i);
    this.object.add(new TriMesh(context.shared, this.table, this.vertices, owner, this.triangles).object);
    if (structure.visible !== false) this.bounds.setFromArray(this.vertices);
  }

  override pick(ray: THREE.Ray): Hit | null {
    const hit = hitTriangles(ray, this.vertices, undefined, 0, this.triangles, (_t, p) => this.context.shared.shows(p));
    return hit && { selection: { structure: this.structure.id, index: this.triangles[3 * hit.triangle]! }, distance: hit.distance };
  }

  override anchor(i: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.vertices, 3 * i);
  }
}
