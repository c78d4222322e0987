// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Reads the scenes of the page and puts it together.
import { App, type SceneView } from './app';
import { exposeApi } from './api';
import { decodeScene, SceneError } from './decode';
import { h } from './dom';
import { addKeyboard } from './keyboard';
import { Model } from './model';
import { announce, announceRegion } from './panels/announce';
import { nameIn } from './panels/facts';
import { helpDialog } from './panels/help';
import { sidePanel } from './panels/side';
import { sliders } from './panels/sliders';
import { stage } from './panels/stage';
import { toolbar } from './panels/toolbar';
import { Viewport } from './view/viewport';

async function readScene(text: string): Promise<SceneView> {
  const view: SceneView = { selection: null, hover: null, relations: new Map() };
  try {
    view.model = new Model(await decodeScene(text));
  } catch (e) {
    view.error = e instanceof SceneError ? e.message : `The scene in this page cannot be read: ${e instanceof Error ? e.message : String(e)}`;
  }
  return view;
}

function addViewport(app: App, view: SceneView, index: number) {
  if (!view.model) return;
  try {
    view.viewport = new Viewport(view.model, app.rig, {
      select: (selection) => app.select(selection, index),
      hover: (selection) => app.hover(selection, index),
      activate: () => app.activate(index),
    });
    view.viewport.onFrame(() => app.emit('frame'));
  } catch (e) {
    if (e instanceof SceneError) {
      view.error = e.message;
      view.model = undefined;
    } else view.error = 'This browser has no WebGL 2, so there is no picture. The tables and facts are all there.';
  }
}

async function start(root: HTMLElement): Promise<void> {
  const texts = [...document.querySelectorAll('script.unseen-scene')];
  const app = new App();
  for (const element of texts) {
    app.scenes.push(await readScene(element.textContent ?? ''));
    // The text is large, and not needed again.
    element.remove();
  }
  if (app.scenes.length === 0) app.scenes.push({ error: 'There is no scene in this page.', selection: null, hover: null, relations: new Map() });
  app.rig.flat = app.scenes.some((v) => v.model) && app.scenes.every((v) => !v.model || v.model.header.flat === true);
  app.scenes.forEach((v, i) => addViewport(app, v, i));
  app.align();
  app.active = Math.max(0, app.scenes.findIndex((v) => v.model));
  app.rig.setBounds(app.focus);
  app.time = app.timeRange?.start ?? 0;

  const title = document.title || app.current.model?.header.title || 'unseen';
  const help = helpDialog(app);
  const stages = h('div', { class: `stages${app.scenes.length > 1 ? ' two' : ''}` }, ...app.scenes.map((v, i) => stage(app, v, i)));
  root.replaceChildren(toolbar(app, title, () => help.showModal()), h('main', { class: 'main' }, h('div', { class: 'view' }, stages, sliders(app)), sidePanel(app)), help, announceRegion());
  addKeyboard(app, help);
  app.on('selection', () => {
    const { selection } = app.current;
    announce(selection ? `${nameIn(app.current, selection)} selected` : 'Nothing selected');
  });
  app.setDark(app.dark);
  matchMedia('print').addEventListener('change', (e) => app.setPrinting(e.matches));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', (e) => app.setDark(e.matches));
  app.setFading(app.viewports.some((v) => v.fadingHelps));
  app.viewports.forEach((v) => v.resize(v.canvas.parentElement!.clientWidth, v.canvas.parentElement!.clientHeight));
  app.view('perspective');
  for (const v of app.viewports) v.draw();
  exposeApi(app);
}

const root = document.getElementById('app')!;
root.append(h('p', { class: 'loading', role: 'status' }, 'Unpacking the scene …'));
// A frame first, so that the page says that it is at work.
const ready = new Promise<void>((done) => requestAnimationFrame(() => window.setTimeout(done, 0))).then(() => start(root));
(window as unknown as { unseen: { ready: Promise<void> } }).unseen = { ready };
ready.catch((e: unknown) => {
  console.error(e);
  root.replaceChildren(h('div', { class: 'fatal', role: 'alert' }, h('p', {}, `The page could not be put together: ${e instanceof Error ? e.message : String(e)}`)));
});
