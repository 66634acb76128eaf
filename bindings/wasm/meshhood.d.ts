// SPDX-License-Identifier: MIT
/// <reference lib="esnext.disposable" />

/**
 * meshhood: the connected component of a mesh inside a ball around a vertex, exact and indexed.
 *
 * The neighborhood of vertex v with radius r: of the part of the mesh inside the ball of radius r around v, the
 * connected component that contains v.
 *
 *     import { MeshIndex, initialize, readMesh } from 'meshhood';
 *
 *     await initialize();
 *     const mesh = readMesh(await file.arrayBuffer(), file.name);
 *     const index = new MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets });
 *     const near = index.neighborhood(42, 1.5);
 */

/** The version of the package, as '0.1.0'. */
export const version: string;

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

/**
 * An error of the library, with the message of the C++ library. Arguments of a wrong type and unknown options give a
 * TypeError instead.
 */
export class MeshhoodError extends Error {
  constructor(code: ErrorCode, message?: string, options?: { cause?: unknown });
  readonly code: ErrorCode;
}

/**
 * Compiles the WebAssembly module; to be awaited once before all other calls. Later calls do nothing.
 *
 * @param source `meshhood.wasm`: its address, as bundlers give it, the response to a request for it, or its bytes; or the
 * compiled module; or a promise of one of these. An address may be relative to the page. By default the file beside this
 * module is read. `meshhood.wasm` must have the version of the package. If it is refused, call `initialize` again.
 */
export function initialize(source?: WasmSource | Promise<WasmSource>): Promise<void>;

export type WasmSource = string | URL | Response | Bytes | WebAssembly.Module;

export type Bytes = ArrayBuffer | ArrayBufferView;

declare global {
  // Of the library DOM. Without it, as under Node, these are empty.
  interface Response {}
  interface URL {}
  namespace WebAssembly {
    interface Module {}
  }
}

/**
 * Called during long calls: with 0 at the beginning, with `total` at the end, and when some of the work is done. Return
 * false to end the call with the error `Cancelled`.
 */
export type Progress = (done: number, total: number) => boolean | void;

/**
 * This type of array, of memory that is not shared, as all results are. TypeScript has told the two apart since version
 * 5.7; a `Blob` takes no shared memory.
 */
export type Unshared<Type extends { slice(): unknown }> = ReturnType<Type['slice']>;

/** Numbers of other types than double are copied into double. */
export type Numbers =
  | Float64Array
  | Float32Array
  | Uint32Array
  | Int32Array
  | Uint16Array
  | Int16Array
  | Uint8Array
  | Uint8ClampedArray
  | Int8Array;

/** Indices of 16 bits are copied into 32. */
export type Indices = Uint32Array | Int32Array | Uint16Array;

/** Triangles or polygons. A `Mesh` has these, too. */
export interface Faces {
  /** The corners of all faces, face after face. */
  corners: Indices;
  /** Face f has the corners `corners[offsets[f]]` to `corners[offsets[f + 1] - 1]`. Null: all are triangles. */
  offsets?: Indices | null;
}

/** A point on a face. */
export interface SurfacePoint {
  face: number;
  /** Of its triangle, in the order of `barycentric`. */
  vertices: Unshared<Uint32Array>;
  /** Its coordinates there: >= 0, with the sum 1. */
  barycentric: Unshared<Float64Array>;
  point: Unshared<Float64Array>;
  /** From the point that was asked for, or the origin of the ray. */
  distance: number;
}

/** The triangles or polygons of a file, in the numbering of the file. */
export interface Mesh {
  format: 'ply' | 'obj' | 'off' | 'stl' | 'vtk' | 'freesurfer';
  /** #V by 3, row by row. */
  positions: Unshared<Float32Array | Float64Array>;
  /** See `Faces`. */
  corners: Unshared<Uint32Array>;
  offsets: Unshared<Uint32Array> | null;
  /**
   * #V, or null: 1 for each vertex that is NaN in the file and in no face, as scanners mark holes, to be passed as
   * `walls`. `positions` has it where another vertex is.
   */
  walls: Unshared<Uint8Array> | null;
  /** Deviations from the format that were accepted, and whether float is coarse for the mesh; one sentence each. */
  warnings: string[];
}

