// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// One scene with its arrays, and what of it belongs together.
import { floatArray, storedArray, type DecodedScene, type Numbers } from './decode';
import type { ArrayRef, Chart, Elements, GraphStructure, Header, Quantity, Span, Structure, Table } from './format';

export interface Selection {
  structure: string;
  index: number;
}

/** How elements of structures stand to the selection: 'selected', 'same direction' or the name of an edge. */
export type Relations = Map<string, Map<number, string>>;

export class Model {
  readonly header: Header;
  readonly structures: Structure[];
  readonly graphs: GraphStructure[];
  /** Every name that an edge has, in order. */
  readonly relationNames: string[];
  private readonly byId = new Map<string, Structure>();
  private readonly arrays = new Map<ArrayRef, Numbers>();
  private readonly nodesOf = new Map<Elements, Map<number, number[]>>();

  constructor(readonly scene: DecodedScene) {
    this.header = scene.header;
    this.structures = scene.header.structures.map((s) => ({ ...s, quantities: s.quantities ?? [] }));
    for (const s of this.structures) this.byId.set(s.id, s);
    this.graphs = this.structures.filter((s): s is GraphStructure => s.kind === 'graph');
    const names = new Set<string>();
    for (const g of this.graphs) for (const name of g.edge_names) names.add(name);
    this.relationNames = [...names].sort((a, b) => a.localeCompare(b, 'en', { numeric: true }));
  }

  get(id: string | undefined): Structure | undefined {
    return id === undefined ? undefined : this.byId.get(id);
  }

  /** Arrays that are looked at more than once; floats. */
  floats(ref: ArrayRef): Float32Array {
    let a = this.arrays.get(ref);
    if (!a) this.arrays.set(ref, (a = floatArray(this.scene, ref)));
    return a as Float32Array;
  }

  /** As stored; for integers. */
  stored(ref: ArrayRef): Numbers {
    let a = this.arrays.get(ref);
    if (!a) this.arrays.set(ref, (a = storedArray(this.scene, ref)));
    return a;
  }

  /** As stored, and not kept. */
  fresh(ref: ArrayRef): Numbers {
    return storedArray(this.scene, ref);
  }

  count(s: Structure): number {
    switch (s.kind) {
      case 'points': return s.positions.count;
      case 'planes': return s.normals.count;
      case 'lines': return s.vertices.count / 2;
      case 'boxes': return s.of ? [...this.stored(s.of)].reduce((n, e) => Math.max(n, e + 1), 0) : s.centers.count;
      case 'graph': return s.node_names.length;
      case 'normals': return s.after.count;
      case 'trajectory': return s.shapes.length;
      case 'skeleton': return Math.round(s.joints.count / Math.max(1, s.joint_count * s.times.count));
      case 'image': return s.frames?.length ?? 1;
      case 'mesh': return s.vertices.count;
      case 'arrows': return s.origins.count;
      default: return 1;
    }
  }

  quantity(s: Structure, id: string | undefined): Quantity | undefined {
    return s.quantities!.find((q) => q.id === id);
  }

  table(id: string): Table | undefined {
    return this.header.tables?.find((t) => t.structure === id);
  }

  /** The quantity of points that says which element of another structure each belongs to. */
  link(s: Structure): Quantity | undefined {
    return s.quantities!.find((q) => q.kind === 'label' && this.byId.has(q.structure ?? ''));
  }

  private nodes(elements: Elements, index: number): number[] {
    let map = this.nodesOf.get(elements);
    if (!map) {
      map = new Map();
      for (const [node, list] of elements.of_node.entries())
        for (const e of list) map.set(e, [...(map.get(e) ?? []), node]);
      this.nodesOf.set(elements, map);
    }
    return map.get(index) ?? [];
  }

  /** Nodes of a graph or normals structure that stand for what is selected. */
  nodesFor(s: { id: string; elements?: Elements }, selection: Selection | null): number[] {
    if (!selection) return [];
    if (selection.structure === s.id) return [selection.index];
    if (!s.elements) return [];
    if (s.elements.structure === selection.structure) return this.nodes(s.elements, selection.index);
    // Through the elements: a node of another graph or a direction on the sphere.
    const other = this.get(selection.structure);
    if ((other?.kind !== 'graph' && other?.kind !== 'normals') || other.elements?.structure !== s.elements.structure) return [];
    const found = new Set<number>();
    for (const e of other.elements.of_node[selection.index] ?? []) for (const n of this.nodes(s.elements, e)) found.add(n);
    return [...found];
  }

