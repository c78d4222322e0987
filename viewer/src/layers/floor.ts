// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A level floor: a grid, or a picture that lies on it. Not selected by a click, so that it is in nobody's way.
import * as THREE from 'three';
import type { FloorStructure } from '../format';
import { FatLines } from '../view/fat_lines';
import { ElementTable, kClip } from '../view/shared';
import { ImageLayer } from './camera';
import { Layer, type LayerContext, type Look } from './layer';

const kVertex = /* glsl */ `
out vec2 vPlace; out vec3 vWorld;
void main() {
  vPlace = uv;
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const kFragment = /* glsl */ `
precision highp float;
in vec2 vPlace; in vec3 vWorld;
uniform sampler2D uImage;
out vec4 color;
${kClip}
void main() {
  vec3 light = texture(uImage, vPlace).rgb;
  float most = max(light.r, max(light.g, light.b));
  if (most < 0.004 || cut(vWorld)) discard;
  color = vec4(0.8 * light / most, 0.9 * most);
}`;

export class FloorLayer extends Layer {
  private readonly table = new ElementTable(1);

  constructor(context: LayerContext, structure: FloorStructure) {
    super(context, structure);
    const [x0, y0] = structure.low as [number, number], [x1, y1] = structure.high as [number, number], z = structure.height;
    this.bounds.set(new THREE.Vector3(x0, y0, z), new THREE.Vector3(x1, y1, z));
    if (structure.cell) this.object.add(this.grid(context, [x0, y0, x1, y1], z, structure.cell).object);
    const image = context.layers.get(structure.image ?? '');
    if (image instanceof ImageLayer) this.object.add(this.picture(context, [x0, y0, x1, y1], z, image));
  }

  private grid(context: LayerContext, [x0, y0, x1, y1]: [number, number, number, number], z: number, cell: number): FatLines {
    const segments: number[] = [];
    const steps = (from: number, to: number) => Array.from({ length: Math.round((to - from) / cell) + 1 }, (_, i) => from + i * cell);
    const xs = steps(x0, x1), ys = steps(y0, y1);
    // Side by side, for the depth of a line that runs past the eye would be inexact.
    for (const x of xs) for (const y of ys.slice(0, -1)) segments.push(x, y, z, x, y + cell, z);
    for (const y of ys) for (const x of xs.slice(0, -1)) segments.push(x, y, z, x + cell, y, z);
    const lines = new FatLines(context.shared, this.table, { width: 1 });
    lines.set(new Float32Array(segments), new Uint8Array(segments.length / 6));
    return lines;
  }

  /** Its first row lies at the far end (high y), as the scene looks from above. Black is clear. */
  private picture(context: LayerContext, [x0, y0, x1, y1]: [number, number, number, number], z: number, image: ImageLayer): THREE.Mesh {
    const g = new THREE.BufferGeometry();
    g.setAttribute('position', new THREE.BufferAttribute(new Float32Array([x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z]), 3));
    g.setAttribute('uv', new THREE.BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
    g.setIndex([0, 1, 2, 0, 2, 3]);
    const material = new THREE.ShaderMaterial({ glslVersion: THREE.GLSL3, vertexShader: kVertex, fragmentShader: kFragment, side: THREE.DoubleSide, transparent: true, depthWrite: false,
      uniforms: { ...context.shared.all(), uImage: { value: image.texture } } });
    const mesh = new THREE.Mesh(g, material);
    mesh.frustumCulled = false;
    return mesh;
  }

  update(look: Look) {
    const v = look.dark ? 70 : 196;
    this.table.set(0, v, v, v, 255);
    this.table.commit();
  }
}
