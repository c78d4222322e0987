// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A page as a picture: node picture.mjs PAGE.html PICTURE.png [SCRIPT that runs in the page first]
import { readFileSync } from 'node:fs';
import { launch, open } from './browser.mjs';

const [page, picture, script = ''] = process.argv.slice(2);
const browser = await launch();
const opened = await open(browser, 'page', readFileSync(page, 'utf8'), { width: 1280, height: 800 });
await opened.page.evaluate(`(async () => { ${script}; await window.unseen.complete(); await new Promise((done) => setTimeout(done, 500)); })()`);
await opened.page.screenshot({ path: picture });
await browser.close();
