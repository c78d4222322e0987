// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// From the text of a script element to a header and typed arrays.
import { SCENE_VERSION, type ArrayRef, type Header } from './format';

export type Numbers = Uint8Array | Uint16Array | Uint32Array | Int32Array | Float32Array;

export class SceneError extends Error {}

const kWidth = { u8: 1, u16: 2, u32: 4, i32: 4, f32: 4 } as const;

function bytesOfBase64(text: string): Uint8Array {
  const native = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array }).fromBase64;
  if (native) return native.call(Uint8Array, text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function gunzip(bytes: Uint8Array): Promise<ArrayBuffer> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

export interface DecodedScene {
  header: Header;
  buffer: ArrayBuffer;
  start: number;
}

/** Reads one embedded scene. Throws SceneError with a message for people. */
export async function decodeScene(text: string): Promise<DecodedScene> {
  if (typeof DecompressionStream === 'undefined')
    throw new SceneError('This browser cannot unpack the scene (DecompressionStream is missing). Chrome 80, Firefox 113 and Safari 16.4 can.');
  let buffer: ArrayBuffer;
  try {
    buffer = await gunzip(bytesOfBase64(text.trim()));
  } catch {
    throw new SceneError('The scene in this page is damaged: it cannot be unpacked. Was the file cut short?');
  }
  const view = new DataView(buffer);
  if (buffer.byteLength < 8 || view.getUint32(0, true) !== 0x31534e55)
    throw new SceneError('The scene in this page is damaged: it does not start with UNS1.');
  const length = view.getUint32(4, true);
  if (8 + length > buffer.byteLength) throw new SceneError('The scene in this page is damaged: its header is cut short.');
  let header: Header;
  try {
    header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length))) as Header;
  } catch {
    throw new SceneError('The scene in this page is damaged: its header is not JSON.');
  }
  if (typeof header.scene !== 'number' || !Array.isArray(header.structures))
    throw new SceneError('The scene in this page is damaged: its header lacks the version or the structures.');
  if (header.scene > SCENE_VERSION)
    throw new SceneError(`This scene has version ${header.scene}; this page reads versions up to ${SCENE_VERSION}. A newer unseen shows it.`);
  return { header, buffer, start: Math.ceil((8 + length) / 8) * 8 };
}

function viewOf(type: ArrayRef['type'], buffer: ArrayBuffer, start: number, n: number): Numbers {
  switch (type) {
    case 'u8': return new Uint8Array(buffer, start, n);
    case 'u16': return new Uint16Array(buffer, start, n);
    case 'u32': return new Uint32Array(buffer, start, n);
    case 'i32': return new Int32Array(buffer, start, n);
    case 'f32': return new Float32Array(buffer, start, n);
    default: throw new SceneError(`The scene holds an array of an unknown type: ${String(type)}.`);
  }
}

/** Stored numbers tuple by tuple, deltas undone, still quantised. */
export function storedArray(scene: DecodedScene, ref: ArrayRef): Numbers {
  const components = ref.components ?? 1;
  const n = ref.count * components;
  const at = scene.start + ref.offset;
  if (!(n >= 0) || at + n * kWidth[ref.type] > scene.buffer.byteLength)
    throw new SceneError('The scene in this page is damaged: an array reaches beyond its end.');
  if (ref.encoding !== 'delta') return viewOf(ref.type, scene.buffer, at, n);
  const bytes = new Uint8Array(scene.buffer, at, n * kWidth[ref.type]);
  const out = viewOf(ref.type, new ArrayBuffer(n * kWidth[ref.type]), 0, n);
  const width = kWidth[ref.type];
  for (let c = 0; c < components; ++c) {
    const low = c * ref.count;
    let value = 0;
    if (width === 1)
      for (let i = 0, to = c; i < ref.count; ++i, to += components) out[to] = value = (value + bytes[low + i]!) & 255;
    else if (width === 2)
      for (let i = low, to = c, end = low + ref.count; i < end; ++i, to += components)
        out[to] = value = (value + (bytes[i]! | (bytes[n + i]! << 8))) & 65535;
    else
      for (let i = low, to = c, end = low + ref.count; i < end; ++i, to += components)
        out[to] = value = (value + (bytes[i]! | (bytes[n + i]! << 8) | (bytes[2 * n + i]! << 16) | (bytes[3 * n + i]! << 24))) | 0;
  }
  return out;
}

/** The largest stored number of a quantised array. */
export function storedMax(ref: ArrayRef): number {
  return ref.type === 'u8' ? 255 : 65535;
}

/** Numbers as they are meant, in 32-bit floats. */
export function floatArray(scene: DecodedScene, ref: ArrayRef): Float32Array {
  const stored = storedArray(scene, ref);
  if (!ref.low || !ref.high) return stored instanceof Float32Array ? stored : Float32Array.from(stored);
  const components = ref.components ?? 1;
  const out = new Float32Array(stored.length);
  for (let c = 0; c < components; ++c) {
    const low = ref.low[c]!;
    const step = (ref.high[c]! - low) / storedMax(ref);
    for (let i = c; i < stored.length; i += components) out[i] = low + stored[i]! * step;
  }
  return out;
}
