// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What the page shows: its scenes, what is selected in them, and the sliders that they share.
import * as THREE from 'three';
import { optionText } from './dom';
import type { CameraStructure } from './format';
import { poseOf } from './layers/camera';
import type { Look } from './layers/layer';
import { Model, type Relations, type Selection } from './model';
import { CameraRig, type ViewName } from './view/rig';
import { Viewport } from './view/viewport';

export type Axis = 'x' | 'y' | 'z';

export interface SceneView {
  model?: Model;
  viewport?: Viewport;
  error?: string;
  selection: Selection | null;
  hover: Selection | null;
  relations: Relations;
}

export type Topic = 'selection' | 'hover' | 'time' | 'before' | 'theme' | 'active' | 'layers' | 'section' | 'frame' | 'view' | 'playing' | 'print';

export class App {
  readonly rig = new CameraRig();
  readonly scenes: SceneView[] = [];
  active = 0;
  dark = matchMedia('(prefers-color-scheme: dark)').matches;
  before = 1;
  time = 0;
  playing = false;
  section: { axis: Axis | null; value: number; flipped: boolean } = { axis: null, value: 0, flipped: false };
  fading = false;
  private readonly listeners = new Map<Topic, { f: () => void; owner?: Element; shown: boolean }[]>();

  /** Calls f on topics; with an owner, until that has left the page. */
  on(topics: Topic | Topic[], f: () => void, owner?: Element) {
    for (const t of [topics].flat()) this.listeners.set(t, [...(this.listeners.get(t) ?? []), { f, owner, shown: false }]);
  }

  emit(topic: Topic) {
    const list = this.listeners.get(topic);
    if (!list) return;
    const kept = list.filter((l) => {
      const here = l.owner?.isConnected ?? true;
      const gone = l.shown && !here;
      l.shown ||= here;
      return !gone;
    });
    this.listeners.set(topic, kept);
    for (const l of kept) if (!l.owner || l.owner.isConnected) l.f();
  }

  get current(): SceneView {
    return this.scenes[this.active]!;
  }

  get viewports(): Viewport[] {
    return this.scenes.flatMap((s) => (s.viewport ? [s.viewport] : []));
  }

  activate(index: number) {
    if (index === this.active || !this.scenes[index]) return;
    this.active = index;
    this.emit('active');
  }

  select(selection: Selection | null, scene = this.active) {
    const view = this.scenes[scene]!;
    if (!view.model) return;
    view.selection = selection;
    view.relations = view.model.relations(selection);
    const moment = view.model.momentOf(selection, this.time);
    if (moment !== null) this.setTime(moment);
    this.refresh(view);
    this.emit('selection');
  }

  hover(selection: Selection | null, scene = this.active) {
    const view = this.scenes[scene]!;
    if (view.hover?.structure === selection?.structure && view.hover?.index === selection?.index) return;
    view.hover = selection;
    this.refresh(view);
    this.emit('hover');
  }

  look(view: SceneView): Look {
    return { selection: view.selection, hover: view.hover, relations: view.relations, dark: this.dark, before: 1 - this.before, time: this.time };
  }

  refresh(view: SceneView) {
    view.viewport?.update(this.look(view));
  }

  refreshAll() {
    for (const s of this.scenes) this.refresh(s);
  }

  setLayer(id: string, on: boolean, scene = this.active) {
    const viewport = this.scenes[scene]?.viewport;
    const layer = viewport?.layers.get(id);
    if (!layer) return;
    layer.object.visible = on;
    this.refresh(this.scenes[scene]!);
    this.emit('layers');
  }

  setColor(id: string, quantity: string, scene = this.active) {
    this.scenes[scene]?.viewport?.layers.get(id)?.setColor(quantity);
    this.refresh(this.scenes[scene]!);
    this.emit('layers');
  }

  /** 0: the free fit, 1: the result. */
  setBefore(x: number) {
    this.before = Math.min(1, Math.max(0, x));
    this.refreshAll();
    this.emit('before');
  }

  /** When something moves, s, and the shortest time between two of its frames in the mean. */
  get timeRange(): { start: number; end: number; rate: number; step: number } | null {
    const ranges = this.scenes.flatMap((s) => (s.model?.header.time ? [s.model.header.time] : []));
    if (ranges.length === 0) return null;
    const start = Math.min(...ranges.map((r) => r.start)), end = Math.max(...ranges.map((r) => r.end));
    const steps = this.scenes.flatMap((s) => (s.model?.structures ?? []).flatMap((t) => {
      const times = 'times' in t && t.times ? s.model!.floats(t.times) : [];
      return times.length > 1 ? [(times[times.length - 1]! - times[0]!) / (times.length - 1)] : [];
    }));
    return { start, end, rate: Math.min(...ranges.map((r) => r.rate ?? 1)), step: steps.length > 0 ? Math.min(...steps) : (end - start) / 50 };
  }

