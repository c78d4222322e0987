// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Vectors at places, as impulses at a contact: drawn on top, with a light rim.
import * as THREE from 'three';
import type { ArrowsStructure } from '../format';
import { labelColor } from '../palette';
import { FatLines } from '../view/fat_lines';
import { ElementTable } from '../view/shared';
import { arrowScale, arrowSegments } from './arrow_lines';
import { ColoredLayer } from './colored';
import type { Hit, LayerContext, Look, View } from './layer';
import { hitSegments } from './ray';

export class ArrowsLayer extends ColoredLayer {
  private readonly segments: Float32Array;
  private readonly rim = new ElementTable(1);

  constructor(context: LayerContext, structure: ArrowsStructure, extent: number) {
    super(context, structure, structure.origins.count, (i) => labelColor(i));
    const origins = context.model.floats(structure.origins), vectors = context.model.floats(structure.vectors);
    this.segments = new Float32Array(arrowSegments(origins, vectors, arrowScale(vectors, extent)));
    const owner = Uint32Array.from({ length: this.segments.length / 6 }, (_, i) => Math.floor(i / 3));
    const rim = new FatLines(context.shared, this.rim, { width: 6.5, onTop: true });
    rim.set(this.segments, new Uint8Array(owner.length));
    const arrows = new FatLines(context.shared, this.table, { width: 3.2, onTop: true });
    arrows.set(this.segments, owner);
    this.object.add(rim.object, arrows.object);
    this.bounds.setFromArray(origins);
  }

  override update(look: Look) {
    super.update(look);
    const v = look.dark ? 20 : 255;
    this.rim.set(0, v, v, v, 255);
    this.rim.commit();
  }

  override pick(ray: THREE.Ray, view: View, at: THREE.Vector2): Hit | null {
    const hit = hitSegments(this.segments, view.camera, view.width, view.height, at, 7);
    if (!hit) return null;
    const index = Math.floor(hit.index / 3);
    return { selection: { structure: this.structure.id, index }, distance: this.anchor(index).sub(ray.origin).dot(ray.direction) * 0.9 };
  }

  override anchor(i: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.segments, 18 * i + 3);
  }
}
