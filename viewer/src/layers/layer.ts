// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A structure in the 3D view.
import * as THREE from 'three';
import type { Quantity, Structure } from '../format';
import type { Model, Relations, Selection } from '../model';
import type { SharedUniforms } from '../view/shared';

/** What a layer draws by. */
export interface Look {
  selection: Selection | null;
  hover: Selection | null;
  relations: Relations;
  dark: boolean;
  before: number;
  time: number;
}

export interface View {
  readonly camera: THREE.Camera;
  readonly ortho: boolean;
  readonly eye: THREE.Vector3;
  readonly forward: THREE.Vector3;
  /** Pixels, without the device's scale. */
  readonly width: number;
  readonly height: number;
}

export interface Hit {
  selection: Selection;
  /** Along the ray. */
  distance: number;
}

export interface LayerContext {
  model: Model;
  shared: SharedUniforms;
  layers: Map<string, Layer>;
  invalidate: () => void;
}

/** Colour by: an own quantity, one of the linked structure ("@id"), or "relation". */
export interface ColorChoice {
  id: string;
  name: string;
  quantity?: Quantity;
  of?: Structure;
}

export abstract class Layer {
  readonly object = new THREE.Group();
  readonly bounds = new THREE.Box3();
  color = '';

  constructor(readonly context: LayerContext, readonly structure: Structure) {
    this.object.visible = structure.visible ?? true;
  }

  get visible(): boolean {
    return this.object.visible;
  }

  choices(): ColorChoice[] {
    return [];
  }

  setColor(id: string) {
    this.color = id;
  }

  /** Selection, theme or slider changed. */
  abstract update(look: Look): void;

  /** The camera moved. */
  frame(_view: View): void {}

  pick(_ray: THREE.Ray, _view: View, _at: THREE.Vector2): Hit | null {
    return null;
  }

  /** A point in the middle of an element. */
  anchor(_index: number): THREE.Vector3 | null {
    return null;
  }
}
