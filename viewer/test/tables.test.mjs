// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Tables, charts and the slider of time, in a headless browser.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch, open, selection, settle } from './browser.mjs';
import { Buffers, encodeScene, pageOf } from './make_scene.mjs';
import { collisionScene, cuboidsScene, interactionsScene, manyScene } from './scene_more.mjs';
import { roomScene } from './scene_room.mjs';

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser?.close());

test('tables sort by click and keyboard, thousands of rows stay light', async () => {
  const { page, errors, close } = await open(browser, 'many', pageOf('many', [manyScene(5000)]));
  const head = page.getByRole('columnheader', { name: /length/ });
  const values = async () => (await page.locator('tbody tr[data-row] td:nth-child(2)').allInnerTexts()).slice(0, 10).map(Number);
  await head.getByRole('button').click();
  assert.equal(await head.getAttribute('aria-sort'), 'ascending');
  let v = await values();
  assert.deepEqual(v, [...v].sort((a, b) => a - b));
  await page.keyboard.press('Enter');
  assert.equal(await head.getAttribute('aria-sort'), 'descending');
  v = await values();
  assert.deepEqual(v, [...v].sort((a, b) => b - a));
  assert.ok((await page.locator('tbody tr').count()) < 80, 'only rows in sight are in the page');
  await page.locator('.table-scroll').focus();
  await page.keyboard.press('ArrowDown');
  const first = await selection(page);
  await page.keyboard.press('ArrowDown');
  assert.notDeepEqual(await selection(page), first);
  await page.keyboard.press('End');
  await page.locator(`tr[data-row="${(await selection(page)).index}"][aria-selected="true"]`).waitFor();  // the last row is shown
  assert.deepEqual(errors, []);
  await close();
});

test('time: play, step, and the image follows', async () => {
  const { page, errors, close } = await open(browser, 'time', pageOf('time', [collisionScene()]));
  const image = page.locator('.images img');
  const source = await image.getAttribute('src');
  await page.evaluate(() => window.unseen.setTime(1.5));
  assert.notEqual(await image.getAttribute('src'), source);
  await page.evaluate(() => window.unseen.setTime(0));
  await page.locator('.stage canvas').focus();
  await page.keyboard.press('ArrowRight');
  assert.match(await page.locator('output[for=time]').innerText(), /0\.033 s/, 'by one frame of the motion');
  await page.keyboard.press(' ');
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('output[for=time]').innerText) > 0.1);
  await page.keyboard.press(' ');
  await page.getByRole('button', { name: 'Look through the camera' }).click();
  await settle(page);
  assert.deepEqual(errors, []);
  await close();
});

test('a chart follows the time, and a click into it sets the time', async () => {
  const { page, errors, close } = await open(browser, 'chart', pageOf('chart', [collisionScene()]));
  const chart = page.locator('svg.chart'), cursor = chart.locator('.cursor'), mark = chart.locator('.mark');
  assert.equal(await chart.locator('circle').count(), 122);
  await page.evaluate(() => window.unseen.setTime(1));  // the impact, at frame 30
  assert.equal(await cursor.getAttribute('x1'), Number(await mark.getAttribute('x1')).toFixed(1));
  const box = await chart.boundingBox();
  await page.mouse.click(box.x + box.width * ((await mark.getAttribute('x1')) / 340) + 40, box.y + 60);
  assert.ok(Number.parseFloat(await page.locator('output[for=time]').innerText()) > 1.1);
  assert.deepEqual(errors, []);
  await close();
});

test('an object of several boxes is one, and leads to the stretch of the chart that speaks for it', async () => {
  const { page, errors, close } = await open(browser, 'object', pageOf('object', [interactionsScene()]));
  const time = async () => Number.parseFloat(await page.locator('output[for=time]').innerText());
  const spans = page.locator('svg.chart .span'), marked = page.locator('svg.chart .span.on');
  assert.equal(await spans.count(), 3);
  assert.equal(await marked.count(), 0);
  const [low, high] = [await spans.nth(0).getAttribute('y'), await spans.nth(2).getAttribute('y')].map(Number);
  assert.ok(high > low, 'each colour has its lane');
  // A click on the chair's back, its second box.
  await page.evaluate(() => window.unseen.view('front'));
  const seat = await page.evaluate(() => window.unseen.project('furniture', 0));
  const meter = (await page.evaluate(() => window.unseen.project('furniture', 1))).x - seat.x;  // the table is 1.4 m to the left
  await page.mouse.click(seat.x + (0.27 * meter) / -1.4, seat.y + (0.62 * meter) / 1.4);
  assert.deepEqual(await selection(page), { structure: 'furniture', index: 0 });
  assert.match(await page.locator('.selection h3').innerText(), /Piece 0 · chair/);
  assert.equal(await page.locator('tr[data-row="0"]').getAttribute('aria-selected'), 'true');
  assert.equal(await time(), 2.5, 'the weightier of its two stretches');
  assert.equal(await marked.count(), 2);
  // From one of its stretches one does not jump to another.
  await page.evaluate(() => { window.unseen.select(null); window.unseen.setTime(0.5); window.unseen.select('furniture', 0); });
  assert.equal(await time(), 0.5);
  await page.evaluate(() => window.unseen.select('furniture', 1));
  assert.equal(await time(), 0.5);
  assert.equal(await marked.count(), 0);
  // The curve has a gap where there is no number.
  assert.equal((await page.locator('svg.chart path').getAttribute('d')).match(/M/g).length, 2);
  assert.deepEqual(errors, []);
  await close();
});

