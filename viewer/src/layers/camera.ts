// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Cameras as frusta with their image, and the images themselves.
import * as THREE from 'three';
import type { CameraStructure, ImageStructure } from '../format';
import { FatLines } from '../view/fat_lines';
import type { Pose } from '../view/rig';
import { ElementTable } from '../view/shared';
import { Layer, type LayerContext, type Look, type View } from './layer';

export function poseOf(c: CameraStructure): Pose {
  const matrix = new THREE.Matrix4().set(...(c.T_world_camera as Parameters<THREE.Matrix4['set']>));
  return { matrix, fx: c.fx, fy: c.fy, cx: c.cx, cy: c.cy, width: c.width, height: c.height };
}

/** An image or a video; not drawn by itself. */
export class ImageLayer extends Layer {
  readonly texture = new THREE.Texture();
  private readonly card: HTMLImageElement | HTMLVideoElement;
  private readonly urls: string[];
  private readonly frames: HTMLImageElement[] = [];
  private readonly times?: Float32Array;
  private shown = -1;

  constructor(context: LayerContext, structure: ImageStructure) {
    super(context, structure);
    const { model } = context;
    const refs = structure.data ? [structure.data] : (structure.frames ?? []);
    this.urls = refs.map((r) => URL.createObjectURL(new Blob([model.fresh(r) as BlobPart], { type: structure.format })));
    this.times = structure.times && model.floats(structure.times);
    this.texture.colorSpace = THREE.NoColorSpace;
    this.texture.generateMipmaps = false;
    this.texture.minFilter = THREE.LinearFilter;
    if (structure.format.startsWith('video/')) {
      const video = document.createElement('video');
      video.muted = true;
      video.playsInline = true;
      video.preload = 'auto';
      video.src = this.urls[0] ?? '';
      const show = () => {
        this.texture.image = video;
        this.texture.needsUpdate = true;
        context.invalidate();
      };
      video.addEventListener('loadeddata', show);
      video.addEventListener('seeked', show);
      this.card = video;
    } else {
      this.card = new Image();
      this.card.alt = structure.name;
      this.frames = this.urls.map((url, k) => {
        const image = new Image();
        image.addEventListener('load', () => {
          if (k === Math.max(0, this.shown)) this.show(k);
        });
        image.src = url;
        return image;
      });
    }
  }

  element(): HTMLElement {
    return this.card;
  }

  private show(k: number) {
    const image = this.frames[k];
    if (!image) return;
    (this.card as HTMLImageElement).src = this.urls[k]!;
    if (image.complete && image.naturalWidth > 0) {
      this.texture.image = image;
      this.texture.needsUpdate = true;
      this.context.invalidate();
    }
  }

  update(look: Look) {
    if (this.card instanceof HTMLVideoElement) {
      const start = this.times?.[0] ?? 0;
      if (Math.abs(this.card.currentTime - (look.time - start)) > 0.02) this.card.currentTime = Math.max(0, look.time - start);
      return;
    }
    let k = 0;
    if (this.times) while (k + 1 < this.times.length && this.times[k + 1]! <= look.time + 1e-6) ++k;
    if (k === this.shown) return;
    this.shown = k;
    this.show(k);
  }
}

export class CameraLayer extends Layer {
  private readonly table = new ElementTable(1);
  private readonly center = new THREE.Vector3();
  private picture?: THREE.MeshBasicMaterial;

  constructor(context: LayerContext, structure: CameraStructure, extent: number) {
    super(context, structure);
    const pose = poseOf(structure);
    const center = this.center.setFromMatrixPosition(pose.matrix);
    const depth = Math.min(0.5, 0.2 * extent);
    const at = (x: number, y: number) => new THREE.Vector3(((x - pose.cx) / pose.fx) * depth, ((y - pose.cy) / pose.fy) * depth, depth).applyMatrix4(pose.matrix);
    const corners = [at(0, 0), at(pose.width, 0), at(pose.width, pose.height), at(0, pose.height)];
    const mark = [at(pose.width * 0.44, -pose.height * 0.03), at(pose.width * 0.56, -pose.height * 0.03), at(pose.width * 0.5, -pose.height * 0.1)];
    const segments: number[] = [];
    const line = (a: THREE.Vector3, b: THREE.Vector3) => segments.push(a.x, a.y, a.z, b.x, b.y, b.z);
    corners.forEach((c, k) => { line(center, c); line(c, corners[(k + 1) % 4]!); });
    mark.forEach((c, k) => line(c, mark[(k + 1) % 3]!));
    const lines = new FatLines(context.shared, this.table, { width: 1.8 });
    lines.set(new Float32Array(segments), new Uint8Array(segments.length / 6));
    this.object.add(lines.object);
    this.bounds.setFromPoints([center, ...corners]);

    const image = context.layers.get(structure.image ?? '');
    if (image instanceof ImageLayer) {
      const g = new THREE.BufferGeometry();
      g.setAttribute('position', new THREE.BufferAttribute(new Float32Array(corners.flatMap((c) => c.toArray())), 3));
      g.setAttribute('uv', new THREE.BufferAttribute(new Float32Array([0, 1, 1, 1, 1, 0, 0, 0]), 2));
      g.setIndex([0, 1, 2, 0, 2, 3]);
      this.picture = new THREE.MeshBasicMaterial({ map: image.texture, side: THREE.DoubleSide, toneMapped: false, transparent: true, depthWrite: false });
      const mesh = new THREE.Mesh(g, this.picture);
      mesh.renderOrder = 12;
      mesh.frustumCulled = false;
      this.object.add(mesh);
    }
  }

  update(look: Look) {
    const selected = look.selection?.structure === this.structure.id;
    const v = look.dark ? 220 : 50;
    this.table.set(0, selected ? 0 : v, selected ? 114 : v, selected ? 178 : v, 255);
    this.table.commit();
  }

  /** Seen through the camera, the image lets the scene show through. */
  override frame(view: View) {
    if (this.picture) this.picture.opacity = view.eye.distanceTo(this.center) < 1e-4 ? 0.5 : 0.92;
  }

  override anchor(): THREE.Vector3 {
    return this.bounds.getCenter(new THREE.Vector3());
  }
}
