// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Bundles src/ into one self-contained page, dist/page.html. The same sources give the same bytes;
// with --check it writes nothing and fails if the page on disk differs.
import { readFile, mkdir, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const common = { bundle: true, write: false, minify: true, legalComments: 'none', charset: 'utf8', absWorkingDir: here('.') };

const script = await build({
  ...common,
  entryPoints: ['src/main.ts'],
  format: 'iife',
  target: 'es2022',
  // Shaders say what they do in comments that the page need not carry.
  define: { __THREE_DEVTOOLS__: 'undefined' },
});
const style = await build({ ...common, entryPoints: ['src/style.css'], target: 'es2022' });

const licence = (await readFile(here('node_modules/three/LICENSE'), 'utf8')).trim();
const banner = `/*! The parts of three.js in this page:\n${licence}\n*/\n`;
// Inside a script element, "</script" would end it and "<!--" would change how it is read.
const js = (banner + script.outputFiles[0].text.trim()).replace(/<\/script/gi, '<\\/script').replace(/<!--/g, '<\\!--');
const css = style.outputFiles[0].text.trim().replace(/<\/style/gi, '<\\/style');

const template = await readFile(here('src/page.html'), 'utf8');
const page = template.replace('/*unseen:style*/', () => css).replace('/*unseen:script*/', () => js);
for (const mark of ['<!--unseen:title-->', '<!--unseen:scenes-->']) {
  if (page.split(mark).length !== 2) throw new Error(`${mark} must stand in the page exactly once`);
}
if (process.argv.includes('--check')) {
  const committed = await readFile(here('dist/page.html'), 'utf8');
  if (committed !== page) throw new Error('dist/page.html is not what the sources give: run "npm run build" and commit it');
  process.exit(0);
}
await mkdir(here('dist'), { recursive: true });
await writeFile(here('dist/page.html'), page);
console.log(`dist/page.html: ${(Buffer.byteLength(page) / 1024).toFixed(0)} kB`);