export interface ReadOptions {
  /**
   * Of the coordinates: `file` means what the file declares (PLY, binary STL); of other text, float if that keeps what
   * is written, else double.
   */
  precision?: 'file' | 'float' | 'double';
  /** Treat deviations from the format as errors. */
  strict?: boolean;
  progress?: Progress | null;
}

/**
 * Reads a PLY, OBJ, OFF, STL, VTK (legacy) or FreeSurfer file, with the readers of the command line.
 *
 * @param bytes the file
 * @param name its name in messages; its extension decides only where the content does not
 * @throws MeshhoodError MalformedFile, UnsupportedFormat, InvalidMesh, TooLarge, Cancelled
 */
export function readMesh(bytes: Bytes, name: string, options?: ReadOptions): Mesh;

export interface WeldOptions {
  /** Of polygons; as in `Faces`. */
  offsets?: Indices | null;
  /**
   * Vertices at most this far apart are welded; finite, >= 0, in the unit of the positions. With 0, the default,
   * positions must be equal, where -0 equals 0.
   */
  eps?: number;
}

/** A welded mesh, and what has become of each vertex. */
export interface WeldedMesh {
  /** Of the kept vertices, in their order; of the type given. */
  positions: Unshared<Float32Array | Float64Array>;
  /** Of all faces, in their order; a face whose corners were welded with each other repeats a vertex. */
  corners: Unshared<Uint32Array>;
  offsets: Unshared<Uint32Array> | null;
  /** For each vertex of the mesh given, its id in this one: #V. */
  ids: Unshared<Uint32Array>;
}

/**
 * Makes one vertex of all vertices at the same place, so that faces which meet there are connected. WebGL needs
 * separate vertices where normals or texture coordinates differ; a search needs one.
 *
 * Vertices are taken in ascending order. A vertex becomes the first kept vertex at most `eps` away; if there is none,
 * it is kept. So kept vertices are more than `eps` apart, and no chain of near vertices collapses.
 *
 * @throws MeshhoodError InvalidMesh, InvalidOption, TooLarge
 */
export function weld(positions: Float32Array | Float64Array, corners: Indices, options?: WeldOptions): WeldedMesh;

/**
 * `exact`: the exact neighborhood, by the index. `paper`: the approximate neighborhood of the paper, a superset of
 * `exact` and a subset of `ball`. `bfs`: the exact neighborhood by breadth-first search, for comparison. `ball`:
 * another word for metric `space`. What a method other than `exact` needs is made at its first use.
 */
export type Method = 'exact' | 'paper' | 'bfs' | 'ball';

/** Of a radius: `mesh` is the unit of the positions, `edge` is `meanEdgeLength`. */
export type Unit = 'mesh' | 'edge';

/**
 * Of a radius and of distances. `straight`: in a straight line. `path`: lengths of the shortest paths along edges; the
 * vertices of one neighborhood then ascend by them. `surface`: the same for paths that also run straight over two
 * triangles that share a side, nearer to geodesics (docs/queries.md); it needs `faces`. `rings`: numbers of edges.
 * `space`: in a straight line, to every vertex, connected or not; k nearest, discs, and the nearest connected and
 * unconnected vertices refuse it. All but `straight` need method `exact`.
 */
export type Metric = 'straight' | 'path' | 'surface' | 'rings' | 'space';

export interface MetricOptions {
  metric?: Metric;
  /**
   * For metric `surface`: the faces that the index was built from; null for those that it holds. Their lines, about
   * 150 bytes a vertex for each use with or without masks, are kept until other faces are used, which each call checks.
   */
  faces?: Faces | null;
}

export interface QueryOptions extends MetricOptions {
  method?: Method;
  unit?: Unit;
}

/**
 * Restricts searches; needs method `exact` or `ball`. A mask has #V bytes; one other than 0 puts its vertex into the set. The index
 * of the last masks is kept: new ones take O(#V), the same are compared.
 */
export interface Masks {
  /** The search does not pass these vertices, and they belong to no answer: as if they were not in the mesh. */
  walls?: Uint8Array | null;
  /** The search passes these vertices, but they belong to no answer. */
  ignored?: Uint8Array | null;
}

