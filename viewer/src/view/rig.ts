// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Where the camera stands; shared by two views, so that they move together.
import * as THREE from 'three';

export type ViewName = 'perspective' | 'top' | 'front' | 'side';

/** A camera of the scene that is looked through. */
export interface Pose {
  matrix: THREE.Matrix4;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
  width: number;
  height: number;
}

const kFov = 40;
const kMostElevation = Math.PI / 2 - 1e-4;

export class CameraRig {
  readonly target = new THREE.Vector3();
  azimuth = -2.2;
  elevation = 0.6;
  distance = 10;
  ortho = false;
  flat = false;
  through: Pose | null = null;
  readonly bounds = new THREE.Sphere(new THREE.Vector3(), 5);
  private readonly box = new THREE.Box3();
  private readonly listeners: (() => void)[] = [];

  onChange(f: () => void) {
    this.listeners.push(f);
  }

  changed() {
    for (const f of this.listeners) f();
  }

  setBounds(box: THREE.Box3) {
    this.box.copy(box.isEmpty() ? new THREE.Box3(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1)) : box);
    this.box.getBoundingSphere(this.bounds);
    if (!(this.bounds.radius > 0)) this.bounds.radius = 1;
  }

  /** From the target to the eye. */
  back(): THREE.Vector3 {
    const c = Math.cos(this.elevation);
    return new THREE.Vector3(c * Math.cos(this.azimuth), c * Math.sin(this.azimuth), Math.sin(this.elevation));
  }

  right(): THREE.Vector3 {
    return new THREE.Vector3(-Math.sin(this.azimuth), Math.cos(this.azimuth), 0);
  }

  up(): THREE.Vector3 {
    return this.back().cross(this.right());
  }

  /** Half the height of what is seen at the target. */
  get reach(): number {
    return this.distance * Math.tan((kFov * Math.PI) / 360);
  }

  fit(aspect: number) {
    this.through = null;
    this.box.getCenter(this.target);
    // The box as it looks from here.
    const r = this.right(), u = this.up(), b = this.back();
    let wide = 0, high = 0, deep = 0;
    for (let k = 0; k < 8; ++k) {
      const p = new THREE.Vector3(k & 1 ? this.box.max.x : this.box.min.x, k & 2 ? this.box.max.y : this.box.min.y, k & 4 ? this.box.max.z : this.box.min.z).sub(this.target);
      wide = Math.max(wide, Math.abs(p.dot(r)));
      high = Math.max(high, Math.abs(p.dot(u)));
      deep = Math.max(deep, Math.abs(p.dot(b)));
    }
    const tan = Math.tan((kFov * Math.PI) / 360);
    const half = Math.max(high, wide / aspect, 1e-6) * 1.18;
    this.distance = half / tan + (this.ortho ? 0 : 0.55 * deep);
    this.changed();
  }

  view(name: ViewName) {
    this.through = null;
    if (this.flat || name === 'top') {
      this.azimuth = -Math.PI / 2;
      this.elevation = kMostElevation;
    } else if (name === 'front') {
      this.azimuth = -Math.PI / 2;
      this.elevation = 0;
    } else if (name === 'side') {
      this.azimuth = 0;
      this.elevation = 0;
    } else {
      this.azimuth = -2.2;
      this.elevation = 0.6;
    }
    this.ortho = this.flat || name !== 'perspective';
  }

  orbit(dx: number, dy: number) {
    if (this.flat) return;
    this.through = null;
    this.azimuth -= dx;
    this.elevation = Math.min(kMostElevation, Math.max(-kMostElevation, this.elevation + dy));
    this.changed();
  }

  /** In half heights of the picture. */
  pan(dx: number, dy: number) {
    this.through = null;
    this.target.addScaledVector(this.right(), -dx * this.reach).addScaledVector(this.up(), dy * this.reach);
    this.changed();
  }

  /** Towards a place in half heights from the middle, x right and y up. */
  zoom(factor: number, x = 0, y = 0) {
    this.through = null;
    const before = this.reach;
    const r = this.bounds.radius;
    this.distance = Math.min(60 * r, Math.max(1e-3 * r, this.distance * factor));
    const moved = before - this.reach;
    this.target.addScaledVector(this.right(), x * moved).addScaledVector(this.up(), y * moved);
    this.changed();
  }

  /** The camera for a picture of this shape. */
  camera(aspect: number): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    const r = this.bounds.radius;
    const b = this.back();
    const eye = this.target.clone().addScaledVector(b, this.distance);
    if (this.through) return this.throughCamera(aspect, this.through);
    const far = eye.distanceTo(this.bounds.center) + 2 * r;
    let camera: THREE.PerspectiveCamera | THREE.OrthographicCamera;
    if (this.ortho) {
      const h = this.reach;
      const depth = 4 * r + this.distance;
      camera = new THREE.OrthographicCamera(-h * aspect, h * aspect, h, -h, -depth, far + depth);
    } else {
      const near = Math.max(far * 5e-4, Math.min(0.02 * this.distance, 0.05 * r));
      camera = new THREE.PerspectiveCamera(kFov, aspect, near, far);
    }
    camera.matrixAutoUpdate = false;
    camera.matrix.makeBasis(this.right(), this.up(), b).setPosition(eye);
    return this.ready(camera);
  }

  private throughCamera(aspect: number, pose: Pose): THREE.PerspectiveCamera {
    const camera = new THREE.PerspectiveCamera();
    const near = 0.02, far = 20 * this.bounds.radius + 10;
    // The whole image inside the picture, with what is around it.
    const scale = Math.max(pose.width / aspect, pose.height) / 2;
    const [w, h] = [scale * aspect, scale];
    const mx = pose.width / 2 - pose.cx, my = pose.height / 2 - pose.cy;
    camera.matrixAutoUpdate = false;
    // OpenCV's camera looks along +z with y down.
    camera.matrix.copy(pose.matrix).multiply(new THREE.Matrix4().makeScale(1, -1, -1));
    camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
    this.ready(camera);
    camera.projectionMatrix.makePerspective(near * (mx - w) / pose.fx, near * (mx + w) / pose.fx, near * (h - my) / pose.fy, near * (-h - my) / pose.fy, near, far);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    return camera;
  }

  private ready<T extends THREE.PerspectiveCamera | THREE.OrthographicCamera>(camera: T): T {
    camera.matrixWorldAutoUpdate = false;
    camera.matrixWorld.copy(camera.matrix);
    camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
    camera.updateProjectionMatrix();
    return camera;
  }
}
