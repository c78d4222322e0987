// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The page in a headless browser, from disk.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, open, selection, settle } from './browser.mjs';
import { Buffers, encodeScene, pageOf } from './make_scene.mjs';
import { cloudScene } from './scene_cloud.mjs';
import { collisionScene, cuboidsScene, interactionsScene, planScene } from './scene_more.mjs';
import { roomPlanes, roomScene } from './scene_room.mjs';

let browser, room;
before(async () => {
  browser = await launch();
  room = pageOf('Planes of room.ply', [roomScene({ points: 40000 })]);
});
after(() => browser?.close());

/** Colour of a place of the picture. */
const pixel = async (page, { x, y }) => {
  await settle(page);
  return page.evaluate(({ x, y }) => {
    const canvas = document.querySelector('.stage canvas'), box = canvas.getBoundingClientRect();
    const copy = document.createElement('canvas');
    copy.width = copy.height = 1;
    const pen = copy.getContext('2d');
    const scale = canvas.width / box.width;
    pen.drawImage(canvas, (x - box.left) * scale, (y - box.top) * scale, 1, 1, 0, 0, 1, 1);
    return [...pen.getImageData(0, 0, 1, 1).data].slice(0, 3);
  }, { x, y });
};
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

test('loads from disk without requests or errors', async () => {
  for (const [name, scene] of [['room', roomScene({ points: 5000 })], ['plan', planScene()], ['collision', collisionScene()], ['cuboids', cuboidsScene()], ['interactions', interactionsScene()]]) {
    const { page, requests, errors, close } = await open(browser, name, pageOf(name, [scene]));
    await settle(page);
    assert.deepEqual(requests, [], name);
    assert.deepEqual(errors, [], name);
    assert.equal(await page.title(), name);
    await close();
  }
});

test('a click selects the plane under it, Esc clears', async () => {
  const { page, errors, close } = await open(browser, 'click', room);
  for (const plane of [11, 6, 16]) {
    const at = await page.evaluate((p) => window.unseen.project('planes', p), plane);
    await page.mouse.click(at.x, at.y);
    assert.deepEqual(await selection(page), { structure: 'planes', index: plane });
    assert.match(await page.locator('.selection h3').innerText(), new RegExp(`Plane ${plane} · ${roomPlanes()[plane].tag}`));
    assert.equal(await page.locator(`tr[data-row="${plane}"]`).getAttribute('aria-selected'), 'true');
    assert.match(await page.locator('[aria-live]').innerText(), new RegExp(`Plane ${plane}`));
  }
  // With the planes off, their points select them.
  await page.evaluate(() => { window.unseen.select(null); window.unseen.setLayer('planes', false); });
  const at = await page.evaluate(() => window.unseen.project('planes', 11));
  await page.mouse.click(at.x, at.y);
  assert.deepEqual(await selection(page), { structure: 'planes', index: 11 });
  await page.keyboard.press('Escape');
  assert.equal(await selection(page), null);
  assert.deepEqual(errors, []);
  await close();
});

test('layers and colours change the picture', async () => {
  const { page, close } = await open(browser, 'layers', room);
  await page.evaluate(() => window.unseen.setLayer('points', false));
  const at = await page.evaluate(() => window.unseen.project('planes', 11));
  const orange = await pixel(page, at);
  assert.ok(distance(orange, [230, 159, 0]) < 90, `table in the second colour: ${orange}`);
  await page.evaluate(() => window.unseen.setColor('planes', 'rms'));
  assert.ok(distance(await pixel(page, at), orange) > 40);
  await page.getByRole('checkbox', { name: /^Planes/ }).uncheck();
  const background = await pixel(page, at);
  assert.ok(distance(background, [238, 240, 242]) < 6, `background: ${background}`);
  await close();
});

test('walls in front fade, and the section plane shows the inside', async () => {
  const { page, close } = await open(browser, 'inside', room);
  await page.evaluate(() => { window.unseen.setFading(false); window.unseen.view('top'); });
  const at = await page.evaluate(() => window.unseen.project('planes', 11));
  const over = () => page.evaluate((p) => window.unseen.pick(p.x, p.y).index, at);
  assert.equal(await over(), 1, 'the ceiling hides the table');
  await page.evaluate(() => window.unseen.setSection('z', 2));
  assert.equal(await over(), 11, 'cut open below the ceiling');
  assert.ok(distance(await pixel(page, at), [230, 159, 0]) < 90);
  await page.evaluate(() => { window.unseen.setSection(null); window.unseen.setFading(true); });
  await settle(page);
  assert.equal(await over(), 11, 'the ceiling is faded');
  await close();
});

test('before and after move planes', async () => {
  const { page, close } = await open(browser, 'before', room);
  const shot = async (x) => {
    await page.evaluate((v) => window.unseen.setBefore(v), x);
    await settle(page);
    return page.locator('.stage canvas').screenshot();
  };
  const [free, result, again] = [await shot(0), await shot(1), await shot(0)];
  assert.ok(!free.equals(result));
  assert.ok(free.equals(again));
  await close();
});