/** Several radii, each for all rows, in any order. The argument `r` is then null, and the result has an axis for them. */
export interface Scales {
  scales?: Numbers | null;
}

/**
 * Of the vertices of a neighborhood. `index`: ascending places of `permutation`. `id`: ascending ids. `distance`:
 * ascending distances, then ids. Null: as found. This is the order of the index by default and with metric `rings`,
 * that of the distances with `path` and `surface`; another method has an order of its own, which is always the same.
 */
export type Sort = 'index' | 'id' | 'distance' | null;

/** Of calls that list vertices. With `distances: true` they also return the distances, in the metric of the radius. */
export interface AnswerOptions extends QueryOptions {
  sort?: Sort;
}

/** Many neighborhoods: row i is `ids[offsets[i]]` to `ids[offsets[i + 1] - 1]`, and the distances likewise. */
export interface Rows {
  offsets: Unshared<Uint32Array>;
  ids: Unshared<Uint32Array>;
}

/** The same for calls that return distances. */
export interface RowsWithDistances extends Rows {
  distances: Unshared<Float64Array>;
}

/** Vertices, and the distance of each. */
export interface IdsWithDistances {
  ids: Unshared<Uint32Array>;
  distances: Unshared<Float64Array>;
}

/** A vertex, or a point in space, which is then the center of the ball. */
export type Start = number | readonly [number, number, number] | Float32Array | Float64Array;

/**
 * Where a search starts, and what it may pass. The metric `rings` needs a vertex as start. By `path` and `surface`, a path
 * from a point begins with the straight line to a seed.
 */
export interface StartOptions extends Masks, MetricOptions {
  /**
   * If the start is a point: the vertices from which the search spreads, for example the corners of the face on which
   * the point lies; by default the vertex nearest to the point that is no wall. A seed outside the ball does not
   * count. If all are outside, the neighborhood is empty: the point is too far from the mesh. The first time that this
   * happens with an index, a warning is written to the console. `nearest` returns the nearest vertex and its distance.
   */
  seeds?: Uint32Array | null;
}

/** Of calls on many vertices. */
export interface RowOptions extends Masks, MetricOptions {
  /** The rows; null for all vertices. */
  vertices?: Uint32Array | null;
  unit?: Unit;
}

/** A radius, or one for each row. */
export type Radii = number | Numbers;

/** The neighborhoods of several radii, each vertex once: that of radius i is `ids[0]` to `ids[counts[i] - 1]`. */
export interface Nested {
  counts: Unshared<Uint32Array>;
  ids: Unshared<Uint32Array>;
}

export type Reduction = 'sum' | 'mean' | 'min' | 'max' | 'var' | 'std' | 'count' | 'median' | 'quantile';

export interface AggregateOptions extends RowOptions, Scales {
  /** One name, or several, which share one search. */
  reduce?: Reduction | readonly Reduction[];
  /**
   * #V numbers >= 0, for `sum`, `mean`, `var` and `std`; `area` is the area that each vertex represents, which needs
   * `faces`. A vertex of weight 0 is left out.
   */
  weights?: Numbers | 'area' | null;
  /**
   * For `sum` and `mean`, how the weight falls with the distance d: not at all, as 1 - (d/r)^2, as (1 - (d/r)^2)^2, or
   * as 1000^-(d/r)^2, a Gaussian of the full width at half maximum r / 1.57843.
   */
  kernel?: 'box' | 'epanechnikov' | 'biweight' | 'gaussian';
  /** `propagate`: a neighborhood with a NaN gives NaN. `omit`: NaN marks a missing value, which is left out. */
  nan?: 'propagate' | 'omit';
  /**
   * What scales mean. `own`: each has its own neighborhoods. `patch`: the neighborhoods of the largest, and of
   * them the vertices within each smaller radius.
   */
  nesting?: 'own' | 'patch';
  /** `var` and `std` divide by the number of values minus this, 0 or 1. */
  ddof?: 0 | 1;
  /** For `quantile`, 0 to 1, with linear interpolation. */
  q?: number;
}

/**
 * The metric of an order. `straight`: by connecting radius, as for `nearestConnected`. `path`: by the length of the
 * shortest path along edges, and so `surface`, `rings`: by the number of edges; each then by place in index order.
 */
