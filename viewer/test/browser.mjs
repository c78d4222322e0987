// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Debian's Chromium without a display, with WebGL in software.
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

export async function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
}

const folder = mkdtempSync(join(tmpdir(), 'unseen-viewer-'));

/** Opens a page from disk; collects requests other than its own, and what goes wrong. */
export async function open(browser, name, html, { width = 1280, height = 800, dark = false, touch = false } = {}) {
  const path = join(folder, `${name}.html`);
  writeFileSync(path, html);
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: dark ? 'dark' : 'light', hasTouch: touch, acceptDownloads: true });
  const page = await context.newPage();
  const requests = [], errors = [];
  page.on('request', (r) => { if (r.url() !== `file://${path}` && !/^(data|blob):/.test(r.url())) requests.push(r.url()); });
  // The software renderer complains about its own speed.
  page.on('console', (m) => { if (/^(error|warning)$/.test(m.type()) && !m.text().includes('GL Driver Message')) errors.push(m.text()); });
  page.on('pageerror', (e) => errors.push(String(e)));
  await page.goto(`file://${path}`);
  await page.evaluate(() => window.unseen.ready);
  return { page, requests, errors, close: () => context.close() };
}

/** Waits until the picture stands. */
export const settle = (page) => page.evaluate(async () => {
  await new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)));
  await window.unseen.complete();
});
export const selection = (page) => page.evaluate(() => window.unseen.selection());
