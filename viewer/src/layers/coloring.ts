// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Colours of the elements of a structure by one of its quantities.
import type { Quantity, Structure } from '../format';
import type { Model } from '../model';
import { kNone, labelColor, relationColor, scalarColor, type Rgb } from '../palette';
import type { ColorChoice, Look } from './layer';

export const kRelation = 'relation';

/** What a structure can be coloured by. */
export function choicesOf(model: Model, s: Structure, linked?: Structure): ColorChoice[] {
  const own = (s.quantities ?? []).filter((q) => q.kind !== 'vector').map((q) => ({ id: q.id, name: q.name, quantity: q, of: s }));
  const theirs = (linked?.quantities ?? []).filter((q) => q.kind !== 'vector')
    .map((q) => ({ id: `@${q.id}`, name: `${q.name} (${linked!.name.toLowerCase()})`, quantity: q, of: linked! }));
  const related = model.graphs.some((g) => g.elements && (g.elements.structure === s.id || g.elements.structure === linked?.id));
  // Points of planes begin with the colours of their planes.
  const first = s.quantities?.[0];
  const choices: ColorChoice[] = first && linked && first.structure === linked.id ? [...theirs, ...own] : [...own, ...theirs];
  if (choices.length === 0) choices.push({ id: '', name: 'Each its own' });
  if (related) choices.push({ id: kRelation, name: 'Relation to the selection' });
  return choices;
}

/** The colour of each element, without regard to the selection. */
export function colorsBy(model: Model, q: Quantity | undefined, count: number, fallback: Rgb): (i: number) => Rgb {
  if (!q || q.kind === 'vector' || q.array.count < count) return () => fallback;
  if (q.kind === 'label') {
    const values = model.stored(q.array);
    return (i) => labelColor(values[i]! | 0);
  }
  if (q.kind === 'color') {
    const values = model.stored(q.array);
    return (i) => [values[3 * i]!, values[3 * i + 1]!, values[3 * i + 2]!];
  }
  const values = model.floats(q.array);
  const [low, high] = rangeOf(model, q);
  return (i) => scalarColor((values[i]! - low) / (high - low || 1));
}

export function rangeOf(model: Model, q: Quantity): [number, number] {
  if (q.low !== undefined && q.high !== undefined) return [q.low, q.high];
  let low = Infinity, high = -Infinity;
  for (const v of model.floats(q.array)) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low <= high ? [low, high] : [0, 1];
}

export function relationColors(model: Model, structure: string, look: Look): (i: number) => Rgb {
  const map = look.relations.get(structure);
  return (i) => relationColor(model, map?.get(i));
}

/** With something selected, what has no relation to it steps back. */
export function dress(color: Rgb, relation: string | undefined, active: boolean, hovered: boolean, dark: boolean): Rgb {
  let c = color;
  if (active && relation === undefined) {
    const back = dark ? 62 : 214;
    c = c.map((v) => Math.round(0.22 * v + 0.78 * back)) as Rgb;
  }
  if (hovered || relation === 'selected') c = c.map((v) => Math.round(v + 0.22 * (255 - v))) as Rgb;
  return c;
}

export { kNone };