export interface NearestOptions extends RowOptions {
  /** Only vertices up to this connecting radius, path length or number of edges. */
  r?: number;
}

export interface DiscOptions extends NearestOptions {
  /** #V numbers >= 0, whose sum is compared with the area; `area`, the default, needs `faces`. */
  weights?: Numbers | 'area';
}

/** Principal curvatures, one entry for each row; #scales by #rows if there are scales, here meant by #rows. */
export class Curvature {
  /** Of arrays that were computed in parts. They are not copied. */
  constructor(
    k1: Unshared<Float64Array>,
    k2: Unshared<Float64Array>,
    d1: Unshared<Float64Array>,
    d2: Unshared<Float64Array>,
    state: Unshared<Uint8Array>,
  );

  /**
   * k1 >= k2, in 1 / unit of the positions. Positive where the surface is convex, seen from the side of the normals:
   * 1 / R on a sphere with normals outward.
   */
  readonly k1: Unshared<Float64Array>;
  readonly k2: Unshared<Float64Array>;
  /** #rows by 3: unit vectors, with the sign that makes the component of largest magnitude positive. */
  readonly d1: Unshared<Float64Array>;
  readonly d2: Unshared<Float64Array>;
  /**
   * 0: fitted. 1: the points determine no unique quadric; the values are those of the one with the smallest
   * coefficients. 2: fewer than six vertices are in the ball or joined to these by edges, not across ignored vertices;
   * all values are 0. 3: the vertex has no normal, as it belongs to no face with an area; all values are 0. 4: fewer
   * than six vertices are in the ball; the fit is to these and to the nearest joined ones.
   */
  readonly state: Unshared<Uint8Array>;

  /** H = (k1 + k2) / 2. A new array, as of the others. */
  readonly mean: Unshared<Float64Array>;
  /** K = k1 k2. */
  readonly gaussian: Unshared<Float64Array>;
  /**
   * Koenderink's shape index: 1 on a dome, 0.5 on a ridge, 0 on a saddle, -0.5 in a valley, -1 in a bowl, NaN if flat.
   */
  readonly shapeIndex: Unshared<Float64Array>;
  /** Koenderink's curvedness, the square root of (k1^2 + k2^2) / 2. */
  readonly curvedness: Unshared<Float64Array>;
}

export interface CurvatureOptions extends RowOptions, Scales {
  /**
   * The faces that the index was built from, for the normals; null for those that it holds, or with `normals`. The
   * index keeps the normals until other faces or normals are used: a call with the same faces finds them again.
   */
  faces?: Faces | null;
  /** #V by 3, of any length. NaN where a vertex has none. */
  normals?: Numbers | null;
  /**
   * The values of `igl::principal_curvature`, whose shape operator is wrong where the fitted quadric is tilted against
   * the normal, for a neighborhood of the vertices nearer than r.
   */
  like?: 'libigl' | null;
  /** `quadric`: through the vertex and over its tangent plane. `jet`: as CGAL's `Monge_via_jet_fitting`. */
  fit?: 'quadric' | 'jet';
  /** Fit only vertices whose normal is less than 90 degrees from that of the query vertex, if at least six remain. */
  filter?: boolean;
}

/** What describes a neighborhood without unit, in the words of Python; docs/curvature.md explains each. */
export type Kind =
  | 'crease' | 'mean' | 'gaussian' | 'k1' | 'k2' | 'curvedness' | 'shape_index' | 'area' | 'volume' | 'gap'
  | 'height' | 'variation';

/** Of calls that need the faces. */
export interface FaceOptions {
  /**
   * Those that the index was built from, counterclockwise seen from outside; null for those that it holds. What is made
   * of them is kept until others are used.
   */
  faces?: Faces | null;
}

/** Of calls on the surface in a ball; the metric is the distance in space. A face with a wall is not there. */
export type SurfaceOptions = FaceOptions & Omit<RowOptions, 'metric' | 'faces'>;

/** In place of vertices, `points`, #rows by 3, and `face`, the face of each. */
export interface PointOptions {
  points?: Numbers | null;
  face?: Uint32Array | null;
}

