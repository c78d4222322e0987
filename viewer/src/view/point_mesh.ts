// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Points: positions as stored (quantised), colours from tables, thinned in even steps while the view moves.
import * as THREE from 'three';
import type { Numbers } from '../decode';
import { ElementTable, kCell, kClip, type SharedUniforms } from './shared';

const kVertex = /* glsl */ `
precision highp sampler2D;
in float aValue; in float aLabel; in vec3 aColor;
uniform int uMode; // 0: label of the value, 1: scalar, 2: own colour, 3: label of the linked element
uniform float uPointSize, uPixel, uScale, uShift, uThin;
uniform sampler2D uTable, uLink, uRamp;
out vec3 vColor;
${kClip}
${kCell}
void main() {
  vec4 link = texelFetch(uLink, cell(aLabel, textureSize(uLink, 0)), 0);
  vec4 world = modelMatrix * vec4(position, 1.0);
  // Of points on a wall that is faded, only some stay.
  float keep = fract(float(gl_VertexID) * 0.6180339887);
  if (cut(world.xyz) || keep < link.r) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); gl_PointSize = 0.0; return; }
  gl_Position = projectionMatrix * viewMatrix * world;
  if (uMode == 0) vColor = texelFetch(uTable, cell(aValue, textureSize(uTable, 0)), 0).rgb;
  else if (uMode == 1) vColor = texture(uRamp, vec2(clamp(aValue * uScale + uShift, 0.002, 0.998), 0.5)).rgb;
  else if (uMode == 2) vColor = aColor;
  else vColor = texelFetch(uTable, cell(aLabel, textureSize(uTable, 0)), 0).rgb;
  // Green: how far towards grey; blue: brightness by the direction of the plane.
  vColor = mix(vColor, vec3(0.62), link.g * 0.85) * (uMode == 2 ? 1.0 : link.b);
  gl_PointSize = uPointSize * uPixel * uThin;
}`;

const kFragment = /* glsl */ `
precision highp float;
in vec3 vColor;
uniform float uPointSize;
out vec4 color;
void main() {
  if (uPointSize > 2.5) { vec2 d = gl_PointCoord - 0.5; if (dot(d, d) > 0.25) discard; }
  color = vec4(vColor, 1.0);
}`;

// Point i goes to class i mod 16, and classes are drawn in an order in which each adds evenly.
const kClasses = 16;
const kOrder = [0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15];

export function spread<T extends Numbers>(values: T, components: number): T {
  const n = values.length / components;
  const out = new (values.constructor as { new (n: number): T })(values.length);
  let to = 0;
  for (const k of kOrder) {
    if (components === 3)
      for (let i = k; i < n; i += kClasses, to += 3) {
        out[to] = values[3 * i]!;
        out[to + 1] = values[3 * i + 1]!;
        out[to + 2] = values[3 * i + 2]!;
      }
    else
      for (let i = k; i < n; i += kClasses) out[to++] = values[i]!;
  }
  return out;
}

/** The point at a place after `spread`. */
export function pointAt(place: number, n: number): number {
  for (const k of kOrder) {
    const size = Math.floor((n - 1 - k) / kClasses) + 1;
    if (place < size) return place * kClasses + k;
    place -= size;
  }
  return -1;
}

export class PointMesh {
  readonly object: THREE.Points;
  readonly geometry = new THREE.BufferGeometry();
  readonly material: THREE.ShaderMaterial;

  /** `positions` as stored and spread; the model matrix undoes the quantisation. */
  constructor(shared: SharedUniforms, readonly positions: Numbers, low: number[] | undefined, high: number[] | undefined,
              labels: Numbers | null, link: ElementTable) {
    const n = positions.length / 3;
    const quantised = !!low && !!high;
    this.geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3, quantised));
    this.geometry.setAttribute('aLabel', new THREE.BufferAttribute(labels ?? new Uint8Array(n), 1));
    this.geometry.setAttribute('aValue', this.geometry.getAttribute('aLabel'));
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: {
        ...shared.all(),
        uMode: { value: 0 },
        uPointSize: { value: 2 },
        uThin: { value: 1 },
        uScale: { value: 1 },
        uShift: { value: 0 },
        uTable: { value: link.texture },
        uLink: { value: link.texture },
        uRamp: { value: null as THREE.Texture | null },
      },
    });
    this.object = new THREE.Points(this.geometry, this.material);
    this.object.frustumCulled = false;
    if (quantised) {
      this.object.matrixAutoUpdate = false;
      this.object.matrix.set(high[0]! - low[0]!, 0, 0, low[0]!, 0, high[1]! - low[1]!, 0, low[1]!, 0, 0, high[2]! - low[2]!, low[2]!, 0, 0, 0, 1);
      this.object.matrixWorldNeedsUpdate = true;
    }
  }

  /** Shows every 2^level-th point. */
  thin(level: number) {
    const n = this.geometry.getAttribute('position').count;
    this.geometry.setDrawRange(0, Math.ceil(n / 2 ** level));
    this.material.uniforms.uThin!.value = 1 + 0.22 * level;
  }
}
