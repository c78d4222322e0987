// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Mouse, touch and wheel on a picture: orbit, pan, zoom, click and hover.
import type { CameraRig } from './rig';

export interface GestureHandlers {
  click(x: number, y: number): void;
  hover(x: number, y: number): void;
  leave(): void;
  moving(): void;
}

const kClickSlack = 5;

export function addGestures(element: HTMLElement, rig: CameraRig, handlers: GestureHandlers) {
  const pointers = new Map<number, { x: number; y: number }>();
  let moved = 0;
  let button = 0;
  let pinch = 0;

  const place = (e: { clientX: number; clientY: number }) => {
    const r = element.getBoundingClientRect();
    return { x: e.clientX - r.left, y: e.clientY - r.top, half: r.height / 2, width: r.width, height: r.height };
  };
  const middle = () => {
    let x = 0, y = 0;
    for (const p of pointers.values()) { x += p.x / pointers.size; y += p.y / pointers.size; }
    return { x, y };
  };
  const spreadOf = () => {
    const m = middle();
    let s = 0;
    for (const p of pointers.values()) s += Math.hypot(p.x - m.x, p.y - m.y) / pointers.size;
    return s;
  };

  element.addEventListener('pointerdown', (e) => {
    element.setPointerCapture(e.pointerId);
    const p = place(e);
    pointers.set(e.pointerId, p);
    if (pointers.size === 1) {
      moved = 0;
      button = e.button;
    } else {
      moved = Infinity;
      pinch = spreadOf();
    }
  });
  element.addEventListener('pointermove', (e) => {
    const p = place(e);
    const last = pointers.get(e.pointerId);
    if (!last) {
      if (e.pointerType === 'mouse') handlers.hover(p.x, p.y);
      return;
    }
    const before = middle();
    pointers.set(e.pointerId, p);
    const now = middle();
    const dx = now.x - before.x, dy = now.y - before.y;
    moved += Math.hypot(p.x - last.x, p.y - last.y);
    if (moved < kClickSlack) return;
    handlers.moving();
    if (pointers.size >= 2) {
      const s = spreadOf();
      if (pinch > 0 && s > 0) rig.zoom(pinch / s, (now.x - p.width / 2) / p.half, (p.height / 2 - now.y) / p.half);
      pinch = s;
      rig.pan(dx / p.half, dy / p.half);
    } else if (rig.flat || button !== 0 || e.shiftKey || e.ctrlKey) {
      rig.pan(dx / p.half, dy / p.half);
    } else {
      rig.orbit((dx / p.half) * 1.8, (dy / p.half) * 1.8);
    }
  });
  const end = (e: PointerEvent) => {
    if (!pointers.delete(e.pointerId)) return;
    const p = place(e);
    pinch = pointers.size > 1 ? spreadOf() : 0;
    if (e.type === 'pointerup' && pointers.size === 0 && moved < kClickSlack && button === 0) handlers.click(p.x, p.y);
  };
  element.addEventListener('pointerup', end);
  element.addEventListener('pointercancel', end);
  element.addEventListener('pointerleave', () => handlers.leave());
  element.addEventListener('contextmenu', (e) => e.preventDefault());
  element.addEventListener('wheel', (e) => {
    e.preventDefault();
    const p = place(e);
    handlers.moving();
    const lines = e.deltaMode === 1 ? 30 : 1;
    rig.zoom(Math.exp(Math.max(-120, Math.min(120, e.deltaY * lines)) * 0.0018), (p.x - p.width / 2) / p.half, (p.height / 2 - p.y) / p.half);
  }, { passive: false });
}
