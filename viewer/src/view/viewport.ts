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
import { PacedDrawing } from './paced';
import type { CameraRig } from './rig';
import { SharedUniforms } from './shared';

THREE.ColorManagement.enabled = false;

const kManyPoints = 1000000; // from here on edges are not smoothed: it would cost too much in software
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
  /** From this scene's coordinates to those that the views share. */
  readonly shift = new THREE.Vector3();
  private readonly extent = new THREE.Box3();
  private readonly scene = new THREE.Scene();
  private readonly renderer: THREE.WebGLRenderer;
  private view!: View;
  private readonly pictures: PacedDrawing;
  private readonly pointLayers: PointsLayer[];
  private listeners: (() => void)[] = [];

  constructor(readonly model: Model, readonly rig: CameraRig, readonly handlers: ViewportHandlers) {
    const points = model.structures.reduce((n, s) => n + (s.kind === 'points' ? model.count(s) : 0), 0);
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: points < kManyPoints, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.scene.matrixWorldAutoUpdate = true;
    this.pictures = new PacedDrawing(this.renderer, this.scene, {
      points: () => this.pointLayers,
      aim: () => (this.aim() ? this.view.camera : null),
      drawn: () => {
        for (const f of this.listeners) f();
      },
    });
    const context: LayerContext = { model, shared: this.shared, layers: this.layers, invalidate: () => this.invalidate() };
    // Points look up the planes that they lie on, and cameras their images: those come first.
    const order = ['image', 'floor', 'mesh', 'planes', 'lines', 'boxes', 'points', 'trajectory', 'skeleton', 'camera', 'graph'];
    const rank = (kind: string) => order.indexOf(kind);
    for (const s of [...model.structures].sort((a, b) => rank(a.kind) - rank(b.kind))) {
      const layer = makeLayer(context, s);
      if (layer) this.layers.set(s.id, layer);
    }
    for (const s of model.structures) {
      const layer = this.layers.get(s.id);
      if (!layer) continue;
      this.scene.add(layer.object);
      if (!layer.bounds.isEmpty()) this.extent.union(layer.bounds);
    }
    this.pointLayers = [...this.layers.values()].filter((l) => l instanceof PointsLayer);
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
    this.pictures.invalidate();
  }

  /** The view is being moved: points are thinned as far as the graphics are slow. */
  moving() {
    this.pictures.moving();
  }

  /** Draws the picture: all of it, or as many points as there is time for; the others follow. */
  draw(all = false) {
    this.pictures.draw(all);
  }

  /** When all points are in the picture. */
  complete(): Promise<void> {
    return this.pictures.complete();
  }

  /** Sets the camera for the picture as it is now. */
  private aim() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width < 1 || height < 1) return false;
    const camera = this.rig.camera(width / height);
    camera.layers.enableAll();
    camera.matrixWorld.premultiply(new THREE.Matrix4().setPosition(this.shift.clone().negate()));
    camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
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
    return true;
  }

  setBackground(color: string) {
    this.renderer.setClearColor(color, 1);
    this.invalidate();
  }

  update(look: Look) {
    for (const layer of this.layers.values()) layer.update(look);
    this.shared.uBefore.value = look.before;
    this.shared.uAway.value = (look.dark ? 62 : 214) / 255;
    this.invalidate();
  }

  pick(x: number, y: number, mostPoints = Infinity): Hit | null {
    if (!this.aim()) return null;
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

  /** Where a point of the world is on the canvas, in CSS pixels, and whether the camera looks its way. */
  project(p: THREE.Vector3): { x: number; y: number; ahead: boolean } {
    this.aim();
    const q = p.clone().project(this.view.camera);
    return { x: ((q.x + 1) / 2) * this.view.width, y: ((1 - q.y) / 2) * this.view.height, ahead: Math.abs(q.z) <= 1 };
  }

  set fading(on: boolean) {
    for (const l of this.layers.values()) if (l instanceof PlanesLayer) l.fading = on;
    this.invalidate();
  }

  /** Where the scene is, in the coordinates that the views share. */
  get bounds(): THREE.Box3 {
    return this.extent.clone().translate(this.shift);
  }

  /** What the view fits to. */
  get focus(): THREE.Box3 {
    const focus = this.model.header.focus;
    return focus ? new THREE.Box3(new THREE.Vector3(...focus.low), new THREE.Vector3(...focus.high)).translate(this.shift) : this.bounds;
  }

  /** Whether fading shows more than it takes: the scene is one seen from inside. */
  get fadingHelps(): boolean {
    if (this.model.header.inside !== undefined) return this.model.header.inside;
    for (const l of this.layers.values()) if (l instanceof PlanesLayer && l.shell.inside > 0.06) return true;
    return false;
  }

  set pointSize(size: number) {
    for (const l of this.pointLayers) l.mesh.material.uniforms.uPointSize!.value = size;
    this.invalidate();
  }

  dispose() {
    this.renderer.dispose();
  }
}
