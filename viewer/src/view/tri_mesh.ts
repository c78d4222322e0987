// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Flat triangles coloured by a table of elements; opaque ones first, then those that are faded.
import * as THREE from 'three';
import { ElementTable, kCell, kClip, type SharedUniforms } from './shared';

const kVertex = /* glsl */ `
precision highp sampler2D;
in float aElement; in vec3 aBefore;
uniform float uBefore, uHasBefore;
uniform sampler2D uTable;
out vec4 vColor; out vec3 vWorld;
${kCell}
void main() {
  vec4 entry = texelFetch(uTable, cell(aElement), 0);
  vec4 world = modelMatrix * vec4(mix(position, aBefore, uBefore * uHasBefore), 1.0);
  vWorld = world.xyz;
  vColor = entry;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const kFragment = /* glsl */ `
precision highp float;
in vec4 vColor; in vec3 vWorld;
uniform float uOpaque, uOpacity, uOrtho;
uniform vec3 uEye, uForward;
out vec4 color;
${kClip}
void main() {
  float alpha = vColor.a * uOpacity;
  if (alpha < 0.004 || (uOpaque > 0.5) != (alpha > 0.99) || cut(vWorld)) discard;
  vec3 n = normalize(cross(dFdx(vWorld), dFdy(vWorld)));
  vec3 ray = uOrtho > 0.5 ? uForward : normalize(vWorld - uEye);
  float facing = abs(dot(n, ray));
  // A light from above and one from the side, so that walls of one colour stay apart.
  float light = 0.54 + 0.08 * facing + 0.40 * abs(dot(n, vec3(0.20, 0.55, 0.81)));
  color = vec4(mix(vColor.rgb, vec3(1.0), 0.16) * light, alpha);
}`;

export class TriMesh {
  readonly object = new THREE.Group();
  private readonly geometry = new THREE.BufferGeometry();
  private readonly materials: THREE.ShaderMaterial[];

  /** `elements`: one a vertex. */
  constructor(shared: SharedUniforms, table: ElementTable, positions: Float32Array, elements: ArrayLike<number>,
              triangles: ArrayLike<number>, before?: Float32Array, opacity = 1) {
    const g = this.geometry;
    g.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    g.setAttribute('aBefore', new THREE.BufferAttribute(before ?? positions, 3));
    const ids = new Float32Array(positions.length / 3);
    for (let i = 0; i < ids.length; ++i) ids[i] = elements[i]! + 1;
    g.setAttribute('aElement', new THREE.BufferAttribute(ids, 1));
    g.setIndex(new THREE.BufferAttribute(Uint32Array.from(triangles), 1));
    this.materials = [1, 0].map((opaque) => new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      side: THREE.DoubleSide,
      transparent: opaque === 0,
      depthWrite: opaque === 1,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
      uniforms: {
        ...shared.all(),
        uTable: { value: table.texture },
        uOpaque: { value: opaque },
        uOpacity: { value: opacity },
        uHasBefore: { value: before ? 1 : 0 },
      },
    }));
    for (const [k, material] of this.materials.entries()) {
      const mesh = new THREE.Mesh(g, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = k === 0 ? 1 : 10;
      this.object.add(mesh);
    }
  }

  set opacity(value: number) {
    for (const m of this.materials) m.uniforms.uOpacity!.value = value;
  }

  move(positions: Float32Array) {
    const a = this.geometry.getAttribute('position') as THREE.BufferAttribute;
    (a.array as Float32Array).set(positions);
    a.needsUpdate = true;
  }
}
