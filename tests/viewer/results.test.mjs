// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Pages of the program's own results in a headless browser. The program is named by UNSEEN, real scans lie in UNSEEN_DATA.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, open } from '../../viewer/test/browser.mjs';

const folder = mkdtempSync(join(tmpdir(), 'unseen-results-'));
const unseen = (...words) => execFileSync(process.env.UNSEEN, [...words, '--quiet'], { cwd: folder });
const html = (out, page = 'report.html') => readFileSync(join(folder, out, page), 'utf8');
const result = (out) => JSON.parse(readFileSync(join(folder, out, 'result.json'), 'utf8'));
const selection = (page) => page.evaluate(() => window.unseen.selection());

let browser;
before(async () => {
  browser = await launch();
  unseen('synth', 'planes', '-o', 'room', '--points', '60000', '--seed', '7');
  unseen('planes', 'room/cloud.ply', '-o', 'out');
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/** A page is in order: nothing asked for, nothing gone wrong, as many rows as the result has planes. */
async function inOrder(name, text, planes) {
  const opened = await open(browser, name, text);
  assert.deepEqual(opened.requests, []);
  assert.deepEqual(opened.errors, []);
  assert.equal(await opened.page.evaluate(() => document.querySelector('table').getAttribute('aria-rowcount')), String(planes + 1));
  return opened;
}

test('the page of a room: a click selects the plane under it', async () => {
  const { planes } = result('out');
  const { page, close } = await inOrder('room', html('out'), planes.length);
  assert.equal(await page.title(), 'Planes of cloud.ply');
  await page.evaluate(() => window.unseen.view('top'));
  // From above, the ceiling out of the way, the largest horizontal plane below eye level is what one sees.
  const floor = planes.filter((p) => p.tag === 'floor').sort((a, b) => b.area - a.area)[0];
  const at = await page.evaluate((p) => window.unseen.project('planes', p), floor.id);
  await page.mouse.click(at.x, at.y);
  const hit = await selection(page);
  assert.equal(hit?.structure, 'planes');
  assert.ok(Math.abs(planes[hit.index].normal[2]) > 0.99, `a click from above selected plane ${hit.index}, which stands upright`);
  for (const { id } of planes) {
    await page.evaluate((i) => window.unseen.select('planes', i), id);
    assert.deepEqual(await selection(page), { structure: 'planes', index: id });
  }
  await close();
});

test('a floor plan', async () => {
  unseen('synth', 'planes', '-o', 'plan', '--scene', 'floorplan', '--points', '10000');
  unseen('planes', 'plan/cloud.ply', '-o', 'lines');
  const { close } = await inOrder('plan', html('lines'), result('lines').planes.length);
  await close();
});

test('two results side by side', async () => {
  unseen('planes', 'room/cloud.ply', '-o', 'coarse', '--scale', '0.2');
  unseen('view', 'out', 'coarse');
  const { page, requests, errors, close } = await open(browser, 'both', html('out', 'compare.html'));
  assert.deepEqual([requests, errors], [[], []]);
  assert.equal(await page.locator('.stage canvas').count(), 2);
  await close();
});

test('people and objects', async () => {
  unseen('synth', 'interactions', '-o', 'lounge', '--seconds', '12', '--seed', '4');
  try {
    unseen('interactions', 'lounge/take.json', '-o', 'acts');
  } catch (error) {
    assert.equal(error.status, 4);  // nothing found: there is a page all the same
  }
  const { objects, people, fps } = result('acts');
  const { page, requests, errors, close } = await open(browser, 'acts', html('acts'));
  assert.deepEqual([requests, errors], [[], []]);
  assert.equal(await page.title(), 'Interactions of lounge');
  assert.equal(await page.locator('.over').count(), objects.length);
  for (const { id } of objects) {
    await page.evaluate((i) => window.unseen.select('objects', i), id);
    assert.deepEqual(await selection(page), { structure: 'objects', index: id });
  }
  // The middle of a person is where the result has its joints at that time.
  const { frame } = people[0].frames[20];
  const at = await page.evaluate((t) => { window.unseen.select(null); window.unseen.setTime(t); window.unseen.view('top'); return window.unseen.project('people', 0); }, frame / fps);
  const later = await page.evaluate((t) => { window.unseen.setTime(t); return window.unseen.project('people', 0); }, people[0].frames[60].frame / fps);
  const moved = people[0].frames[60].joints[6][0] - people[0].frames[20].joints[6][0];
  if (Math.abs(moved) > 0.3) assert.equal(Math.sign(later.x - at.x), Math.sign(moved));
  await close();
});

test('real scans', async (t) => {
  for (const [scan, ...options] of [['rapter/lhouse_bu3.ply', '--scale', '0.0175'], ['rapter/lans_100k.ply', '--scale', '0.02'], ['rapter/overview_sigg2d.ply', '--angles', '60,90']]) {
    const path = join(process.env.UNSEEN_DATA ?? '', 'planes', scan);
    if (!existsSync(path)) {
      t.diagnostic(`skipped: ${scan} is not here`);
      continue;
    }
    unseen('planes', path, '-o', 'scan', ...options);
    const { close } = await inOrder('scan', html('scan'), result('scan').planes.length);
    await close();
  }
});
