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
import { kOnTop, kPoints, SharedUniforms } from './shared';

THREE.ColorManagement.enabled = false;

const kBudget = 60; // ms for the points of one picture
const kFewest = 100000; // points in it at least; a third of that while the view moves
const kRest = 180; // ms without movement after which the other points follow
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
  private pending = 0;
  private more = 0;
  private movingSince = -Infinity;
  private rest = 0;
  /** Share of the points that the picture holds. */
  private shown = 0;
  /** Points a millisecond; 0 before it is known. */
  private speed = 0;
  private readonly waiting: (() => void)[] = [];
  private listeners: (() => void)[] = [];

  constructor(readonly model: Model, readonly rig: CameraRig, readonly handlers: ViewportHandlers) {
    const points = model.structures.reduce((n, s) => n + (s.kind === 'points' ? model.count(s) : 0), 0);
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: points < kManyPoints, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.scene.matrixWorldAutoUpdate = true;
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

  /** The view is being moved: points are thinned as far as the graphics are slow. */
  moving() {
    this.movingSince = performance.now();
    window.clearTimeout(this.rest);
    this.rest = window.setTimeout(() => this.invalidate(), kRest + 10);
  }

  private share(from: number, to: number, grow: boolean) {
    for (const l of this.layers.values()) if (l instanceof PointsLayer) l.mesh.share(from, to, grow);
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

  /** Draws the picture: all of it, or as many points as there is time for; the others follow. */
  draw(all = false) {
    cancelAnimationFrame(this.more);
    if (!this.aim()) return;
    const points = this.visiblePoints();
    const moving = performance.now() - this.movingSince < kRest;
    const most = Math.max(moving ? kFewest / 3 : kFewest, this.speed * kBudget);
    this.shown = all || points <= most ? 1 : most / points;
    this.share(0, this.shown, moving);
    this.timed(points * this.shown, () => this.renderer.render(this.scene, this.view.camera));
    for (const f of this.listeners) f();
    if (this.shown < 1) {
      if (!moving) this.more = requestAnimationFrame(() => this.drawMore());
    } else this.finished();
  }

  /** Adds points to the picture that stands. */
  private drawMore() {
    const points = Math.max(1, this.visiblePoints());
    const next = Math.min(1, this.shown + Math.max(kFewest, this.speed * kBudget) / points);
    this.share(this.shown, next, false);
    const { camera } = this.view;
    camera.layers.set(kPoints);
    if (next === 1) camera.layers.enable(kOnTop);
    this.renderer.autoClear = false;
    this.timed(points * (next - this.shown), () => this.renderer.render(this.scene, camera));
    this.renderer.autoClear = true;
    camera.layers.enableAll();
    this.shown = next;
    if (next < 1) this.more = requestAnimationFrame(() => this.drawMore());
    else this.finished();
  }

  /** Learns how many points a millisecond the graphics draw. */
  private timed(points: number, render: () => void) {
    const start = performance.now();
    render();
    if (points < 50000) return;
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const speed = points / Math.max(0.5, performance.now() - start);
    this.speed = this.speed === 0 ? speed : 0.5 * (this.speed + speed);
  }

  private finished() {
    for (const done of this.waiting.splice(0)) done();
  }

  /** When all points are in the picture. */
  complete(): Promise<void> {
    return new Promise((done) => {
      if (this.shown === 1 && !this.pending) done();
      else this.waiting.push(done);
    });
  }

  private visiblePoints(): number {
    let n = 0;
    for (const l of this.layers.values()) if (l instanceof PointsLayer && l.visible) n += l.count;
    return n;
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
    for (const l of this.layers.values()) if (l instanceof PointsLayer) l.mesh.material.uniforms.uPointSize!.value = size;
    this.invalidate();
  }

  dispose() {
    this.renderer.dispose();
  }
}
