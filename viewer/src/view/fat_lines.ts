// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Line segments some pixels wide, solid or dashed, coloured by a table of elements.
import * as THREE from 'three';
import { ElementTable, kCell, kClip, kOnTop, type SharedUniforms } from './shared';

const kVertex = /* glsl */ `
precision highp sampler2D;
in vec3 aStart; in vec3 aEnd; in vec3 aStartBefore; in vec3 aEndBefore; in float aElement;
uniform vec2 uSize; uniform float uPixel, uWidth, uBefore, uHasBefore, uBias, uShade;
uniform sampler2D uTable;
out vec4 vColor; out float vAlong; out vec3 vWorld;
${kCell}
void main() {
  vec4 entry = texelFetch(uTable, cell(aElement), 0);
  float t = uBefore * uHasBefore;
  vec4 wa = modelMatrix * vec4(mix(aStart, aStartBefore, t), 1.0);
  vec4 wb = modelMatrix * vec4(mix(aEnd, aEndBefore, t), 1.0);
  vec4 a = projectionMatrix * viewMatrix * wa;
  vec4 b = projectionMatrix * viewMatrix * wb;
  vWorld = mix(wa.xyz, wb.xyz, position.x);
  // Cut what lies behind the eye.
  if (a.w < 1e-3 || b.w < 1e-3) {
    if (a.w < 1e-3 && b.w < 1e-3) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
    float s = (1e-3 - a.w) / (b.w - a.w);
    vec4 m = mix(a, b, s);
    if (a.w < 1e-3) a = m; else b = m;
  }
  vec2 pa = a.xy / a.w * uSize * 0.5, pb = b.xy / b.w * uSize * 0.5;
  vec2 d = pb - pa;
  float len = length(d);
  d = len > 1e-4 ? d / len : vec2(1.0, 0.0);
  float half_width = 0.5 * max(uWidth * uPixel, 1.0);
  vec4 p = position.x < 0.5 ? a : b;
  vec2 off = (vec2(-d.y, d.x) * position.y + d * (position.x * 2.0 - 1.0) * 0.4) * half_width;
  p.xy += off / (uSize * 0.5) * p.w;
  p.z -= uBias * p.w;
  gl_Position = p;
  vColor = vec4(entry.rgb * uShade, entry.a);
  vAlong = position.x * len;
}`;

const kFragment = /* glsl */ `
precision highp float;
in vec4 vColor; in float vAlong; in vec3 vWorld;
uniform float uDash, uPixel, uOpacity;
out vec4 color;
${kClip}
void main() {
  if (cut(vWorld) || vColor.a < 0.02) discard;
  if (uDash > 0.0 && mod(vAlong / uPixel, uDash * 2.0) > uDash) discard;
  color = vec4(vColor.rgb, vColor.a * uOpacity);
}`;

export interface FatLineOptions {
  width?: number;
  dash?: number;
  /** Towards the eye, in depth of the picture. */
  bias?: number;
  opacity?: number;
  /** Darker than the element. */
  shade?: number;
  onTop?: boolean;
}

export class FatLines {
  readonly object: THREE.Mesh;
  private readonly geometry = new THREE.InstancedBufferGeometry();
  private readonly material: THREE.ShaderMaterial;

  constructor(shared: SharedUniforms, table: ElementTable, options: FatLineOptions = {}) {
    this.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.geometry.instanceCount = 0;
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      transparent: true,
      depthWrite: !options.onTop,
      depthTest: !options.onTop,
      side: THREE.DoubleSide,
      uniforms: {
        ...shared.all(),
        uTable: { value: table.texture },
        uWidth: { value: options.width ?? 1.5 },
        uDash: { value: options.dash ?? 0 },
        uBias: { value: options.bias ?? 2e-5 },
        uOpacity: { value: options.opacity ?? 1 },
        uShade: { value: options.shade ?? 1 },
        uHasBefore: { value: 0 },
      },
    });
    this.object = new THREE.Mesh(this.geometry, this.material);
    this.object.frustumCulled = false;
    this.object.renderOrder = options.onTop ? 20 : 5;
    if (options.onTop) this.object.layers.set(kOnTop);
  }

  set width(value: number) {
    this.material.uniforms.uWidth!.value = value;
  }

  /** Six numbers a segment. */
  set(segments: Float32Array, elements: ArrayLike<number>, before?: Float32Array) {
    const put = (names: [string, string], data: Float32Array) => {
      const buffer = new THREE.InstancedInterleavedBuffer(data, 6);
      this.geometry.setAttribute(names[0], new THREE.InterleavedBufferAttribute(buffer, 3, 0));
      this.geometry.setAttribute(names[1], new THREE.InterleavedBufferAttribute(buffer, 3, 3));
    };
    put(['aStart', 'aEnd'], segments);
    put(['aStartBefore', 'aEndBefore'], before ?? segments);
    this.material.uniforms.uHasBefore!.value = before ? 1 : 0;
    const ids = new Float32Array(segments.length / 6);
    for (let i = 0; i < ids.length; ++i) ids[i] = elements[i]! + 1;
    this.geometry.setAttribute('aElement', new THREE.InstancedBufferAttribute(ids, 1));
    this.geometry.instanceCount = ids.length;
    this.object.visible = ids.length > 0;
  }

  /** Other ends for the same segments. */
  move(segments: Float32Array) {
    const a = this.geometry.getAttribute('aStart') as THREE.InterleavedBufferAttribute | undefined;
    if (!a || a.data.array.length !== segments.length) return;
    (a.data.array as Float32Array).set(segments);
    a.data.needsUpdate = true;
  }
}
