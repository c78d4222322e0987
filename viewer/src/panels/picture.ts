// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The picture as it is, to the clipboard or as a file.
import type { App } from '../app';
import { announce } from './announce';

async function pictureOf(app: App): Promise<Blob> {
  const views = app.viewports;
  const width = views.reduce((a, v) => a + v.canvas.width, 0);
  const height = Math.max(...views.map((v) => v.canvas.height));
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const pen = canvas.getContext('2d')!;
  let x = 0;
  for (const v of views) {
    v.draw(true);
    pen.drawImage(v.canvas, x, 0);
    x += v.canvas.width;
  }
  return new Promise((done, fail) => canvas.toBlob((b) => (b ? done(b) : fail(new Error('no picture'))), 'image/png'));
}

export async function copyPicture(app: App) {
  try {
    // The promise inside keeps Safari's permission of the click.
    await navigator.clipboard.write([new ClipboardItem({ 'image/png': pictureOf(app) })]);
    announce('Picture copied', true);
  } catch {
    announce('This browser does not let the page copy pictures; export it instead', true);
  }
}

export async function exportPng(app: App) {
  const url = URL.createObjectURL(await pictureOf(app));
  const link = document.createElement('a');
  link.href = url;
  link.download = `${(document.title || 'unseen').replace(/[^\p{L}\p{N}._-]+/gu, '-')}.png`;
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(url), 10000);
  announce('Picture exported', true);
}
