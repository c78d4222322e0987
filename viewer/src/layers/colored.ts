// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A layer whose elements each have one colour: from a quantity, the relation to the selection, or the layer's own.
import type { Structure } from '../format';
import type { Rgb } from '../palette';
import { ElementTable } from '../view/shared';
import { choicesOf, colorsBy, dress, kRelation, relationColors } from './coloring';
import { Layer, type ColorChoice, type LayerContext, type Look } from './layer';

export abstract class ColoredLayer extends Layer {
  protected readonly table: ElementTable;
  protected look?: Look;

  constructor(context: LayerContext, structure: Structure, readonly count: number, protected readonly fallback: (i: number, dark: boolean) => Rgb) {
    super(context, structure);
    this.table = new ElementTable(count);
    this.color = this.choices()[0]!.id;
  }

  override choices(): ColorChoice[] {
    return choicesOf(this.context.model, this.structure);
  }

  update(look: Look) {
    this.look = look;
    const { model } = this.context;
    const id = this.structure.id;
    const q = model.quantity(this.structure, this.color);
    const base = this.color === kRelation ? relationColors(model, id, look)
      : q ? colorsBy(model, q, this.count, [120, 150, 180]) : (i: number) => this.fallback(i, look.dark);
    const related = look.relations.get(id);
    const active = (related?.size ?? 0) > 0 && this.color !== kRelation;
    const hover = look.hover?.structure === id ? look.hover.index : -1;
    for (let i = 0; i < this.count; ++i) this.table.set(i, ...dress(base(i), related?.get(i), active, i === hover, look.dark), 255);
    this.table.commit();
  }

  /** Elements that stand out: selected or under the pointer. */
  protected marked(): number[] {
    const id = this.structure.id;
    const out = new Set<number>();
    if (this.look?.hover?.structure === id) out.add(this.look.hover.index);
    for (const [i, name] of this.look?.relations.get(id) ?? []) if (name === 'selected') out.add(i);
    return [...out].filter((i) => i >= 0 && i < this.count);
  }
}

/** Lines drawn over marked elements, in ink. */
export function inkTable(): ElementTable {
  return new ElementTable(1);
}

export function setInk(table: ElementTable, dark: boolean) {
  const v = dark ? 255 : 15;
  table.set(0, v, v, v, 255);
  table.commit();
}