/** The nearest points of the surface that are not of the patch, one for each row; with scales, for each at each. */
export interface Gaps {
  /** 2^32 - 1 where there is none. */
  face: Unshared<Uint32Array>;
  /** #rows by 3: of the triangle of the face that has the point, and its barycentric coordinates there. */
  vertices: Unshared<Uint32Array>;
  barycentric: Unshared<Float64Array>;
  /** #rows by 3; NaN where there is none. */
  point: Unshared<Float64Array>;
  /** Infinity where there is none. */
  distance: Unshared<Float64Array>;
}

export interface PatchOptions extends FaceOptions {
  /** Of a point. */
  face?: number | null;
  walls?: Uint8Array | null;
  unit?: Unit;
}

/**
 * Points are the vertices in the ball, then new ones on the sphere: on sides, and on the arcs along which faces leave
 * the ball. Chords replace arcs; each is at most `tolerance` r from its arc (by default 1e-3; from 1e-12 to 1).
 */
export interface ClippedMesh {
  /** #points by 3. */
  positions: Unshared<Float64Array>;
  /** #triangles by 3, as rows of `positions`. */
  corners: Unshared<Uint32Array>;
  /** The face of which each triangle is a part, ascending. */
  faces: Unshared<Uint32Array>;
  /** #points by 3: three vertices of the mesh, thrice the same for one in the ball; and barycentric weights in them. */
  vertices: Unshared<Uint32Array>;
  weights: Unshared<Float64Array>;
  /** Of the patch; that of the triangles is a little less. */
  area: number;
}

/** Some faces of a mesh, as a mesh of their own. */
export interface Submesh {
  positions: Unshared<Float32Array | Float64Array>;
  corners: Unshared<Uint32Array>;
  /** Null: all faces of the whole mesh are triangles. */
  offsets: Unshared<Uint32Array> | null;
  /** Its vertices by their ids in the whole mesh, ascending. */
  vertices: Unshared<Uint32Array>;
  /** Its faces by their numbers in the whole mesh, ascending. */
  faces: Unshared<Uint32Array>;
}

/** A polyline along which a surface leaves a ball. */
export interface RimLine {
  /** #points by 3. */
  points: Unshared<Float64Array>;
  /** #points by 2: of each point, the end of its edge inside the region, and the other. */
  edges: Unshared<Uint32Array>;
  /** A loop, whose last point is joined to its first. */
  isClosed: boolean;
}

export interface FeatureOptions extends RowOptions, Scales {
  /** As for `curvature`. */
  faces?: Faces | null;
  kinds?: Kind | readonly Kind[];
  /** As for `curvature`. */
  filter?: boolean;
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
   * @throws MeshhoodError InvalidMesh, TooLarge, Cancelled; of `cut` VertexOutOfRange, InvalidOption
   */
  constructor(
    positions: Float32Array | Float64Array,
    corners: Indices,
    options?: {
      offsets?: Indices | null;
      /** Edges that no search crosses: #cut by 2 vertices, in either order. */
      cut?: Uint32Array | null;
      progress?: Progress | null;
    },
  );

  /**
   * Loads a saved index and verifies all of it. The bytes are an index file of C++, Python or the command line.
   *
   * @throws MeshhoodError TooLarge; MalformedIndex, with the section, the byte, what it contains and what was expected
   */
  static load(bytes: Bytes, options?: { progress?: Progress | null }): MeshIndex;

  /** The bytes of an index file. The same mesh gives the same bytes on every machine. */
  save(): Unshared<Uint8Array>;

  /** #V. */
  readonly vertexCount: number;

  /** Of the index alone. */
  readonly byteLength: number;

  /** All memory of this index and of what its queries have needed so far. */
  readonly memoryBytes: number;

  /** The mean length of the edges, each counted once, in the unit of the positions; 0 if there are none. */
  readonly meanEdgeLength: number;

  /** A copy of the faces that the index holds: those that its file was saved with; else null. */
  readonly faces: { corners: Unshared<Uint32Array>; offsets: Unshared<Uint32Array> | null } | null;

  /** A copy of the positions, #V by 3, in the numbering and precision of the mesh. */
  readonly positions: Unshared<Float32Array | Float64Array>;

