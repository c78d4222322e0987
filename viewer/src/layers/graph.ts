// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A graph whose nodes have places: dots, edges, and forces as arrows.
import * as THREE from 'three';
import type { GraphStructure } from '../format';
import { nodeColors } from '../panels/graph';
import { FatLines } from '../view/fat_lines';
import { ElementTable } from '../view/shared';
import { TriMesh } from '../view/tri_mesh';
import { arrowScale, arrowSegments } from './arrow_lines';
import { ColoredLayer } from './colored';
import type { Hit, LayerContext, Look, View } from './layer';
import { sphere } from './solids';

export class GraphLayer extends ColoredLayer {
  private readonly places: Float32Array;
  private readonly ink = new ElementTable(3);

  constructor(context: LayerContext, structure: GraphStructure, extent: number) {
    const { model, shared } = context;
    super(context, structure, structure.node_names.length, nodeColors(model, structure));
    this.places = model.floats(structure.positions!);
    this.bounds.setFromArray(this.places);
    const radius = 0.011 * extent;
    const ball = sphere([2 * radius, 2 * radius, 2 * radius], 8);
    const n = ball.vertices.length / 3;
    const vertices = new Float32Array(3 * n * this.count), owner = new Uint32Array(n * this.count), triangles: number[] = [];
    for (let i = 0; i < this.count; ++i) {
      for (let k = 0; k < n; ++k) {
        owner[i * n + k] = i;
        for (let c = 0; c < 3; ++c) vertices[3 * (i * n + k) + c] = ball.vertices[3 * k + c]! + this.places[3 * i + c]!;
      }
      for (const t of ball.triangles) triangles.push(i * n + t);
    }
    const edges = model.stored(structure.edges);
    const m = structure.edges.count;
    const segments = new Float32Array(6 * m);
    for (let e = 0; e < m; ++e)
      for (let s = 0; s < 2; ++s) segments.set(this.places.subarray(3 * edges[2 * e + s]!, 3 * edges[2 * e + s]! + 3), 6 * e + 3 * s);
    // Within what the nodes stand for, and yet to be seen: on top, with a light rim.
    for (const [ink, width] of [[2, 5], [0, 2.2]] as const) {
      const lines = new FatLines(shared, this.ink, { width, onTop: true });
      lines.set(segments, new Uint8Array(m).fill(ink));
      this.object.add(lines.object);
    }
    this.object.add(new TriMesh(shared, this.table, vertices, owner, triangles).object);
    if (structure.vectors) this.addForces(model.floats(structure.vectors), segments, extent);
  }

  /** Forces act on the second node of an edge, drawn at the edge's middle; the longest is an eighth of the scene. */
  private addForces(vectors: Float32Array, segments: Float32Array, extent: number) {
    const middles = new Float32Array(vectors.length).map((_, i) => (segments[6 * Math.floor(i / 3) + (i % 3)]! + segments[6 * Math.floor(i / 3) + 3 + (i % 3)]!) / 2);
    const out = arrowSegments(middles, vectors, arrowScale(vectors, extent));
    for (const [ink, width] of [[2, 6.5], [1, 3.2]] as const) {
      const arrows = new FatLines(this.context.shared, this.ink, { width, onTop: true });
      arrows.set(new Float32Array(out), new Uint8Array(out.length / 6).fill(ink));
      this.object.add(arrows.object);
    }
  }

  override update(look: Look) {
    super.update(look);
    const v = look.dark ? 235 : 40, rim = look.dark ? 20 : 255;
    this.ink.set(0, v, v, v, 255);
    this.ink.set(1, 200, 30, 30, 255);
    this.ink.set(2, rim, rim, rim, 255);
    this.ink.commit();
  }

  override pick(_ray: THREE.Ray, view: View, at: THREE.Vector2): Hit | null {
    let best: Hit | null = null, nearest = 9;
    for (let i = 0; i < this.count; ++i) {
      const p = this.anchor(i);
      const depth = p.clone().sub(_ray.origin).dot(_ray.direction);
      p.project(view.camera);
      const d = Math.hypot((p.x / 2 + 0.5) * view.width - at.x, (0.5 - p.y / 2) * view.height - at.y);
      if (d < nearest && depth > 0) {
        nearest = d;
        best = { selection: { structure: this.structure.id, index: i }, distance: depth * 0.98 };
      }
    }
    return best;
  }

  override anchor(i: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.places, 3 * i);
  }
}
