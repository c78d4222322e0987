// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Scenes as docs/scene.md lays them down, made up: for tests, and to develop the page without the C++ side.
import { gzipSync } from 'node:zlib';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const kTypes = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i32: Int32Array, f32: Float32Array };

/** Collects arrays into the buffer of a scene. */
export class Buffers {
  parts = [];
  size = 0;

  bytes(data) {
    const offset = this.size;
    const padded = Math.ceil(data.byteLength / 8) * 8;
    this.parts.push(Buffer.from(data.buffer, data.byteOffset, data.byteLength), Buffer.alloc(padded - data.byteLength));
    this.size += padded;
    return offset;
  }

  plain(values, components = 1, type = 'f32') {
    const data = kTypes[type].from(values);
    return { offset: this.bytes(data), count: data.length / components, components, type };
  }

  /** Integers, component after component, as differences, lowest bytes first. */
  delta(values, components, type, more = {}) {
    const data = kTypes[type].from(values);
    const n = data.length, count = n / components, width = data.BYTES_PER_ELEMENT;
    const out = new Uint8Array(n * width);
    let k = 0;
    for (let c = 0; c < components; ++c) {
      let last = 0;
      for (let i = 0; i < count; ++i, ++k) {
        const value = data[i * components + c];
        const d = value - last;
        last = value;
        for (let b = 0; b < width; ++b) out[b * n + k] = (d >> (8 * b)) & 255;
      }
    }
    return { offset: this.bytes(out), count, components, type, encoding: 'delta', ...more };
  }

  /** Positions in 16 bits. */
  quantised(values, components = 3) {
    const low = Array(components).fill(Infinity), high = Array(components).fill(-Infinity);
    for (let i = 0; i < values.length; ++i) {
      const c = i % components;
      if (values[i] < low[c]) low[c] = values[i];
      if (values[i] > high[c]) high[c] = values[i];
    }
    const data = new Uint16Array(values.length);
    for (let i = 0; i < values.length; ++i) {
      const c = i % components;
      data[i] = Math.round(((values[i] - low[c]) / (high[c] - low[c] || 1)) * 65535);
    }
    return this.delta(data, components, 'u16', { low, high });
  }
}

export function encodeScene(header, buffers) {
  const json = Buffer.from(JSON.stringify(header), 'utf8');
  const head = Buffer.alloc(Math.ceil((8 + json.length) / 8) * 8);
  head.write('UNS1', 0, 'latin1');
  head.writeUInt32LE(json.length, 4);
  json.copy(head, 8);
  return gzipSync(Buffer.concat([head, ...buffers.parts]), { level: 6 }).toString('base64');
}

export function pageOf(title, scenes) {
  const page = readFileSync(fileURLToPath(new URL('../dist/page.html', import.meta.url)), 'utf8');
  const text = scenes.map((s) => `<script type="text/plain" class="unseen-scene">${s}</script>`).join('\n');
  return page.replace('<!--unseen:title-->', () => title).replace('<!--unseen:scenes-->', () => text);
}

/** Numbers in [0, 1), the same in every run. */
export function random(seed = 1) {
  let a = seed >>> 0;
  return () => {
    a = (a + 0x6d2b79f5) | 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