  /**
   * The vertices in index order: vertices that are near each other in the mesh are near each other here. Exact
   * answers list them in this order, and batches of vertices in this order are faster. A copy.
   */
  readonly permutation: Unshared<Uint32Array>;

  /**
   * A new index of the mesh after its vertices have moved; the edges stay. This index stays as it is. Answers are exact
   * whatever the positions; `quality` says when an index that is built again would answer faster.
   *
   * Faster than a build: it copies `memoryBytes`, however few vertices have moved, and computes the bounds of the leaves
   * that changed. Dispose the index that is no longer needed.
   *
   * @param positions #V by 3
   * @param options `changed`: the vertices that have moved, null for all. Positions of others are not read.
   * @throws MeshhoodError InvalidMesh, VertexOutOfRange, TooLarge
   */
  refit(positions: Float32Array | Float64Array, options?: { changed?: Uint32Array | null }): MeshIndex;

  /**
   * As `refit`, but this index becomes that of the moved mesh: for animations. No memory of the instance is copied. With
   * `changed`, the time depends on the number of these vertices, apart from a sum over all leaves. If arguments are
   * refused, the index stays as it is.
   *
   * @throws MeshhoodError InvalidMesh, VertexOutOfRange; TooLarge, where memory is out, which disposes the index
   */
  refitInPlace(positions: Float32Array | Float64Array, options?: { changed?: Uint32Array | null }): void;

  /**
   * How well the leaves fit the positions: their mean radius at some places of the mesh, that in a new index, and the
   * ratio. After a build, `gain` is about 1; at 1.5 and above a new index pays off if many queries follow.
   */
  quality(): { meanRadius: number; rebuiltRadius: number; gain: number };

  /**
   * The neighborhood of a start: the vertices that are connected to a seed by edges between vertices within r of the
   * start. A vertex is its own seed. A vertex at exactly r is inside. A wall has an empty neighborhood.
   *
   * An exact answer depends on the index, the arguments and the masks alone. Its ids are in index order: ascending
   * places of `permutation`. Another method than `exact` and the metric `rings` need a vertex as start.
   *
   * @param r the radius, >= 0 or Infinity
   * @throws MeshhoodError VertexOutOfRange, InvalidRadius, InvalidOption; TooLarge: if the result exceeds what the
   * module addresses, or if memory is out, which disposes the index. The calls below throw the same.
   */
  neighborhood(
    start: Start,
    r: number,
    options?: StartOptions & AnswerOptions & { distances?: false },
  ): Unshared<Uint32Array>;
  neighborhood(start: Start, r: number, options: StartOptions & AnswerOptions & { distances: true }): IdsWithDistances;
  neighborhood(
    start: Start,
    r: number,
    options?: StartOptions & AnswerOptions & { distances?: boolean },
  ): Unshared<Uint32Array> | IdsWithDistances;

  /** As `neighborhood`, without a copy: a view into the memory of the index, valid until its next call. */
  viewNeighborhood(start: Start, r: number, options?: StartOptions & QueryOptions): Unshared<Uint32Array>;

  /** The number of vertices of the neighborhood of a start. */
  count(start: Start, r: number, options?: StartOptions & QueryOptions): number;

  /**
   * The neighborhoods of strictly ascending radii, each vertex once, each ring in index order. With metric `straight`,
   * a near vertex may belong to a late ring.
   */
  nested(start: Start, radii: Numbers, options?: StartOptions & { unit?: Unit }): Nested;

  /** Whether the neighborhood of a start has vertex w. */
  contains(start: Start, w: number, r: number, options?: StartOptions & { unit?: Unit }): boolean;

  /**
   * The smallest radius whose neighborhood has vertex w; Infinity if there is none. Straight, it is the minimum, over
   * all paths of edges from a seed to w, of the largest distance between a vertex of the path and the start; else the
   * length of the shortest path, or its number of edges.
   */
  connectingRadius(start: Start, w: number, options?: StartOptions): number;

  /**
   * The k >= 1 nearest connected vertices and their connecting radii, which ascend; of equal radius, in the order of
   * their distances from the start, then of their ids; by path or rings, in index order. Fewer if no more are connected.
   */
  nearestConnected(
    start: Start,
    k: number,
    options?: StartOptions,
  ): { ids: Unshared<Uint32Array>; radii: Unshared<Float64Array> };

