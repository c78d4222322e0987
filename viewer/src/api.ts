// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// window.unseen, for tests and for people at the console:
//   ready                          a promise: the first picture has been drawn
//   select(structure, index)       select(null) clears
//   selection()                    {structure, index} or null
//   setLayer(id, bool)             setColor(structure, quantity)
//   setSection(axis | null, value) 'x', 'y' or 'z'; value in the coordinates of the first scene
//   view(name)                     'perspective', 'top', 'front', 'side'
//   fit()
//   complete()                     a promise: all points are in the picture (large clouds follow in steps)
//   setTime(s)                     setBefore(x): 0 = the free fit, 1 = the result
//   setFading(bool)                walls between camera and inside
//   project(structure, index)      where the middle of an element is in the window, in CSS pixels
//   pick(x, y)                     what lies under a place of the window
// All but the last take the number of the scene (0, 1) as an additional last argument where it matters.
import type { App, Axis } from './app';
import type { Selection } from './model';
import type { ViewName } from './view/rig';

export function exposeApi(app: App) {
  const page = window as unknown as { unseen: Record<string, unknown> };
  Object.assign(page.unseen, {
    select: (structure: string | null, index = 0, scene = app.active) => app.select(structure === null ? null : { structure, index }, scene),
    selection: (scene = app.active): Selection | null => app.scenes[scene]?.selection ?? null,
    setLayer: (id: string, on: boolean, scene?: number) => app.setLayer(id, on, scene),
    setColor: (structure: string, quantity: string, scene?: number) => app.setColor(structure, quantity, scene),
    setSection: (axis: Axis | null, value?: number) => app.setSection(axis, value),
    view: (name: ViewName) => app.view(name),
    fit: () => app.fit(),
    complete: () => Promise.all(app.viewports.map((v) => v.complete())),
    setTime: (t: number) => app.setTime(t),
    setBefore: (x: number) => app.setBefore(x),
    setFading: (on: boolean) => app.setFading(on),
    project: (structure: string, index: number, scene = app.active) => {
      const viewport = app.scenes[scene]?.viewport;
      const anchor = viewport?.layers.get(structure)?.anchor(index);
      if (!viewport || !anchor) return null;
      const box = viewport.canvas.getBoundingClientRect();
      const p = viewport.project(anchor);
      return { x: box.left + p.x, y: box.top + p.y };
    },
    pick: (x: number, y: number, scene = app.active) => {
      const viewport = app.scenes[scene]?.viewport;
      const box = viewport?.canvas.getBoundingClientRect();
      return viewport && box ? (viewport.pick(x - box.left, y - box.top)?.selection ?? null) : null;
    },
  });
}
