// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The layer for each kind of structure. Spheres of normals have a panel instead.
import type { Structure } from '../format';
import { CameraLayer, ImageLayer } from './camera';
import type { Layer, LayerContext } from './layer';
import { PlanesLayer } from './planes';
import { PointsLayer } from './points';

export function makeLayer(context: LayerContext, s: Structure): Layer | null {
  switch (s.kind) {
    case 'points': return new PointsLayer(context, s);
    case 'planes': return new PlanesLayer(context, s);
    case 'camera': return new CameraLayer(context, s);
    case 'image': return new ImageLayer(context, s);
    default: return null;
  }
}
