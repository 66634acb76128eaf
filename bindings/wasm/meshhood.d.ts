// SPDX-License-Identifier: MIT

/**
 * meshhood: the connected component of a mesh inside a ball around a vertex. Exact, by an index.
 *
 * The neighborhood of vertex v with radius r is the connected component, containing v, of the part of the mesh inside
 * the ball of radius r around v.
 *
 *     import { MeshIndex, initialize, readMesh } from 'meshhood';
 *
 *     await initialize();
 *     const mesh = readMesh(await file.arrayBuffer(), file.name);
 *     const index = new MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets });
 *     const near = index.queryBall(42, 1.5);
 */

/** The cause of a `MeshhoodError`; as `meshhood::ErrorCode` in C++. */
export type ErrorCode =
  | 'VertexOutOfRange'
  | 'InvalidRadius'
  | 'InvalidOption'
  | 'InvalidMesh'
  | 'MalformedFile'
  | 'UnsupportedFormat'
  | 'MalformedIndex'
  | 'IoFailure'
  | 'TooLarge'
  | 'Cancelled';

/** An error of the library, with the message of the C++ library. Arguments of a wrong type give a TypeError instead. */
export class MeshhoodError extends Error {
  readonly code: ErrorCode;
}

/**
 * Compiles the WebAssembly module; to be awaited once before all other calls. Later calls do nothing.
 *
 * @param source the bytes of `meshhood.wasm`, or the compiled module. By default the file beside this module is read.
 */
export function initialize(source?: BufferSource | WebAssembly.Module): Promise<void>;

/** Called during long calls, at most twenty times a second. Return false to end the call with the error `Cancelled`. */
export type Progress = (done: number, total: number) => boolean | void;

/** The triangles or polygons of a file, in the numbering of the file. */
export interface Mesh {
  format: 'ply' | 'obj' | 'off' | 'stl';
  /** #V by 3, row by row. */
  positions: Float32Array | Float64Array;
  /** The corners of all faces, face after face. */
  corners: Uint32Array;
  /** Face f has the corners `corners[offsets[f]]` to `corners[offsets[f + 1] - 1]`; null if all are triangles. */
  offsets: Uint32Array | null;
  /** Deviations from the format that were accepted, one sentence each. */
  warnings: string[];
}

export interface ReadOptions {
  /** Of the coordinates: `file` means double if the file declares it, float otherwise. */
  precision?: 'file' | 'float' | 'double';
  /** Treat warnings as errors. */
  strict?: boolean;
  progress?: Progress;
}

/**
 * Reads a PLY, OBJ, OFF or STL file, with the readers of the command line.
 *
 * @param bytes the file
 * @param name its name in messages; its extension decides only where the content does not
 * @throws MeshhoodError MalformedFile, UnsupportedFormat, InvalidMesh, TooLarge, Cancelled
 */
export function readMesh(bytes: BufferSource, name: string, options?: ReadOptions): Mesh;

/**
 * `exact`: the exact neighborhood, by the index. `paper`: the approximate neighborhood of the paper, a superset of
 * `exact` and a subset of `ball`. `bfs`: the exact neighborhood by breadth-first search, for comparison. `ball`: every
 * vertex within the radius in space, connected or not. What a method other than `exact` needs is made at its first use.
 */
export type Method = 'exact' | 'paper' | 'bfs' | 'ball';

export interface QueryOptions {
  method?: Method;
  /** Of the radius: `mesh` is the unit of the positions, `edge` is `meanEdgeLength`. */
  unit?: 'mesh' | 'edge';
}

export interface AnswerOptions extends QueryOptions {
  /** Ids of a neighborhood ascend; otherwise their order is unspecified but reproducible. */
  sort?: boolean;
}

/** The rows of many queries: row i is `ids[offsets[i]]` to `ids[offsets[i + 1] - 1]`, and the distances likewise. */
export interface Rows {
  offsets: Uint32Array;
  ids: Uint32Array;
}

/**
 * The index of a mesh. It owns an instance of the WebAssembly module, and with it all memory it needs: at most 4 GB.
 * `dispose` gives the memory back, as does `using`; an index that is forgotten is collected with its memory.
 *
 * Not shared between workers: send the arrays, or the bytes of `save`, and make an index there.
 */
export class MeshIndex {
  /**
   * Builds the index. The arrays are copied; later changes have no effect. O(#V log #V + #E).
   *
   * @param positions #V by 3, row by row, in any unit
   * @param corners #F by 3 vertices of triangles; with `offsets` the corners of polygons (see `Mesh`)
   * @throws MeshhoodError InvalidMesh, TooLarge, Cancelled
   */
  constructor(
    positions: Float32Array | Float64Array,
    corners: Uint32Array | Int32Array,
    options?: { offsets?: Uint32Array | Int32Array | null; progress?: Progress },
  );

  /**
   * Loads a saved index and verifies all of it. The bytes are those of an index file of C++, Python or the command line.
   *
   * @throws MeshhoodError MalformedIndex, naming the section, the byte, what it contains and what was expected; TooLarge
   */
  static load(bytes: BufferSource, options?: { progress?: Progress }): MeshIndex;

  /** The bytes of an index file. The same mesh gives the same bytes on every machine. */
  save(): Uint8Array;

  /** #V. */
  readonly vertexCount: number;

  /** Of the index alone. */
  readonly byteLength: number;

  /** All memory of this index and of what its queries have needed so far. */
  readonly memoryBytes: number;

  /** The mean length of the edges, each counted once, in the unit of the positions; 0 if there are none. */
  readonly meanEdgeLength: number;

  /** A copy of the positions, #V by 3, in the numbering and precision of the mesh. */
  readonly positions: Float32Array | Float64Array;

  /**
   * The vertices of the neighborhood of v, itself included. A vertex at exactly r is inside. With `distances`, also
   * their straight-line distances from v.
   *
   * @param v the vertex; or many as an array, null for all
   * @param r the radius, >= 0 or Infinity; for many vertices optionally one per vertex
   * @throws MeshhoodError VertexOutOfRange, InvalidRadius, InvalidOption; TooLarge, which disposes the index
   */
  queryBall(v: number, r: number, options?: AnswerOptions & { distances?: false }): Uint32Array;
  queryBall(
    v: number,
    r: number,
    options: AnswerOptions & { distances: true },
  ): { ids: Uint32Array; distances: Float64Array };
  queryBall(v: Uint32Array | null, r: number | Float64Array, options?: AnswerOptions & { distances?: false }): Rows;
  queryBall(
    v: Uint32Array | null,
    r: number | Float64Array,
    options: AnswerOptions & { distances: true },
  ): Rows & { distances: Float64Array };

  /** As `queryBall` for one vertex, without a copy: a view into the memory of the index, valid until its next call. */
  viewBall(v: number, r: number, options?: QueryOptions): Uint32Array;

  /** The number of vertices of each neighborhood. */
  queryBallCount(v: number, r: number, options?: QueryOptions): number;
  queryBallCount(v: Uint32Array | null, r: number | Float64Array, options?: QueryOptions): Uint32Array;

  /** Gives the memory back. All later calls throw an Error. */
  dispose(): void;
  [Symbol.dispose](): void;
}
