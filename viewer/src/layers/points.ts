// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Points, coloured by a quantity of their own or of the structure that they belong to.
import * as THREE from 'three';
import type { Numbers } from '../decode';
import { storedMax } from '../decode';
import type { PointsStructure, Quantity } from '../format';
import { labelColor, scalarColor } from '../palette';
import { PointMesh, pointAt, spread } from '../view/point_mesh';
import { ElementTable } from '../view/shared';
import { choicesOf, colorsBy, kRelation, rangeOf, relationColors } from './coloring';
import { Layer, type ColorChoice, type Hit, type LayerContext, type Look, type View } from './layer';
import { PlanesLayer } from './planes';

const kPickRadius = 5;

/** Labels one up, so that none is 0, in as few bytes as they need. */
function labelsUp(labels: Numbers): { values: Numbers; most: number } {
  let most = -1;
  for (let i = 0; i < labels.length; ++i) if ((labels[i]! | 0) > most) most = labels[i]! | 0;
  const values = most < 65534 ? new Uint16Array(labels.length) : new Float32Array(labels.length);
  for (let i = 0; i < labels.length; ++i) values[i] = (labels[i]! | 0) + 1;
  return { values, most };
}

function rampTexture(): THREE.DataTexture {
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) data.set([...scalarColor(i / 255), 255], 4 * i);
  const texture = new THREE.DataTexture(data, 256, 1);
  texture.needsUpdate = true;
  return texture;
}

export class PointsLayer extends Layer {
  readonly mesh: PointMesh;
  readonly count: number;
  readonly linkQuantity?: Quantity;
  private readonly labels: Numbers | null = null;
  private readonly planes?: PlanesLayer;
  private readonly table: ElementTable;
  private readonly own = new Map<string, { attribute: THREE.BufferAttribute; table?: ElementTable; scale: number; shift: number }>();
  private readonly low: number[];
  private readonly step: number[];
  private look?: Look;

  constructor(context: LayerContext, structure: PointsStructure) {
    super(context, structure);
    const { model, shared } = context;
    this.count = structure.positions.count;
    const ref = structure.positions;
    const positions = spread(model.fresh(ref), 3);
    this.low = ref.low ?? [0, 0, 0];
    this.step = [0, 1, 2].map((k) => (ref.low && ref.high ? (ref.high[k]! - ref.low[k]!) / storedMax(ref) : 1));
    this.linkQuantity = model.link(structure);
    let linked = 0;
    if (this.linkQuantity) {
      const layer = context.layers.get(this.linkQuantity.structure!);
      if (layer instanceof PlanesLayer) this.planes = layer;
      this.labels = labelsUp(spread(model.fresh(this.linkQuantity.array), 1)).values;
      linked = model.count(model.get(this.linkQuantity.structure)!);
    }
    this.table = new ElementTable(linked);
    const plain = new ElementTable(linked);
    for (let i = -1; i < linked; ++i) plain.set(i, 0, 0, 245, 255);
    plain.commit();
    this.mesh = new PointMesh(shared, positions, ref.low, ref.high, this.labels, this.planes?.link ?? plain);
    this.object.add(this.mesh.object);
    this.boundsOf(positions);
    this.setColor(this.choices()[0]!.id);
  }

  private boundsOf(p: Numbers) {
    // The box of most points: outliers must not make the scene small.
    const n = p.length / 3;
    const step = Math.max(1, Math.floor(n / 20000));
    for (let k = 0; k < 3; ++k) {
      const values: number[] = [];
      for (let i = 0; i < n; i += step) {
        const v = this.low[k]! + p[3 * i + k]! * this.step[k]!;
        if (Number.isFinite(v)) values.push(v);
      }
      values.sort((a, b) => a - b);
      if (values.length === 0) return;
      const axis = (['x', 'y', 'z'] as const)[k]!;
      this.bounds.min[axis] = values[Math.floor(0.002 * values.length)]!;
      this.bounds.max[axis] = values[Math.ceil(0.998 * values.length) - 1]!;
    }
  }

  override choices(): ColorChoice[] {
    const { model } = this.context;
    return choicesOf(model, this.structure, model.get(this.linkQuantity?.structure));
  }

  override setColor(id: string) {
    super.setColor(id);
    const { uniforms } = this.mesh.material;
    const g = this.mesh.geometry;
    const q = this.context.model.quantity(this.structure, id);
    if (!q || q === this.linkQuantity || q.kind === 'vector') {
      this.mesh.mode = 3;
      uniforms.uTable!.value = this.table.texture;
    } else if (q.kind === 'color') {
      if (!g.hasAttribute('aColor'))
        g.setAttribute('aColor', new THREE.BufferAttribute(spread(this.context.model.fresh(q.array) as Uint8Array, 3), 3, true));
      this.mesh.mode = 2;
    } else {
      const value = this.ownAttribute(q);
      g.setAttribute('aValue', value.attribute);
      this.mesh.mode = q.kind === 'label' ? 0 : 1;
      if (value.table) uniforms.uTable!.value = value.table.texture;
      uniforms.uScale!.value = value.scale;
      uniforms.uShift!.value = value.shift;
      uniforms.uRamp!.value ??= rampTexture();
    }
    if (this.look) this.update(this.look);
  }

