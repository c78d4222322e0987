// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// The header of a scene, as docs/scene.md lays it down. Version 1.

export const SCENE_VERSION = 1;

export interface ArrayRef {
  offset: number;
  count: number;
  components?: number;
  type: 'u8' | 'u16' | 'u32' | 'i32' | 'f32';
  encoding?: 'plain' | 'delta';
  low?: number[];
  high?: number[];
}

export interface Quantity {
  id: string;
  name: string;
  kind: 'label' | 'scalar' | 'color' | 'vector';
  unit?: string;
  array: ArrayRef;
  names?: string[];
  structure?: string;
  low?: number;
  high?: number;
}

export interface Elements {
  structure: string;
  of_node: number[][];
}

interface Base {
  id: string;
  name: string;
  visible?: boolean;
  /** What one element is called. */
  element?: string;
  /** One an element, shown at it. */
  labels?: string[];
  quantities?: Quantity[];
}

export interface PointsStructure extends Base { kind: 'points'; positions: ArrayRef }
export interface PlanesStructure extends Base {
  kind: 'planes';
  vertices: ArrayRef;
  rings: ArrayRef;
  triangles: ArrayRef;
  triangle_plane: ArrayRef;
  normals: ArrayRef;
  before?: ArrayRef;
}
export interface LinesStructure extends Base { kind: 'lines'; vertices: ArrayRef; before?: ArrayRef }
export interface BoxPoses { centers: ArrayRef; rotations: ArrayRef; sizes: ArrayRef }
export interface BoxesStructure extends Base, BoxPoses { kind: 'boxes'; seen?: ArrayRef; before?: BoxPoses; of?: ArrayRef }
export interface GraphStructure extends Base {
  kind: 'graph';
  node_names: string[];
  edges: ArrayRef;
  edge_names: string[];
  elements?: Elements;
  positions?: ArrayRef;
  vectors?: ArrayRef;
}
export interface NormalsStructure extends Base {
  kind: 'normals';
  before?: ArrayRef;
  after: ArrayRef;
  weights?: ArrayRef;
  elements?: Elements;
}
export interface Shape { kind: 'box' | 'sphere' | 'mesh'; size?: number[]; mesh?: string }
export interface TrajectoryStructure extends Base {
  kind: 'trajectory';
  times: ArrayRef;
  positions: ArrayRef;
  rotations: ArrayRef;
  shapes: Shape[];
}
export interface SkeletonStructure extends Base {
  kind: 'skeleton';
  times: ArrayRef;
  joints: ArrayRef;
  bones: ArrayRef;
  joint_count: number;
  /** px */
  width?: number;
  /** Shown as at the nearest time: who is who differs between times. */
  steps?: boolean;
}
export interface CameraStructure extends Base {
  kind: 'camera';
  T_world_camera: number[];
  fx: number;
  fy: number;
  cx: number;
  cy: number;
  width: number;
  height: number;
  image?: string;
}
export interface ImageStructure extends Base {
  kind: 'image';
  width: number;
  height: number;
  format: string;
  data?: ArrayRef;
  frames?: ArrayRef[];
  times?: ArrayRef;
}
export interface ArrowsStructure extends Base { kind: 'arrows'; origins: ArrayRef; vectors: ArrayRef }
export interface FloorStructure extends Base { kind: 'floor'; low: number[]; high: number[]; height: number; cell?: number; image?: string }
export interface MeshStructure extends Base { kind: 'mesh'; vertices: ArrayRef; triangles: ArrayRef }

export type Structure =
  | PointsStructure | PlanesStructure | LinesStructure | BoxesStructure | GraphStructure | NormalsStructure
  | TrajectoryStructure | SkeletonStructure | CameraStructure | ImageStructure | MeshStructure | ArrowsStructure | FloorStructure;

export type Cell = string | number | null;
export interface Column { name: string; unit?: string; digits?: number }
export interface Table { title: string; structure?: string; columns: Column[]; rows: Cell[][] }
export interface Series { name: string; color: number; hollow?: boolean; line?: boolean; x: ArrayRef; y: ArrayRef }
/** A stretch of a chart's axis that speaks for elements of a structure. */
export interface Span { from: number; to: number; name: string; color: number; weight: number; elements?: { structure: string; indices: number[] } }
export interface Chart {
  title: string;
  x: { name: string; unit?: string; seconds?: number };
  y: { name: string; unit?: string; high?: number };
  series: Series[];
  marks?: { x: number; name: string }[];
  spans?: Span[];
}
export interface Summary {
  status?: string;
  seconds?: Record<string, number>;
  energy?: Record<string, number>;
  counts?: Record<string, number>;
  warnings?: string[];
}
export interface OptionValue { name: string; value: unknown; unit?: string; help?: string }

export interface Header {
  scene: number;
  title: string;
  capability?: string;
  command?: string;
  version?: string;
  offset?: number[];
  flat?: boolean;
  focus?: { low: number[]; high: number[] };
  inside?: boolean;
  /** What the page shows and how far to trust it. */
  about?: string;
  facts?: { name: string; value: string; help?: string }[];
  /** What a status other than 'solved' means here. */
  verdict?: string;
  summary?: Summary;
  options?: OptionValue[];
  input?: { path?: string; sha256?: string };
  thinned?: { shown: number; of: number };
  time?: { start: number; end: number; rate?: number };
  structures: Structure[];
  charts?: Chart[];
  tables?: Table[];
}