test('elements go by the names of their table, also what carries them and is none', async () => {
  const { page, errors, close } = await open(browser, 'named', pageOf('named', [cuboidsScene({ named: true })]));
  await page.locator('tr[data-row="0"]').first().click();
  assert.match(await page.locator('.selection h3').innerText(), /^Box 6 · table/);
  const chips = await page.locator('.selection .chip').allInnerTexts();
  assert.deepEqual(chips.sort(), ['box 7', 'box 8', 'ground 0']);
  assert.deepEqual(errors, []);
  await close();
});

test('a table of nothing in the scene selects nothing, and scrolls by keys', async () => {
  const { page, close } = await open(browser, 'dead', pageOf('dead', [cuboidsScene({ named: true })]));
  const contacts = page.locator('.table-scroll').nth(1);
  assert.ok(!/select/.test(await contacts.getAttribute('aria-label')));
  assert.ok(!/-0\.0/.test(await contacts.innerText()), 'no minus before a zero');
  await contacts.focus();
  await page.keyboard.press('End');
  await page.waitForFunction(() => document.querySelectorAll('.table-scroll')[1].scrollTop > 100);
  await page.locator('.table-scroll').nth(1).locator('tr[data-row="58"]').click();
  assert.equal(await selection(page), null);
  await close();
});

test('scenes of one title are told apart by the options that differ; what is not set has no unit', async () => {
  const at = (value) => cuboidsScene({ options: [{ name: 'gap', value, unit: 'm' }, { name: 'fill', value: 0.7, unit: '1' }, { name: 'noise', value: null, unit: 'm' }] });
  const { page, close } = await open(browser, 'options', pageOf('two', [at(0.01), at(0.02)]));
  assert.deepEqual(await page.locator('.stage-label').allInnerTexts(), ['ABoxes of frame.json · gap 0.01 m', 'BBoxes of frame.json · gap 0.02 m']);
  await page.getByRole('tab', { name: 'How it was made' }).click();
  assert.deepEqual(await page.locator('.options b').allInnerTexts(), ['0.01 m', '0.7', 'not set']);
  await close();
});

test('a printed page has every row of its tables', async () => {
  const { page, close } = await open(browser, 'print', pageOf('print', [cuboidsScene({ named: true })]));
  await page.emulateMedia({ media: 'print' });
  await page.waitForFunction(() => document.querySelectorAll('.table-scroll')[1].querySelectorAll('tbody tr[data-row]').length === 60);
  const box = await page.locator('.table-scroll').nth(1).evaluate((e) => [e.clientHeight, e.scrollHeight]);
  assert.ok(box[0] >= 60 * 30 && box[0] === box[1], String(box));
  await close();
});

test('what changes its order from time to time is not shown in between', async () => {
  const { page, close } = await open(browser, 'steps', pageOf('steps', [interactionsScene()]));
  const at = (t) => page.evaluate((time) => { window.unseen.setTime(time); return window.unseen.project('seen', 0); }, t);
  const [start, early, late, end] = [await at(0), await at(0.4), await at(0.6), await at(1)];
  assert.deepEqual([early, late], [start, end]);
  assert.ok(Math.abs(start.x - end.x) > 50);
  await close();
});

test('broken, newer and missing scenes say so', async () => {
  const newer = encodeScene({ scene: 99, title: 'x', structures: [] }, new Buffers());
  for (const [name, scenes, says] of [['broken', ['H4sIAAAA'], /damaged/], ['text', ['%%%'], /damaged/], ['newer', [newer], /version 99/], ['none', [], /no scene/]]) {
    const { page, close } = await open(browser, name, pageOf(name, scenes));
    assert.match(await page.locator('[role=alert]').innerText(), says, name);
    await close();
  }
});

test('without WebGL the tables are there', async () => {
  const hidden = pageOf('room', [roomScene({ points: 2000 })]).replace('<head>', '<head><script>const get = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return /webgl/.test(kind) ? null : get.call(this, kind, ...rest); };</script>');
  const { page, close } = await open(browser, 'no-webgl', hidden);
  assert.match(await page.locator('[role=alert]').innerText(), /no WebGL/);
  assert.equal(await page.locator('tbody tr[data-row]').count() > 10, true);
  await close();
});
