// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What all materials of a view share: section plane, slider between before and after, size of the picture.
import * as THREE from 'three';

/** Layers of three.js: what is drawn again when more points follow. */
export const kPoints = 1;
export const kOnTop = 2;

export class SharedUniforms {
  /** Shown is where dot(xyz, p) <= w. */
  readonly uClip = { value: new THREE.Vector4(0, 0, 0, 1) };
  readonly uBefore = { value: 0 };
  readonly uSize = { value: new THREE.Vector2(1, 1) };
  readonly uPixel = { value: 1 };
  readonly uEye = { value: new THREE.Vector3() };
  readonly uForward = { value: new THREE.Vector3(0, 1, 0) };
  readonly uOrtho = { value: 0 };
  /** Grey that things step back to. */
  readonly uAway = { value: 0.84 };

  all() {
    return { uClip: this.uClip, uBefore: this.uBefore, uSize: this.uSize, uPixel: this.uPixel, uEye: this.uEye, uForward: this.uForward, uOrtho: this.uOrtho, uAway: this.uAway };
  }

  /** Whether the section plane leaves a point of the world. */
  shows(p: THREE.Vector3): boolean {
    const c = this.uClip.value;
    return c.x * p.x + c.y * p.y + c.z * p.z <= c.w;
  }
}

export const kClip = /* glsl */ `
uniform vec4 uClip;
bool cut(vec3 p) { return dot(uClip.xyz, p) > uClip.w; }
`;

/** Cell of an element in a table: 0 is none, element i is at i + 1. */
export const kCell = /* glsl */ `
ivec2 cell(float i) { int k = int(i + 0.5); return ivec2(k & 1023, k >> 10); }
`;

/** Colours and states of elements as a texture, so that a change needs no upload of geometry. */
export class ElementTable {
  readonly data: Uint8Array;
  readonly texture: THREE.DataTexture;

  constructor(readonly count: number) {
    const width = 1024;
    const height = Math.ceil((count + 1) / width);
    this.data = new Uint8Array(width * height * 4);
    this.texture = new THREE.DataTexture(this.data, width, height, THREE.RGBAFormat, THREE.UnsignedByteType);
    this.texture.magFilter = this.texture.minFilter = THREE.NearestFilter;
    this.texture.unpackAlignment = 1;
  }

  /** Element -1 is "none". */
  set(i: number, r: number, g: number, b: number, a: number) {
    const k = 4 * (i + 1);
    this.data[k] = r;
    this.data[k + 1] = g;
    this.data[k + 2] = b;
    this.data[k + 3] = a;
  }

  commit() {
    this.texture.needsUpdate = true;
  }
}