test('graph, sphere and facts share the selection', async () => {
  const { page, close } = await open(browser, 'graph', room);
  await page.getByRole('tab', { name: 'Relations' }).click();
  await page.locator('[data-node="0"] circle').click();
  assert.deepEqual(await selection(page), { structure: 'directions', index: 0 });
  await page.evaluate(() => window.unseen.select('planes', 3));
  assert.equal(await page.locator('.node.selected').getAttribute('data-node'), '1');
  assert.match(await page.locator('.selection').innerText(), /same direction[\s\S]*90°/);
  await page.locator('.selection .chip').first().click();
  assert.equal((await selection(page)).structure, 'planes');
  await page.locator('canvas.sphere').focus();
  await page.keyboard.press('ArrowRight');
  assert.equal((await selection(page)).structure, 'normals');
  await close();
});

test('keyboard: views, help, tabs', async () => {
  const { page, close } = await open(browser, 'keys', room);
  const shot = async () => { await settle(page); return page.locator('.stage canvas').screenshot(); };
  const first = await shot();
  await page.keyboard.press('2');
  assert.ok(!(await shot()).equals(first), 'from above');
  await page.keyboard.press('1');
  assert.ok((await shot()).equals(first), 'and back');
  await page.keyboard.press('?');
  assert.ok(await page.getByRole('dialog').isVisible());
  await page.keyboard.press('Escape');
  assert.ok(!(await page.getByRole('dialog').isVisible()));
  await page.getByRole('tab', { name: 'Found' }).focus();
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.getByRole('tab', { name: 'How it was made' }).getAttribute('aria-selected'), 'true');
  assert.match(await page.locator('.command code').innerText(), /unseen planes room\.ply/);
  await close();
});

test('labels lie at their elements and go with their layer', async () => {
  const { page, errors, close } = await open(browser, 'labels', pageOf('labels', [interactionsScene()]));
  await settle(page);
  const label = page.locator('.over', { hasText: 'table 0.70' });
  const box = await label.boundingBox(), at = await page.evaluate(() => window.unseen.project('furniture', 1));
  assert.ok(Math.hypot(box.x + box.width / 2 - at.x, box.y + box.height / 2 - at.y) < 2);
  await page.evaluate(() => window.unseen.setLayer('furniture', false));
  await settle(page);
  assert.equal(await page.locator('.over:visible').count(), 0);
  assert.deepEqual(errors, []);
  await close();
});

test('a picture on the floor is clear where it is black', async () => {
  const { page, close } = await open(browser, 'floor', pageOf('floor', [interactionsScene()]));
  await page.evaluate(() => { for (const id of ['people', 'seen', 'furniture', 'camera']) window.unseen.setLayer(id, false); window.unseen.view('top'); });
  await settle(page);
  // Places on the floor by those of two objects: (0.9, 0) and (−0.5, 1.2).
  const [a, b] = await page.evaluate(() => [window.unseen.project('furniture', 0), window.unseen.project('furniture', 1)]);
  const scale = (a.x - b.x) / 1.4, place = (x, y) => ({ x: a.x + (x - 0.9) * scale, y: a.y - y * scale });
  const before = await pixel(page, place(-0.5, 0.5));
  await page.evaluate(() => window.unseen.setLayer('evidence', true));
  const lit = await pixel(page, place(-0.5, 0.5)), clear = await pixel(page, place(0.5, -0.5));
  assert.ok(distance(before, lit) > 60 && lit[2] > lit[0] + 80, `blue: ${lit}`);
  assert.ok(distance(clear, before) < 4, `as without: ${clear}`);
  await close();
});

test('the view of the camera from the bar and the keyboard', async () => {
  const { page, errors, close } = await open(browser, 'through', pageOf('through', [interactionsScene()]));
  await page.getByRole('button', { name: 'Through the camera (5)' }).click();
  await settle(page);
  // Straight ahead of the camera is the middle of its picture, and so of the view.
  const box = await page.locator('.stage canvas').boundingBox();
  const at = await page.evaluate(() => window.unseen.project('furniture', 0));
  // The chair's seat in the camera: computed by hand from pose and focal length.
  const [c, s] = [Math.cos(0.35), Math.sin(0.35)], d = [0.9, 2.5, 0.25 - 1.5];
  const z = c * d[1] - s * d[2], u = (300 * d[0]) / z, v = (300 * (-s * d[1] - c * d[2])) / z;
  const scale = Math.min(box.width / 320, box.height / 240);
  assert.ok(Math.hypot(at.x - (box.x + box.width / 2 + u * scale), at.y - (box.y + box.height / 2 + v * scale)) < 3, JSON.stringify({ at, u, v, scale }));
  await page.evaluate(() => window.unseen.view('top'));
  await page.keyboard.press('5');
  const again = await page.evaluate(() => window.unseen.project('furniture', 0));
  assert.ok(Math.hypot(at.x - again.x, at.y - again.y) < 0.1);
  assert.deepEqual(errors, []);
  await close();
});

