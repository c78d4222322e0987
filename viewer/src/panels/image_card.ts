// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Images and videos that the result was made from, and the cameras that took them.
import type { App, SceneView } from '../app';
import { h, isRoomy } from '../dom';
import type { CameraStructure, ImageStructure } from '../format';
import type { ImageLayer } from '../layers/camera';

export function imageCard(app: App, view: SceneView): HTMLElement | null {
  const model = view.model!;
  const images = model.structures.filter((s): s is ImageStructure => s.kind === 'image');
  const cameras = model.structures.filter((s): s is CameraStructure => s.kind === 'camera');
  if (images.length === 0 && cameras.length === 0) return null;
  const pictures = images.map((image) => {
    const layer = view.viewport!.layers.get(image.id) as ImageLayer;
    const element = layer.element();
    element.setAttribute('aria-label', image.name);
    return h('figure', {}, element, h('figcaption', { class: 'quiet' }, image.name));
  });
  const buttons = cameras.map((c) => h('button', { type: 'button', class: 'button', onclick: () => app.lookThrough(c) }, cameras.length > 1 ? `Look through ${c.name}` : 'Look through the camera'));
  return h('details', { class: 'card images', open: isRoomy().matches }, h('summary', {}, images.length > 0 ? 'Image' : 'Camera'),
    h('div', { class: 'card-body' }, ...pictures, ...buttons));
}
