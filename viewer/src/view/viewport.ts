// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// One scene in 3D: a canvas that is drawn when something changed, and what lies under a place of it.
import * as THREE from 'three';
import { makeLayer } from '../layers/make';
import type { Hit, Layer, LayerContext, Look, View } from '../layers/layer';
import { PlanesLayer } from '../layers/planes';
import { PointsLayer } from '../layers/points';
import type { Model, Selection } from '../model';
import { addGestures } from './gestures';
import type { CameraRig } from './rig';
import { SharedUniforms } from './shared';

THREE.ColorManagement.enabled = false;

const kSlow = 45; // ms between pictures from which on points are thinned while the view moves
const kRest = 180; // ms after which the full density comes back
const kHoverPoints = 120000;

export interface ViewportHandlers {
  select(selection: Selection | null): void;
  hover(selection: Selection | null): void;
  activate(): void;
}

export class Viewport {
  readonly canvas = document.createElement('canvas');
  readonly layers = new Map<string, Layer>();
  readonly shared = new SharedUniforms();
  readonly bounds = new THREE.Box3();
  private readonly scene = new THREE.Scene();
  private readonly renderer: THREE.WebGLRenderer;
  private view!: View;
  private pending = 0;
  private level = 0;
  private movingSince = 0;
  private lastDrawn = 0;
  private rest = 0;
  private listeners: (() => void)[] = [];

  constructor(readonly model: Model, readonly rig: CameraRig, readonly handlers: ViewportHandlers) {
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: false, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.scene.matrixWorldAutoUpdate = true;
    const context: LayerContext = { model, shared: this.shared, layers: this.layers, invalidate: () => this.invalidate() };
    // Points look up the planes that they lie on, and cameras their images: those come first.
    const order = ['image', 'mesh', 'planes', 'lines', 'boxes', 'points', 'trajectory', 'skeleton', 'camera', 'graph'];
    const rank = (kind: string) => order.indexOf(kind);
    for (const s of [...model.structures].sort((a, b) => rank(a.kind) - rank(b.kind))) {
      const layer = makeLayer(context, s);
      if (layer) this.layers.set(s.id, layer);
    }
    for (const s of model.structures) {
      const layer = this.layers.get(s.id);
      if (!layer) continue;
      this.scene.add(layer.object);
      if (!layer.bounds.isEmpty()) this.bounds.union(layer.bounds);
    }
    this.canvas.tabIndex = 0;
    rig.onChange(() => this.invalidate());
    addGestures(this.canvas, rig, {
      click: (x, y) => {
        handlers.activate();
        handlers.select(this.pick(x, y)?.selection ?? null);
      },
      hover: (x, y) => this.hoverSoon(x, y),
      leave: () => handlers.hover(null),
      moving: () => this.moving(),
    });
  }

  onFrame(f: () => void) {
    this.listeners.push(f);
  }

  resize(width: number, height: number) {
    if (width < 1 || height < 1) return;
    this.renderer.setSize(width, height, false);
    this.invalidate();
  }

  get aspect(): number {
    return this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
  }

