// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Planes: filled polygons with their outlines; walls in front of the inside are faded.
import * as THREE from 'three';
import type { PlanesStructure } from '../format';
import { FatLines } from '../view/fat_lines';
import { ElementTable } from '../view/shared';
import { TriMesh } from '../view/tri_mesh';
import { choicesOf, colorsBy, dress, kRelation, relationColors } from './coloring';
import { Layer, type ColorChoice, type Hit, type LayerContext, type Look, type View } from './layer';
import { inFront, shellOf, type Shell } from './near_walls';
import { hitTriangles } from './ray';

const kFaded = 12;

export class PlanesLayer extends Layer {
  readonly shell: Shell;
  /** For points on these planes: red = share that is hidden, green = greyness, blue = light, alpha = not highlighted. */
  readonly link: ElementTable;
  fading = true;
  private readonly count: number;
  private readonly fill: ElementTable;
  private readonly edge: ElementTable;
  private readonly vertices: Float32Array;
  private readonly before?: Float32Array;
  private readonly triangles: ArrayLike<number>;
  private readonly owner: ArrayLike<number>;
  private readonly normals: Float32Array;
  private readonly faded: Uint8Array;
  private readonly segments: Float32Array;
  private readonly segmentsBefore?: Float32Array;
  private readonly segmentOwner: number[] = [];
  private readonly outline: FatLines;
  private look?: Look;
  private outlined = '';

  constructor(context: LayerContext, structure: PlanesStructure) {
    super(context, structure);
    const { model, shared } = context;
    this.count = structure.normals.count;
    this.vertices = model.floats(structure.vertices);
    this.before = structure.before && model.floats(structure.before);
    this.triangles = model.stored(structure.triangles);
    this.owner = model.stored(structure.triangle_plane);
    this.normals = model.floats(structure.normals);
    this.bounds.setFromArray(this.vertices);
    this.fill = new ElementTable(this.count);
    this.edge = new ElementTable(this.count);
    this.link = new ElementTable(this.count);
    this.faded = new Uint8Array(this.count);
    this.shell = shellOf(this.count, this.vertices, this.triangles, this.owner, this.normals, this.bounds);

    const rings = model.stored(structure.rings);
    const n = this.vertices.length / 3;
    const vertexOwner = new Float32Array(n).fill(-1);
    const from: number[] = [], to: number[] = [];
    for (let r = 0; r < structure.rings.count; ++r) {
      const first = rings[2 * r]!, plane = rings[2 * r + 1]!;
      const end = r + 1 < structure.rings.count ? rings[2 * r + 2]! : n;
      for (let v = first; v < end; ++v) {
        vertexOwner[v] = plane;
        from.push(v);
        to.push(v + 1 < end ? v + 1 : first);
        this.segmentOwner.push(plane);
      }
    }
    const gather = (source: Float32Array) => {
      const out = new Float32Array(6 * from.length);
      for (let i = 0; i < from.length; ++i)
        for (let k = 0; k < 3; ++k) {
          out[6 * i + k] = source[3 * from[i]! + k]!;
          out[6 * i + 3 + k] = source[3 * to[i]! + k]!;
        }
      return out;
    };
    this.segments = gather(this.vertices);
    this.segmentsBefore = this.before && gather(this.before);
    const mesh = new TriMesh(shared, this.fill, this.vertices, vertexOwner, this.triangles, this.before);
    const lines = new FatLines(shared, this.edge, { width: 1.2 });
    lines.set(this.segments, this.segmentOwner, this.segmentsBefore);
    this.outline = new FatLines(shared, this.edge, { width: 3, onTop: true });
    this.outline.set(new Float32Array(0), []);
    this.object.add(mesh.object, lines.object, this.outline.object);
    this.color = this.choices()[0]!.id;
  }

  override choices(): ColorChoice[] {
    return choicesOf(this.context.model, this.structure);
  }

  update(look: Look) {
    this.look = look;
    this.paint();
  }

  override frame(view: View) {
    let changed = false;
    for (let p = 0; p < this.count; ++p) {
      const faded = this.fading && inFront(this.shell, p, view) ? 1 : 0;
      if (faded !== this.faded[p]) {
        this.faded[p] = faded;
        changed = true;
      }
    }
    if (changed) this.paint();
  }

  private paint() {
    const look = this.look;
    if (!look) return;
    const { model } = this.context;
    const id = this.structure.id;
    const base = this.color === kRelation ? relationColors(model, id, look)
      : colorsBy(model, model.quantity(this.structure, this.color), this.count, [120, 150, 180]);
    const related = look.relations.get(id);
    const active = (related?.size ?? 0) > 0;
    const hover = look.hover?.structure === id ? look.hover.index : -1;
    for (let p = 0; p < this.count; ++p) {
      const relation = related?.get(p);
      const c = dress(base(p), relation, active && this.color !== kRelation, p === hover, look.dark);
      const faded = this.faded[p] === 1 && relation !== 'selected';
      this.fill.set(p, c[0], c[1], c[2], faded ? (relation ? 50 : kFaded) : 255);
      const strong = relation === 'selected' || p === hover;
      const ink = strong ? (look.dark ? 255 : 15) : 0;
      const mix = strong ? 0 : 0.45;
      this.edge.set(p, c[0] * mix + ink, c[1] * mix + ink, c[2] * mix + ink, faded && !strong ? 60 : 235);
      const light = Math.abs(0.2 * this.normals[3 * p]! + 0.55 * this.normals[3 * p + 1]! + 0.81 * this.normals[3 * p + 2]!);
      this.link.set(p, faded ? 252 : 0, active && relation === undefined ? 200 : 0, Math.round(255 * (0.58 + 0.4 * light)), strong ? 0 : 255);
    }
    this.link.set(-1, 0, active ? 200 : 0, 240, 255);
    this.fill.commit();
    this.edge.commit();
    this.link.commit();
    this.drawOutline(related, hover);
  }

  private drawOutline(related: Map<number, string> | undefined, hover: number) {
    const wanted = new Set<number>(hover >= 0 ? [hover] : []);
    if (related) for (const [p, name] of related) if (name === 'selected') wanted.add(p);
    const key = [...wanted].join();
    if (key === this.outlined) return;
    this.outlined = key;
    const picked: number[] = [];
    for (let i = 0; i < this.segmentOwner.length; ++i) if (wanted.has(this.segmentOwner[i]!)) picked.push(i);
    const take = (source: Float32Array) => {
      const out = new Float32Array(6 * picked.length);
      picked.forEach((s, i) => out.set(source.subarray(6 * s, 6 * s + 6), 6 * i));
      return out;
    };
    this.outline.set(take(this.segments), picked.map((s) => this.segmentOwner[s]!), this.segmentsBefore && take(this.segmentsBefore));
  }

  /** Planes that points on them must not hide behind: as the picture shows them now. */
  hidden(p: number): boolean {
    return this.faded[p] === 1;
  }

  override pick(ray: THREE.Ray): Hit | null {
    const hit = hitTriangles(ray, this.vertices, this.before, this.context.shared.uBefore.value, this.triangles,
      (t, p) => this.faded[this.owner[t]!] === 0 && this.context.shared.shows(p));
    return hit && { selection: { structure: this.structure.id, index: this.owner[hit.triangle]! }, distance: hit.distance };
  }

  override anchor(p: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.shell.centroids, 3 * p);
  }
}