  /** What a scene is called: its title, with the options in which it differs from others of the same title. */
  titleOf(view: SceneView): string {
    const header = view.model?.header;
    if (!header) return 'not readable';
    const others = this.scenes.flatMap((s) => (s !== view && s.model?.header.title === header.title ? [s.model.header] : []));
    const own = (header.options ?? []).filter((o) => others.some((other) => optionText(other.options?.find((x) => x.name === o.name)?.value) !== optionText(o.value)));
    return [header.title, ...own.slice(0, 2).map((o) => `${o.name.replace(/_/g, ' ')} ${optionText(o.value, o.unit)}`)].join(' · ');
  }

  printing = false;
  setPrinting(on: boolean) {
    this.printing = on;
    this.emit('print');
  }

  setTime(t: number) {
    const range = this.timeRange;
    if (!range) return;
    this.time = Math.min(range.end, Math.max(range.start, t));
    this.refreshAll();
    this.emit('time');
  }

  /** Lays scenes of one place where they are to each other: each has an offset of its own. Scenes that lie apart are seen each by itself. */
  align() {
    const [first, ...others] = this.viewports;
    for (const v of others) {
      v.shift.fromArray(v.model.header.offset ?? [0, 0, 0]).sub(new THREE.Vector3(...(first!.model.header.offset ?? [0, 0, 0])));
      if (!v.bounds.intersectsBox(first!.bounds)) v.shift.set(0, 0, 0);
    }
  }

  get box(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const v of this.viewports) box.union(v.bounds);
    return box;
  }

  get focus(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const v of this.viewports) box.union(v.focus);
    return box;
  }

  setSection(axis: Axis | null, value?: number, flipped = this.section.flipped) {
    const box = this.box;
    if (axis && value === undefined) value = (box.min[axis] + box.max[axis]) / 2;
    this.section = { axis, value: value ?? 0, flipped };
    const sign = flipped ? -1 : 1;
    for (const v of this.viewports) {
      const clip = v.shared.uClip.value;
      clip.set(0, 0, 0, 1);
      if (axis) {
        clip[axis] = sign;
        clip.w = sign * (this.section.value - v.shift[axis]);
      }
      v.invalidate();
    }
    this.emit('section');
  }

  setFading(on: boolean) {
    this.fading = on;
    for (const v of this.viewports) v.fading = on;
    this.emit('view');
  }

  view(name: ViewName) {
    this.rig.view(name);
    this.fit();
  }

  /** The first camera of the scenes. */
  get camera(): CameraStructure | undefined {
    for (const s of this.scenes) for (const c of s.model?.structures ?? []) if (c.kind === 'camera') return c;
    return undefined;
  }

  lookThrough(camera: CameraStructure) {
    const view = this.scenes.find((s) => s.model?.structures.includes(camera));
    this.rig.through = poseOf(camera);
    if (view?.viewport) this.rig.through.matrix.premultiply(new THREE.Matrix4().setPosition(view.viewport.shift));
    this.rig.changed();
    this.emit('view');
  }

  fit() {
    const aspect = Math.min(...this.viewports.map((v) => v.aspect), Infinity);
    this.rig.fit(Number.isFinite(aspect) && aspect > 0 ? aspect : 1);
    this.emit('view');
  }

  setOrtho(on: boolean) {
    this.rig.ortho = on || this.rig.flat;
    this.rig.through = null;
    this.rig.changed();
    this.emit('view');
  }

  setDark(on: boolean) {
    this.dark = on;
    document.documentElement.dataset.theme = on ? 'dark' : 'light';
    const background = getComputedStyle(document.documentElement).getPropertyValue('--stage').trim();
    for (const v of this.viewports) v.setBackground(background);
    this.refreshAll();
    this.emit('theme');
  }

  private lastTick = 0;
  setPlaying(on: boolean) {
    const range = this.timeRange;
    if (!range) return;
    if (on && this.time >= range.end - 1e-9) this.setTime(range.start);
    const was = this.playing;
    this.playing = on;
    this.emit('playing');
    if (!on || was) return;
    this.lastTick = performance.now();
    const tick = (now: number) => {
      if (!this.playing) return;
      const next = this.time + (range.rate * (now - this.lastTick)) / 1000;
      this.lastTick = now;
      this.setTime(next);
      if (next >= range.end) this.setPlaying(false);
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }
}