  invalidate() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
    });
  }

  /** The view is being moved: thin points if pictures come slowly. */
  moving() {
    const now = performance.now();
    if (now - this.movingSince > 400) this.lastDrawn = 0;
    this.movingSince = now;
    window.clearTimeout(this.rest);
    this.rest = window.setTimeout(() => {
      if (this.level > 0) {
        this.setLevel(0);
        this.draw();
      }
      this.lastDrawn = 0;
    }, kRest);
  }

  private setLevel(level: number) {
    this.level = level;
    for (const l of this.layers.values()) if (l instanceof PointsLayer) l.mesh.thin(l.count < 50000 ? 0 : level);
  }

  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width < 1 || height < 1) return;
    const now = performance.now();
    if (now - this.movingSince < kRest) {
      const took = this.lastDrawn > 0 ? now - this.lastDrawn : 0;
      const points = this.visiblePoints();
      if (took > kSlow && this.level < 4) this.setLevel(this.level + 1);
      else if (this.lastDrawn === 0 && points > 600000) this.setLevel(Math.min(4, Math.max(this.level, Math.ceil(Math.log2(points / 600000)))));
      this.lastDrawn = now;
    }
    const camera = this.rig.camera(width / height);
    const eye = new THREE.Vector3().setFromMatrixPosition(camera.matrixWorld);
    const forward = new THREE.Vector3(0, 0, -1).transformDirection(camera.matrixWorld);
    this.view = { camera, ortho: camera instanceof THREE.OrthographicCamera, eye, forward, width, height };
    const ratio = this.renderer.getPixelRatio();
    this.shared.uSize.value.set(width * ratio, height * ratio);
    this.shared.uPixel.value = ratio;
    this.shared.uEye.value.copy(eye);
    this.shared.uForward.value.copy(forward);
    this.shared.uOrtho.value = this.view.ortho ? 1 : 0;
    for (const layer of this.layers.values()) if (layer.visible) layer.frame(this.view);
    this.renderer.render(this.scene, camera);
    for (const f of this.listeners) f();
  }

  private visiblePoints(): number {
    let n = 0;
    for (const l of this.layers.values()) if (l instanceof PointsLayer && l.visible) n += l.count;
    return n;
  }

  /** Waits until the graphics have really drawn. */
  finish() {
    this.draw();
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  setBackground(color: string) {
    this.renderer.setClearColor(color, 1);
    this.invalidate();
  }

  update(look: Look) {
    for (const layer of this.layers.values()) layer.update(look);
    this.shared.uBefore.value = look.before;
    this.invalidate();
  }

  pick(x: number, y: number, mostPoints = Infinity): Hit | null {
    if (!this.view) return null;
    const { camera, width, height } = this.view;
    const caster = new THREE.Raycaster();
    const at = new THREE.Vector2(x, y);
    const ndc = new THREE.Vector3((x / width) * 2 - 1, 1 - (y / height) * 2, -1).applyMatrix4(camera.projectionMatrixInverse).applyMatrix4(camera.matrixWorld);
    const far = new THREE.Vector3((x / width) * 2 - 1, 1 - (y / height) * 2, 1).applyMatrix4(camera.projectionMatrixInverse).applyMatrix4(camera.matrixWorld);
    caster.ray.set(ndc, far.sub(ndc).normalize());
    let best: Hit | null = null;
    for (const layer of this.layers.values()) {
      if (!layer.visible) continue;
      const hit = layer instanceof PointsLayer ? layer.pick(caster.ray, this.view, at, mostPoints) : layer.pick(caster.ray, this.view, at);
      if (hit && (!best || hit.distance < best.distance)) best = hit;
    }
    return best;
  }

  private hoverAt: [number, number] | null = null;
  private hoverSoon(x: number, y: number) {
    const first = !this.hoverAt;
    this.hoverAt = [x, y];
    if (!first) return;
    requestAnimationFrame(() => {
      const [hx, hy] = this.hoverAt!;
      this.hoverAt = null;
      const hit = this.pick(hx, hy, kHoverPoints);
      this.canvas.style.cursor = hit ? 'pointer' : '';
      this.handlers.hover(hit?.selection ?? null);
    });
  }

  /** Where a point of the world is on the canvas, in CSS pixels. */
  project(p: THREE.Vector3): { x: number; y: number } {
    const q = p.clone().project(this.view.camera);
    return { x: ((q.x + 1) / 2) * this.view.width, y: ((1 - q.y) / 2) * this.view.height };
  }

  set fading(on: boolean) {
    for (const l of this.layers.values()) if (l instanceof PlanesLayer) l.fading = on;
    this.invalidate();
  }

  /** Whether fading shows more than it takes: something lies inside. */
  get fadingHelps(): boolean {
    for (const l of this.layers.values()) if (l instanceof PlanesLayer && l.shell.inside > 0.06) return true;
    return false;
  }

  set pointSize(size: number) {
    for (const l of this.layers.values()) if (l instanceof PointsLayer) l.mesh.material.uniforms.uPointSize!.value = size;
    this.invalidate();
  }

  dispose() {
    this.renderer.dispose();
  }
}