  private ownAttribute(q: Quantity) {
    let own = this.own.get(q.id);
    if (own) return own;
    const { model } = this.context;
    const values = spread(model.fresh(q.array), 1);
    if (q.kind === 'label') {
      const up = labelsUp(values);
      const table = new ElementTable(up.most + 1);
      for (let i = -1; i <= up.most; ++i) table.set(i, ...labelColor(i), 255);
      table.commit();
      own = { attribute: new THREE.BufferAttribute(up.values, 1), table, scale: 1, shift: 0 };
    } else {
      const [low, high] = rangeOf(model, q);
      const quantised = q.array.low && q.array.high;
      const a = quantised ? q.array.low![0]! : 0;
      const b = quantised ? q.array.high![0]! : 1;
      own = { attribute: new THREE.BufferAttribute(values, 1, !!quantised), scale: (b - a) / (high - low || 1), shift: (a - low) / (high - low || 1) };
    }
    this.own.set(q.id, own);
    return own;
  }

  update(look: Look) {
    this.look = look;
    const { model } = this.context;
    this.mesh.material.uniforms.uStepBack!.value = this.color === kRelation ? 0 : 1;
    if (this.mesh.mode !== 3) return;
    const s = model.get(this.linkQuantity?.structure);
    const n = this.table.count;
    let color: (i: number) => [number, number, number] = () => [110, 140, 170];
    if (s && this.color === kRelation) color = relationColors(model, s.id, look);
    else if (s && this.color.startsWith('@')) color = colorsBy(model, model.quantity(s, this.color.slice(1)), n, [110, 140, 170]);
    else if (s) color = labelColor;
    for (let i = 0; i < n; ++i) this.table.set(i, ...color(i), 255);
    this.table.set(-1, ...(s ? labelColor(-1) : color(0)), 255);
    this.table.commit();
  }

  /** The visible point nearest to a place of the picture, in pixels; with a label that links, its element. */
  override pick(_ray: THREE.Ray, view: View, at: THREE.Vector2, most = Infinity): Hit | null {
    const { shared } = this.context;
    const p = this.mesh.positions;
    const n = p.length / 3;
    const m = new THREE.Matrix4().multiplyMatrices(view.camera.projectionMatrix, view.camera.matrixWorldInverse).elements as number[];
    const [lx, ly, lz] = this.low as [number, number, number];
    const [sx, sy, sz] = this.step as [number, number, number];
    const tx = (at.x / view.width) * 2 - 1, ty = 1 - (at.y / view.height) * 2;
    const rx = (kPickRadius * 2) / view.width, ry = (kPickRadius * 2) / view.height;
    const clip = shared.uClip.value;
    let place = -1, nearest = Infinity;
    for (let i = 0, end = Math.min(n, most); i < end; ++i) {
      const x = lx + p[3 * i]! * sx, y = ly + p[3 * i + 1]! * sy, z = lz + p[3 * i + 2]! * sz;
      const w = m[3]! * x + m[7]! * y + m[11]! * z + m[15]!;
      if (w <= 0) continue;
      const dx = (m[0]! * x + m[4]! * y + m[8]! * z + m[12]!) / w - tx;
      if (dx > rx || dx < -rx) continue;
      const dy = (m[1]! * x + m[5]! * y + m[9]! * z + m[13]!) / w - ty;
      if (dy > ry || dy < -ry) continue;
      const depth = (x - view.eye.x) * view.forward.x + (y - view.eye.y) * view.forward.y + (z - view.eye.z) * view.forward.z;
      if (depth >= nearest || clip.x * x + clip.y * y + clip.z * z > clip.w) continue;
      if (this.labels && this.planes && this.labels[i]! > 0 && this.planes.hidden(this.labels[i]! - 1)) continue;
      nearest = depth;
      place = i;
    }
    if (place < 0) return null;
    const label = this.labels ? this.labels[place]! - 1 : -1;
    const selection = label >= 0 ? { structure: this.linkQuantity!.structure!, index: label }
      : { structure: this.structure.id, index: pointAt(place, n) };
    const point = new THREE.Vector3(lx + p[3 * place]! * sx, ly + p[3 * place + 1]! * sy, lz + p[3 * place + 2]! * sz);
    return { selection, distance: point.sub(_ray.origin).dot(_ray.direction) };
  }
}