  /** The vertex nearest to a point in space that is no wall, connected or not; of several, that with the smallest id. */
  nearest(point: Exclude<Start, number>, options?: Pick<Masks, 'walls'>): { vertex: number; distance: number };

  /**
   * The point of the surface nearest to a point in space. Its triangle is one of those that cover the face; its vertices
   * are the seeds of a neighborhood there. Of several faces at the same distance, the one with the smallest number.
   *
   * @throws MeshhoodError InvalidMesh, InvalidOption
   */
  closestPoint(point: Exclude<Start, number>, options?: FaceOptions): SurfacePoint;

  /**
   * The first point of the surface on the ray from a point along a direction, which is not 0, of any length; null if it
   * meets nothing. It meets either side of a face, and slips through nowhere between faces. As `closestPoint` otherwise.
   */
  firstHit(origin: Exclude<Start, number>, direction: Exclude<Start, number>, options?: FaceOptions): SurfacePoint | null;

  /** The neighborhoods of many vertices, of all by default. */
  neighborhoods(r: Radii, options?: RowOptions & AnswerOptions & { distances?: false }): Rows;
  neighborhoods(r: Radii, options: RowOptions & AnswerOptions & { distances: true }): RowsWithDistances;
  neighborhoods(r: Radii, options?: RowOptions & AnswerOptions & { distances?: boolean }): Rows | RowsWithDistances;

  /** The number of vertices of each neighborhood: #rows; with scales, r is null, and the result is #scales by #rows. */
  counts(r: Radii | null, options?: RowOptions & QueryOptions & Scales): Unshared<Uint32Array>;

  /**
   * The k >= 1 nearest connected vertices of each vertex, itself included: #rows by k. Where a row has fewer, the
   * distance is Infinity and the id 2^32 - 1. Distances are connecting radii, path lengths or numbers of edges.
   */
  kNearest(k: number, options?: NearestOptions): IdsWithDistances;

  /**
   * A disc of fixed area around each vertex: the first vertices in the order of `kNearest` whose weights add up to at
   * least as much.
   *
   * @param area > 0, in the square of the unit of the positions
   */
  discs(area: number, options?: DiscOptions): RowsWithDistances;

  /**
   * For each vertex the nearest of those in its ball that do not belong to its neighborhood: another sheet, the other
   * side of a wall. Of several at the same distance, the one with the smallest id. Walls and ignored vertices are never
   * the nearest. Where there is none, as for a wall, the distance is Infinity and the vertex 2^32 - 1.
   */
  nearestUnconnected(
    r: Radii,
    options?: RowOptions,
  ): { vertex: Unshared<Uint32Array>; distance: Unshared<Float64Array> };

  /**
   * The area of the patch of each vertex or point, the connected surface in the ball, and the volume of the part of the
   * ball behind it, NaN where a border lies in the patch or where there is none, as of a point farther than r from its
   * face. A point at exactly r counts.
   *
   * @param r the radius, or one for each row; null with `scales`, which make the arrays #scales by #rows
   * @throws MeshhoodError InvalidOption, InvalidRadius, VertexOutOfRange, InvalidMesh
   */
  invariants(r: Radii | null, options?: SurfaceOptions & PointOptions & Scales): {
    area: Unshared<Float64Array>;
    volume: Unshared<Float64Array>;
  };

  /** The gap of each vertex or point: the nearest of the surface within r that is not of its patch. Throws likewise. */
  gaps(r: Radii | null, options?: SurfaceOptions & PointOptions & Scales): Gaps;

  /**
   * The numbers of the faces of a patch, ascending. Throws likewise.
   *
   * @param start a vertex; or a point on the face `face`, as `closestPoint` returns them
   */
  patch(start: Start, r: number, options?: PatchOptions): Unshared<Uint32Array>;

  /** A patch as a mesh of triangles that end at the sphere. Throws likewise. */
  clip(start: Start, r: number, options?: PatchOptions & { tolerance?: number }): ClippedMesh;

