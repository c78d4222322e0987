// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The layer for each kind of structure. Spheres of normals and graphs without places have panels instead.
import * as THREE from 'three';
import type { Structure } from '../format';
import { ArrowsLayer } from './arrows';
import { BoxesLayer } from './boxes';
import { CameraLayer, ImageLayer } from './camera';
import { FloorLayer } from './floor';
import { GraphLayer } from './graph';
import type { Layer, LayerContext } from './layer';
import { LinesLayer } from './lines';
import { MeshLayer } from './mesh';
import { PlanesLayer } from './planes';
import { PointsLayer } from './points';
import { SkeletonLayer } from './skeleton';
import { TrajectoryLayer } from './trajectory';

export function makeLayer(context: LayerContext, s: Structure): Layer | null {
  switch (s.kind) {
    case 'points': return new PointsLayer(context, s);
    case 'planes': return new PlanesLayer(context, s);
    case 'lines': return new LinesLayer(context, s);
    case 'boxes': return new BoxesLayer(context, s);
    case 'graph': return s.positions ? new GraphLayer(context, s, extentOf(context)) : null;
    case 'arrows': return new ArrowsLayer(context, s, extentOf(context));
    case 'trajectory': return new TrajectoryLayer(context, s);
    case 'skeleton': return new SkeletonLayer(context, s);
    case 'camera': return new CameraLayer(context, s, extentOf(context));
    case 'image': return new ImageLayer(context, s);
    case 'floor': return new FloorLayer(context, s);
    case 'mesh': return new MeshLayer(context, s);
    default: return null;
  }
}

/** m: size of what matters in the scene. */
function extentOf(context: LayerContext): number {
  const box = new THREE.Box3();
  const focus = context.model.header.focus;
  if (focus) box.set(new THREE.Vector3(...focus.low), new THREE.Vector3(...focus.high));
  else for (const layer of context.layers.values()) if (!layer.bounds.isEmpty()) box.union(layer.bounds);
  return box.isEmpty() ? 4 : box.getSize(new THREE.Vector3()).length();
}