  /** Neighbours of nodes: node → name of the edge. */
  neighbours(graph: GraphStructure, nodes: number[]): Map<number, string> {
    const edges = this.stored(graph.edges);
    const out = new Map<number, string>();
    for (let e = 0; e < graph.edges.count; ++e) {
      const a = edges[2 * e]!, b = edges[2 * e + 1]!;
      const name = graph.edge_names[e] ?? 'related';
      if (nodes.includes(a) && !nodes.includes(b)) out.set(b, name);
      if (nodes.includes(b) && !nodes.includes(a)) out.set(a, name);
    }
    return out;
  }

  relations(selection: Selection | null): Relations {
    const out: Relations = new Map();
    if (!selection) return out;
    const put = (structure: string, index: number, name: string) => {
      let map = out.get(structure);
      if (!map) out.set(structure, (map = new Map()));
      if (!map.has(index)) map.set(index, name);
    };
    put(selection.structure, selection.index, 'selected');
    for (const s of this.structures) {
      if (s.kind === 'graph') {
        const nodes = this.nodesFor(s, selection);
        const whole = selection.structure !== s.elements?.structure;
        for (const n of nodes) {
          put(s.id, n, 'selected');
          for (const e of s.elements?.of_node[n] ?? []) put(s.elements!.structure, e, whole ? 'selected' : 'same direction');
        }
        for (const [n, name] of this.neighbours(s, nodes)) {
          put(s.id, n, name);
          for (const e of s.elements?.of_node[n] ?? []) put(s.elements!.structure, e, name);
        }
      } else if (s.kind === 'normals') {
        for (const n of this.nodesFor(s, selection)) {
          put(s.id, n, 'selected');
          if (selection.structure === s.id) for (const e of s.elements?.of_node[n] ?? []) put(s.elements!.structure, e, 'selected');
        }
      }
    }
    return out;
  }

  /** The stretches of a chart that speak for an element, the weightiest first. */
  spansFor(chart: Chart, selection: Selection | null): Span[] {
    const own = (chart.spans ?? []).filter((s) => s.elements && s.elements.structure === selection?.structure && s.elements.indices.includes(selection.index));
    return own.sort((a, b) => b.weight - a.weight);
  }

  /** A time at which one sees why an element is there: `time` if it is one of them. */
  momentOf(selection: Selection | null, time: number): number | null {
    for (const chart of this.header.charts ?? []) {
      const per = chart.x.seconds;
      const spans = this.spansFor(chart, selection);
      if (!per || spans.length === 0) continue;
      return spans.some((s) => s.from * per <= time && time <= s.to * per) ? time : 0.5 * (spans[0]!.from + spans[0]!.to) * per;
    }
    return null;
  }

  /** The name that the table gives an element in its first column, as for "box 6 (2)" and "ground 0". */
  givenName(selection: Selection): string | undefined {
    const table = this.table(selection.structure);
    const cell = table && /^(name|box|support|body)$/i.test(table.columns[0]?.name ?? '') ? table.rows[selection.index]?.[0] : undefined;
    return typeof cell === 'string' && cell !== '' ? cell : undefined;
  }

  /** What an element is called. */
  nameOf(selection: Selection): string {
    const s = this.get(selection.structure);
    if (!s) return '';
    const given = this.givenName(selection);
    if (given) return `${given[0]!.toUpperCase()}${given.slice(1)}`;
    if (s.kind === 'graph') return s.node_names[selection.index] ?? `node ${selection.index}`;
    const kind = s.element ?? { points: 'point', planes: 'plane', lines: 'line', boxes: 'box', normals: 'direction', trajectory: 'body',
                   skeleton: 'person', camera: 'camera', image: 'image', mesh: 'vertex', arrows: 'arrow', floor: 'floor' }[s.kind];
    return `${kind[0]!.toUpperCase()}${kind.slice(1)} ${selection.index}`;
  }
}