  /**
   * Area and volume of one patch: a row of `invariants`, but for rounding, also of a point. Where there is no patch, as
   * of a point farther than r from its face: 0 and NaN. Throws likewise.
   */
  measure(start: Start, r: number, options?: PatchOptions): { area: number; volume: number };

  /** The gap of one patch: a row of `gaps`, but for rounding, also of a point; null if there is none. Throws likewise. */
  gap(start: Start, r: number, options?: PatchOptions): SurfacePoint | null;

  /**
   * The faces with all corners in a region, or with at least one, as a mesh.
   *
   * @param ids the vertices of the region, in any order
   * @throws MeshhoodError VertexOutOfRange, InvalidMesh, InvalidOption
   */
  submesh(ids: Uint32Array, options?: FaceOptions & { corners?: 'all' | 'any' }): Submesh;

  /**
   * Where the surface leaves a region: polylines whose points lie on edges, at the distance r from the start. On a
   * manifold mesh without border all are closed. If the faces are consistently oriented, the region lies to the left.
   *
   * @param ids the region of `start` and `r`
   * @throws MeshhoodError as `submesh`, and InvalidRadius
   */
  rim(ids: Uint32Array, start: Start, r: number, options?: FaceOptions): RimLine[];

  /**
   * A sum, a mean or another aggregate of values over the neighborhood of each vertex. No ids are listed.
   *
   * @param values #V numbers, or #V by channels, vertex after vertex; each channel by itself
   * @param r the radius, or one for each row; null with `scales`
   * @returns #rows by channels by #reductions, with scales #scales by that. NaN where a neighborhood has no values, as
   * that of a wall; 0 for their sum.
   * @throws MeshhoodError InvalidOption, InvalidRadius, VertexOutOfRange, InvalidMesh; TooLarge, which disposes the
   * index if memory is out
   */
  aggregate(values: Numbers, r: Radii | null, options?: AggregateOptions): Unshared<Float64Array>;

  /**
   * The values smoothed by a Gaussian of this full width at half maximum, cut where its weight is below 1/1000. Values
   * beyond 1.57843 fwhm, or not connected within it, have no influence.
   */
  smooth(
    values: Numbers,
    fwhm: number,
    options?: Pick<AggregateOptions, 'weights' | 'faces' | 'vertices' | 'metric' | 'walls' | 'ignored' | 'nan' | 'unit'>,
  ): Unshared<Float64Array>;

  /**
   * Principal curvatures by a quadric that is fitted to the neighborhoods of radius r: one for all rows, one for each, or
   * null with `scales`. docs/curvature.md explains the numbers.
   *
   * @throws MeshhoodError InvalidOption, InvalidRadius, VertexOutOfRange, InvalidMesh; TooLarge, which disposes the
   * index if memory is out
   */
  curvature(r: Radii | null, options?: CurvatureOptions): Curvature;

  /**
   * Feature vectors without unit, so that scales can be compared. NaN where there is no result. Radii are > 0.
   *
   * @returns #rows by #kinds, with scales #scales by #rows by #kinds
   * @throws as `curvature`
   */
  features(r: Radii | null, options?: FeatureOptions): Unshared<Float64Array>;

  /**
   * The thickness of the wall at each vertex, or at points of faces: the way against the normal to the surface, or, with
   * the method 'sphere', the diameter of the largest ball that touches there from inside and has no point of an opposite
   * face in it, one whose normal turns from that normal by more than 53 degrees. The normal of a point is that of its
   * face, which does not count, nor does another face that has the point on a side. Faces are oriented counterclockwise,
   * seen from outside. Infinity where nothing else is met, or the radius of the ball exceeds the diagonal of the box
   * around the faces; NaN for a vertex without a normal or a face without an area.
   *
   * @param options of the face of each of `points`, the nearest point counts
   * @throws MeshhoodError VertexOutOfRange, InvalidMesh; InvalidOption, also for a face that the mesh does not have
   */
  thickness(options?: FaceOptions & PointOptions & {
    vertices?: Uint32Array | null;
    method?: 'ray' | 'sphere';
  }): Unshared<Float64Array>;

  /** Gives the memory back. All later calls throw an Error. */
  dispose(): void;
  [Symbol.dispose](): void;
}
