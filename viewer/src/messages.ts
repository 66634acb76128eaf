// SPDX-License-Identifier: MIT
// The messages between the page and its worker.
import type { Method } from 'meshhood';

import type { QuantityName } from './quantities';
import type { Scalar } from './scalar';

export type { Method };

/** All methods, in the order in which they are answered: the fastest first. */
export const METHODS: readonly Method[] = ['exact', 'ball', 'paper', 'bfs'];

export type Source =
  /** With `weld`, vertices at most this far apart are joined: faces name the first of them. */
  | { kind: 'file'; name: string; content: Blob; weld?: number; precision?: 'float' | 'double' }
  | { kind: 'example'; name: string };

export interface Query {
  /** Grows with each query; a newer query ends an older one. */
  id: number;
  vertex: number;
  /** In the unit of the positions. */
  radius: number;
  methods: Method[];
}

export type Request =
  | { kind: 'open'; source: Source }
  | { kind: 'query'; query: Query }
  | { kind: 'time'; query: Query }
  /** The vertices that an edge joins with `vertex`. */
  | { kind: 'neighbors'; vertex: number }
  /** For all vertices. */
  | { kind: 'compute'; quantity: QuantityName; radius: number }
  | { kind: 'cancel' }
  | { kind: 'save-index' };

/** About the mesh of an opening. Those about another mesh than that of the worker are dropped. */
export interface Message {
  opening: number;
  request: Request;
}

/** A mesh for drawing: in float, relative to its middle and divided by `unit`, so that float represents it well. */
export interface Surface {
  positions: Float32Array;
  normals: Float32Array;
  triangles: Uint32Array;
  /** A power of two, in the unit of the mesh, so that meshes of any size are drawn with the same extent. */
  unit: number;
  /** Half the diagonal of the bounding box, in `unit`: in [1, 2). */
  extent: number;
}

export interface Opened {
  /** The number that `Engine.open` returned. */
  opening: number;
  name: string;
  surface: Surface;
  /** The tree of three-mesh-bvh over the triangles, serialized; null without triangles. */
  tree: unknown;
  vertices: number;
  faces: number;
  meanEdge: number;
  indexBytes: number;
  buildSeconds: number;
  /** Those that can answer: not all can where the mesh has walls. */
  methods: readonly Method[];
  warnings: string[];
  /** Further numbers of the vertices of a PLY file. */
  scalars: Scalar[];
}

export type Reply =
  | { kind: 'progress'; stage: string | null; fraction: number | null }
  | { kind: 'opened'; opened: Opened }
  | { kind: 'failed'; failed: Message; reason: string }
  | { kind: 'answer'; id: number; method: Method; ids: Uint32Array }
  | { kind: 'times'; id: number; times: Map<Method, number> }
  | { kind: 'neighbors'; vertex: number; ids: Uint32Array }
  | { kind: 'computed'; quantity: QuantityName; radius: number; values: Uint32Array | Float64Array }
  | { kind: 'index'; bytes: Uint8Array<ArrayBuffer> };
