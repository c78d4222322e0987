// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Points: positions as stored (quantised), colours from tables, thinned in even steps while the view moves.
import * as THREE from 'three';
import type { Numbers } from '../decode';
import { ElementTable, kCell, kClip, kPoints, type SharedUniforms } from './shared';

const kVertex = /* glsl */ `
precision highp sampler2D;
in float aValue; in float aLabel; in vec3 aColor;
// MODE 0: label of the value, 1: scalar, 2: own colour, 3: label of the linked element
uniform float uPointSize, uPixel, uScale, uShift, uThin, uAway, uStepBack;
uniform sampler2D uTable, uLink, uRamp;
out vec3 vColor;
${kClip}
${kCell}
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  bool gone = cut(world.xyz);
#if LINKED
  vec4 link = texelFetch(uLink, cell(aLabel), 0);
  // Of points on a wall that is faded, only some stay.
  gone = gone || fract(float(gl_VertexID) * 0.6180339887) < link.r;
#else
  vec4 link = vec4(0.0, 0.0, 1.0, 1.0);
#endif
  if (gone) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); gl_PointSize = 0.0; return; }
  gl_Position = projectionMatrix * viewMatrix * world;
#if MODE == 0
  vColor = texelFetch(uTable, cell(aValue), 0).rgb;
#elif MODE == 1
  vColor = texture(uRamp, vec2(clamp(aValue * uScale + uShift, 0.002, 0.998), 0.5)).rgb;
#elif MODE == 2
  vColor = aColor;
#else
  vColor = texelFetch(uTable, cell(aLabel), 0).rgb;
#endif
#if LINKED && (MODE == 0 || MODE == 3)
  // As planes are painted, so that points and planes of one colour look alike.
  vColor = mix(vColor, vec3(1.0), 0.16);
#endif
  // Green: how far towards grey; alpha: how little towards white; blue: brightness by the direction of the plane.
  vColor = mix(mix(vColor, vec3(uAway), link.g * uStepBack), vec3(1.0), 0.22 * (1.0 - link.a)) * (MODE == 1 || MODE == 2 ? 1.0 : link.b);
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

// Point i goes to class i mod 256, and classes are drawn in an order in which each adds evenly (bits reversed).
const kClasses = 256;
const kOrder = Array.from({ length: kClasses }, (_, i) => {
  let r = 0;
  for (let b = 0; b < 8; ++b) r |= ((i >> b) & 1) << (7 - b);
  return r;
});

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
    const size = k < n ? Math.floor((n - 1 - k) / kClasses) + 1 : 0;
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
      defines: { MODE: 3, LINKED: link.count > 0 ? 1 : 0 },
      uniforms: {
        ...shared.all(),
        uPointSize: { value: 2 },
        uThin: { value: 1 },
        uStepBack: { value: 1 },
        uScale: { value: 1 },
        uShift: { value: 0 },
        uTable: { value: link.texture },
        uLink: { value: link.texture },
        uRamp: { value: null as THREE.Texture | null },
      },
    });
    this.object = new THREE.Points(this.geometry, this.material);
    this.object.frustumCulled = false;
    this.object.layers.set(kPoints);
    if (quantised) {
      this.object.matrixAutoUpdate = false;
      this.object.matrix.set(high[0]! - low[0]!, 0, 0, low[0]!, 0, high[1]! - low[1]!, 0, low[1]!, 0, 0, high[2]! - low[2]!, low[2]!, 0, 0, 0, 1);
      this.object.matrixWorldNeedsUpdate = true;
    }
  }

  set mode(mode: number) {
    if (this.material.defines.MODE === mode) return;
    this.material.defines.MODE = mode;
    this.material.needsUpdate = true;
  }

  get mode(): number {
    return this.material.defines.MODE as number;
  }

  /** Draws the points between two shares of all, in even steps; fewer ones may be larger. */
  share(from: number, to: number, grow: boolean) {
    const n = this.geometry.getAttribute('position').count;
    const start = Math.floor(n * from), end = Math.ceil(n * to);
    this.geometry.setDrawRange(start, end - start);
    this.material.uniforms.uThin!.value = grow ? 1 + 0.2 * Math.log2(1 / Math.max(to, 1 / 64)) : 1;
  }
}
