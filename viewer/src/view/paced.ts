// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Draws a scene of many points in shares: as many in a picture as there is time for; the others follow while the view rests.
import * as THREE from 'three';
import type { PointsLayer } from '../layers/points';
import { kOnTop, kPoints } from './shared';

const kBudget = 60; // ms for the points of one picture
const kFewest = 100000; // points in it at least; a third of that while the view moves
const kRest = 180; // ms without movement after which the other points follow

/** What is drawn. */
export interface Picture {
  points(): PointsLayer[];
  /** Sets the camera as it is now; null: there is nothing to draw on. */
  aim(): THREE.Camera | null;
  /** A picture stands, of some of the points at least. */
  drawn(): void;
}

export class PacedDrawing {
  private pending = 0;
  private more = 0;
  private movingSince = -Infinity;
  private rest = 0;
  /** Share of the points that the picture holds. */
  private shown = 0;
  /** Points a millisecond; 0 before it is known. */
  private speed = 0;
  private readonly waiting: (() => void)[] = [];

  constructor(private readonly renderer: THREE.WebGLRenderer, private readonly scene: THREE.Scene, private readonly picture: Picture) {}

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

  /** Draws the picture: all of it, or as many points as there is time for. */
  draw(all = false) {
    cancelAnimationFrame(this.more);
    const camera = this.picture.aim();
    if (!camera) return;
    const points = this.count();
    const moving = performance.now() - this.movingSince < kRest;
    const most = Math.max(moving ? kFewest / 3 : kFewest, this.speed * kBudget);
    this.shown = all || points <= most ? 1 : most / points;
    this.share(0, this.shown, moving);
    this.timed(points * this.shown, () => this.renderer.render(this.scene, camera));
    this.picture.drawn();
    if (this.shown === 1) this.finished();
    else if (!moving) this.more = requestAnimationFrame(() => this.drawMore(camera));
  }

  /** Adds points to the picture that stands. */
  private drawMore(camera: THREE.Camera) {
    const points = Math.max(1, this.count());
    const next = Math.min(1, this.shown + Math.max(kFewest, this.speed * kBudget) / points);
    this.share(this.shown, next, false);
    camera.layers.set(kPoints);
    if (next === 1) camera.layers.enable(kOnTop);
    this.renderer.autoClear = false;
    this.timed(points * (next - this.shown), () => this.renderer.render(this.scene, camera));
    this.renderer.autoClear = true;
    camera.layers.enableAll();
    this.shown = next;
    if (next < 1) this.more = requestAnimationFrame(() => this.drawMore(camera));
    else this.finished();
  }

  /** When all points are in the picture. */
  complete(): Promise<void> {
    return new Promise((done) => {
      if (this.shown === 1 && !this.pending) done();
      else this.waiting.push(done);
    });
  }

  private finished() {
    for (const done of this.waiting.splice(0)) done();
  }

  private count(): number {
    return this.picture.points().reduce((n, l) => n + (l.visible ? l.count : 0), 0);
  }

  private share(from: number, to: number, grow: boolean) {
    for (const l of this.picture.points()) l.mesh.share(from, to, grow);
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
}