test('arrows can be picked', async () => {
  const { page, errors, close } = await open(browser, 'arrows', pageOf('arrows', [collisionScene()]));
  const at = await page.evaluate(() => window.unseen.project('impulses', 1));
  await page.mouse.click(at.x, at.y);
  assert.deepEqual(await selection(page), { structure: 'impulses', index: 1 });
  assert.match(await page.locator('.selection').innerText(), /ball/);
  assert.deepEqual(errors, []);
  await close();
});

test('phone: nothing wider than the screen, a tap selects', async () => {
  const { page, close } = await open(browser, 'phone', room, { width: 390, height: 844, touch: true });
  for (const tab of ['Found', 'Relations', 'How it was made']) {
    await page.getByRole('tab', { name: tab }).click();
    const wide = await page.evaluate(() => [document.documentElement.scrollWidth, document.querySelector('.side-body').scrollWidth - document.querySelector('.side-body').clientWidth]);
    assert.deepEqual(wide, [390, 0], tab);
  }
  const at = await page.evaluate(() => window.unseen.project('planes', 11));
  await page.touchscreen.tap(at.x, at.y);
  assert.deepEqual(await selection(page), { structure: 'planes', index: 11 });
  await close();
});

test('two scenes side by side move together', async () => {
  const { page, errors, close } = await open(browser, 'two', pageOf('two', [roomScene({ points: 5000, title: 'A' }), roomScene({ points: 5000, seed: 2, title: 'B' })]));
  const stages = page.locator('.stage canvas');
  assert.equal(await stages.count(), 2);
  const first = await stages.nth(1).screenshot();
  await stages.nth(0).hover({ position: { x: 60, y: 400 } });
  await page.mouse.wheel(0, -300);
  await settle(page);
  assert.ok(!(await stages.nth(1).screenshot()).equals(first), 'zooming one zooms the other');
  const at = await page.evaluate(() => window.unseen.project('planes', 11, 1));
  await page.mouse.click(at.x, at.y);
  assert.deepEqual(await page.evaluate(() => window.unseen.selection(1)), { structure: 'planes', index: 11 });
  assert.deepEqual(errors, []);
  await close();
});

test('two scenes side by side lie where their offsets say, if they overlap', async () => {
  const world = [[3, 1, 0], [9, 1, 0], [9, 6, 2], [3, 6, 2]];
  const scene = (offset, places = world) => {
    const b = new Buffers();
    return encodeScene({
      scene: 1, title: 'x', capability: 'planes', version: '0.2.0', command: '', facts: [], summary: { seconds: {}, energy: {}, counts: {}, warnings: [] }, options: [], input: {}, offset, tables: [],
      structures: [{ id: 'lines', kind: 'lines', name: 'Lines', visible: true, vertices: b.plain(places.flatMap((p) => p.map((x, a) => x - offset[a])), 3), quantities: [] }],
    }, b);
  };
  const placesOf = async (name, scenes) => {
    const { page, errors, close } = await open(browser, name, pageOf(name, scenes));
    const places = await page.evaluate(() => [0, 1].map((s) => {
      const box = document.querySelectorAll('.stage canvas')[s].getBoundingClientRect();
      return [0, 1].map((i) => window.unseen.project('lines', i, s)).flatMap((p) => [p.x - box.left, p.y - box.top]);
    }));
    assert.deepEqual(errors, []);
    await close();
    return places;
  };
  for (const [name, second] of [['near', scene([4, 2, 1])], ['far', scene([500003, 0, 0], world.map(([x, y, z]) => [x + 500003, y, z]))]]) {
    const [a, b] = await placesOf(name, [scene([0, 0, 0]), second]);
    a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) < 0.5, `${name}: ${a} and ${b}`));
  }
});

test('the picture can be exported and copied', async () => {
  const { page, close } = await open(browser, 'export', room);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.getByRole('button', { name: /Copy the picture/ }).click();
  await page.locator('[aria-live]', { hasText: 'Picture copied' }).waitFor();
  const size = await page.evaluate(async () => (await (await navigator.clipboard.read())[0].getType('image/png')).size);
  assert.ok(size > 5000, `${size} bytes`);
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: /Export the picture/ }).click()]);
  assert.match(download.suggestedFilename(), /\.png$/);
  await close();
});

test('three million points', { timeout: 90000 }, async (t) => {
  const { page, errors, close } = await open(browser, 'cloud', pageOf('cloud', [cloudScene(3e6)]));
  const ready = await page.evaluate(() => performance.now());
  await page.evaluate(() => window.unseen.complete());
  const complete = await page.evaluate(() => performance.now());
  t.diagnostic(`3 M points: first picture after ${(ready / 1000).toFixed(1)} s, all points after ${(complete / 1000).toFixed(1)} s`);
  assert.ok(ready < 40000);
  assert.deepEqual(errors, []);
  await close();
});
