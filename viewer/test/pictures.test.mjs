// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Small pictures of every kind of scene against those in reference/, which someone has looked at.
// UNSEEN_UPDATE_PICTURES=1 writes them anew.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { launch, open } from './browser.mjs';
import { pageOf } from './make_scene.mjs';
import { collisionScene, cuboidsScene, interactionsScene, planScene } from './scene_more.mjs';
import { roomScene } from './scene_room.mjs';

const folder = fileURLToPath(new URL('reference/', import.meta.url));
const scenes = {
  room: [roomScene({ points: 40000 }), 'unseen.select("planes", 11)'],
  section: [roomScene({ points: 40000 }), 'unseen.setFading(false); unseen.setSection("z", 1.2)'],
  plan: [planScene(), ''],
  cuboids: [cuboidsScene(), ''],
  collision: [collisionScene(), 'unseen.setTime(0.5)'],
  interactions: [interactionsScene(), 'unseen.setTime(0.5)'],
};

let browser;
before(async () => { browser = await launch(); });
after(() => browser?.close());

/** Runs in the page: the 3D view at 200 × 125 as a data URL, and how it differs from a reference. */
async function look(reference) {
  await window.unseen.complete();
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const small = (source) => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [200, 125];
    const pen = canvas.getContext('2d', { willReadFrequently: true });
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(source, 0, 0, 200, 125);
    return { url: canvas.toDataURL('image/png'), data: pen.getImageData(0, 0, 200, 125).data };
  };
  const seen = small(document.querySelector('.stage canvas'));
  if (!reference) return { url: seen.url };
  const image = new Image();
  image.src = reference;
  await image.decode();
  const wanted = small(image).data;
  let sum = 0, far = 0;
  for (let i = 0; i < wanted.length; i += 4) {
    const difference = Math.max(...[0, 1, 2].map((c) => Math.abs(wanted[i + c] - seen.data[i + c])));
    sum += difference;
    if (difference > 64) ++far;
  }
  const pixels = wanted.length / 4;
  return { url: seen.url, mean: sum / pixels, far: far / pixels };
}

for (const [name, [scene, script]] of Object.entries(scenes)) {
  test(`the picture of ${name}`, async (t) => {
    const file = `${folder}${name}.png`, update = process.env.UNSEEN_UPDATE_PICTURES === '1';
    const { page, close } = await open(browser, `picture-${name}`, pageOf(name, [scene]), { width: 1280, height: 800 });
    await page.evaluate(script);
    const reference = update ? null : `data:image/png;base64,${readFileSync(file).toString('base64')}`;
    const { url, mean, far } = await page.evaluate(look, reference);
    await close();
    if (update) {
      mkdirSync(folder, { recursive: true });
      writeFileSync(file, Buffer.from(url.split(',')[1], 'base64'));
      return;
    }
    t.diagnostic(`${name}: differs by ${mean.toFixed(2)} of 255 on average, by more than 64 in ${(100 * far).toFixed(2)} % of the pixels`);
    assert.ok(mean < 4 && far < 0.02, `differs by ${mean.toFixed(1)} on average, strongly in ${(100 * far).toFixed(1)} %`);
  });
}
