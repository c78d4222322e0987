// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What the cards and the panel at the side say, and how they make room.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, open } from './browser.mjs';
import { Buffers, encodeScene, pageOf } from './make_scene.mjs';
import { cuboidsScene, interactionsScene } from './scene_more.mjs';
import { roomScene } from './scene_room.mjs';

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

const section = (page) => page.evaluate(() => document.querySelector('#tool-section').classList.contains('on'));

test('the page says what it shows, and what its facts mean', async () => {
  const scene = roomScene({ points: 2000, more: () => ({ structures: [], header: { about: 'Planes, made exact.', facts: [{ name: 'scale', value: '0.05 m', help: 'What is smaller is noise' }, { name: 'planes', value: '18' }] } }) });
  const { page, close } = await open(browser, 'about', pageOf('about', [scene]));
  assert.equal(await page.getByText('Planes, made exact.').count(), 1);
  assert.deepEqual(await page.locator('.facts > div').evaluateAll((all) => all.map((d) => d.title)), ['What is smaller is noise', '']);
  await close();
});

test('the panel can be made wider', async () => {
  const { page, close } = await open(browser, 'wider', pageOf('wider', [cuboidsScene()]));
  const width = () => page.locator('.side').evaluate((e) => e.clientWidth);
  const edge = await page.locator('.side-edge').boundingBox(), start = await width();
  await page.mouse.move(edge.x + 4, 400);
  await page.mouse.down();
  await page.mouse.move(edge.x - 146, 400, { steps: 3 });
  await page.mouse.up();
  assert.ok(Math.abs((await width()) - start - 150) < 6, `${start} ${await width()}`);
  const canvas = await page.locator('.stage canvas').boundingBox();
  assert.ok(canvas.x + canvas.width <= edge.x - 140, 'the picture makes room');
  await page.locator('.side-edge').focus();
  const dragged = await width();
  await page.keyboard.press('ArrowRight');
  assert.ok(Math.abs((await width()) - dragged + 40) < 1.5);
  await page.setViewportSize({ width: 900, height: 700 });
  assert.ok((await width()) <= 631, 'no wider than seven tenths of the page');
  await close();
});

test('the section plane ends with its box; Escape puts only the box away', async () => {
  const { page, close } = await open(browser, 'section', pageOf('section', [roomScene({ points: 2000 })]));
  const shown = () => page.locator('#section-popover').isVisible();
  await page.keyboard.press('s');
  assert.deepEqual([await section(page), await shown()], [true, true]);
  await page.keyboard.press('Escape');
  assert.deepEqual([await section(page), await shown()], [true, false]);
  assert.equal(await page.locator('#tool-section').getAttribute('aria-expanded'), 'false');
  await page.keyboard.press('s');
  await page.keyboard.press('s');
  assert.deepEqual([await section(page), await shown()], [false, false]);
  await close();
});

test('labels do not lie on each other', async () => {
  const { page, close } = await open(browser, 'over', pageOf('over', [interactionsScene()]));
  const labels = async () => (await page.locator('.over:visible').allInnerTexts()).sort();
  await page.evaluate(() => window.unseen.view('top'));
  await page.evaluate(() => window.unseen.complete());
  assert.deepEqual(await labels(), ['chair 0.90', 'table 0.70']);
  // From far away they would: the first stays, or what is selected.
  for (let i = 0; i < 15; ++i) await page.keyboard.press('-');
  await page.evaluate(() => window.unseen.complete());
  assert.deepEqual(await labels(), ['chair 0.90']);
  await page.evaluate(() => window.unseen.select('furniture', 1));
  await page.evaluate(() => window.unseen.complete());
  assert.deepEqual(await labels(), ['table 0.70']);
  await close();
});

test('names of edges lie neither on each other nor on nodes', async () => {
  const b = new Buffers(), leaves = [1, 2, 3, 4, 5, 6, 7, 8];
  const scene = encodeScene({
    scene: 1, title: 'star', capability: 'cuboids', version: '0.2.0', command: '', facts: [], summary: { seconds: {}, energy: {}, counts: {}, warnings: [] }, options: [], input: {}, offset: [0, 0, 0], tables: [],
    structures: [{ id: 'star', kind: 'graph', name: 'Star', visible: true, node_names: ['ground', ...leaves.map((i) => `box ${i} (${i})`)], edges: b.plain(leaves.flatMap((i) => [0, i]), 2, 'u32'), edge_names: leaves.map((i) => `${i}.5 N, touching`) }],
  }, b);
  const { page, close } = await open(browser, 'edges', pageOf('edges', [scene]));
  await page.getByRole('tab', { name: 'Relations' }).click();
  await page.locator('.graph .node[data-node="0"] circle').dispatchEvent('click');
  const [edges, nodes] = await page.evaluate(() => ['.edge-labels text', '.node text'].map((selector) => [...document.querySelectorAll(selector)].map((e) => e.getBoundingClientRect()).map((r) => [r.left, r.top, r.right, r.bottom])));
  assert.equal(edges.length, 8);
  const onEach = (p, q) => Math.min(p[2], q[2]) - Math.max(p[0], q[0]) > 3 && Math.min(p[3], q[3]) - Math.max(p[1], q[1]) > 3;
  for (const [i, edge] of edges.entries()) assert.ok(![...nodes, ...edges.slice(0, i)].some((other) => onEach(edge, other)), `edge ${i}`);
  await close();
});

test('cards are folded on a phone that lies, and a printed legend is open', async () => {
  const { page, close } = await open(browser, 'lying', pageOf('lying', [roomScene({ points: 2000 })]), { width: 844, height: 390 });
  const open_ = () => page.locator('details.card').evaluateAll((all) => all.map((d) => d.open));
  assert.ok((await open_()).every((o) => !o));
  assert.ok(await page.locator('.legend > summary').isVisible());
  await page.emulateMedia({ media: 'print' });
  await page.waitForFunction(() => document.querySelector('.legend').open);
  await close();
});
