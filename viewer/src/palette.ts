// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Colours: a categorical palette for colour-blind people (Okabe and Ito), a sequential map, and the dress of selections.
import type { Model } from './model';

export type Rgb = [number, number, number];

// The same as in src/report/palette.cpp.
const kColors: Rgb[] = [
  [0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0], [86, 180, 233], [240, 228, 66], [110, 90, 70],
];
const kRounds = [0, 0.32, -0.28, 0.55, -0.45];

export const kNone: Rgb = [150, 153, 158];

function shade(color: Rgb, amount: number): Rgb {
  const target = amount > 0 ? 255 : 0;
  return color.map((c) => Math.round(c + Math.abs(amount) * (target - c))) as Rgb;
}

/** The colour of a label: eight colours, then lighter and darker rounds of them. */
export function labelColor(label: number): Rgb {
  if (label < 0) return kNone;
  const round = Math.floor(label / kColors.length);
  return shade(kColors[label % kColors.length]!, kRounds[round % kRounds.length]!);
}

// Viridis (van der Walt and Smith, CC0) at nine places.
const kViridis: Rgb[] = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
];

export function scalarColor(t: number): Rgb {
  if (!(t >= 0 || t < 0)) return kNone;
  const x = Math.min(1, Math.max(0, t)) * (kViridis.length - 1);
  const i = Math.min(kViridis.length - 2, Math.floor(x));
  return kViridis[i]!.map((c, k) => Math.round(c + (x - i) * (kViridis[i + 1]![k]! - c))) as Rgb;
}

export function css(color: Rgb): string {
  return `rgb(${color[0]} ${color[1]} ${color[2]})`;
}

/** Relations to what is selected. */
export const kSelected: Rgb = [0, 114, 178];
export const kSame: Rgb = [86, 180, 233];
const kRelated: Rgb[] = [[230, 159, 0], [0, 158, 115], [204, 121, 167], [213, 94, 0], [240, 228, 66]];

export function relationColor(model: Model, name: string | undefined): Rgb {
  if (name === undefined) return [190, 192, 196];
  if (name === 'selected') return kSelected;
  if (name === 'same direction') return kSame;
  return kRelated[Math.max(0, model.relationNames.indexOf(name)) % kRelated.length]!;
}
