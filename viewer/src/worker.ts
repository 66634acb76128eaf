// SPDX-License-Identifier: MIT
// Reads meshes, builds indexes and answers queries, so that the page never waits.
import { Curvature, initialize, MeshIndex, readMesh, weld } from 'meshhood';
import type { Faces } from 'meshhood';
import { BufferAttribute, BufferGeometry } from 'three';
import { MeshBVH } from 'three-mesh-bvh';

import { EXAMPLES, findExample } from './examples';
import { METHODS } from './messages';
import type { Message, Method, Query, Reply, Request, Source } from './messages';
import { readPlyScalars } from './ply_scalars';
import type { CurvatureName, QuantityName } from './quantities';
import type { Scalar } from './scalar';
import { makeSurface } from './surface';

interface Arrays {
  positions: Float32Array | Float64Array;
  corners: Uint32Array;
  offsets: Uint32Array | null;
  walls: Uint8Array | null;
  warnings: string[];
  scalars: Scalar[];
  index?: MeshIndex; // that of an index file
}

let index: MeshIndex | null = null;
let faces: Faces | null = null;
let walls: Uint8Array | null = null;
let curvature: { radius: number; values: Curvature } | null = null; // the last one
let current = -1; // the opening of the index; the page asks nothing before the first
let latestOpening = 0;
let latestQuery = 0;
let latestComputation = 0;

function reply(message: Reply, transfer: Transferable[] = []): void {
  self.postMessage(message, { transfer });
}

function reportProgress(stage: string): (done: number, total: number) => void {
  let last = 0;
  return (done, total) => {
    const now = performance.now();
    if (now - last < 50 && done < total) return;
    last = now;
    reply({ kind: 'progress', stage, fraction: total > 0 ? done / total : null });
  };
}

/** Lets messages in that arrived meanwhile. */
const nextTask = () => new Promise<void>((resolve) => setTimeout(resolve));

function timed<T>(work: () => T): { result: T; seconds: number } {
  const begin = performance.now();
  const result = work();
  return { result, seconds: (performance.now() - begin) / 1000 };
}

const INDEX_MARK = [0x8b, 0x4d, 0x48, 0x49]; // "\x8bMHI", the first bytes of an index file

const NO_MORE = { offsets: null, walls: null, warnings: [], scalars: [] };

function makeExample(name: string): Arrays {
  const example = findExample(name) ?? EXAMPLES[0];
  return { ...NO_MORE, ...example.make(example.vertices) };
}

/** As `meshhood --weld`: the faces name the first of the vertices that are joined, but no wall. */
function joinVertices(mesh: Arrays, eps: number): void {
  const { ids } = weld(mesh.positions, mesh.corners, { offsets: mesh.offsets, eps });
  const first: number[] = [];
  ids.forEach((id, v) => {
    if (id === first.length || mesh.walls?.[first[id]]) first[id] = v;
  });
  mesh.corners = mesh.corners.map((v) => first[ids[v]]);
}

function read(bytes: Uint8Array<ArrayBuffer>, { name, weld: eps, precision }: Extract<Source, { kind: 'file' }>): Arrays {
  if (INDEX_MARK.every((byte, i) => bytes[i] === byte)) {
    const index = MeshIndex.load(bytes, { progress: reportProgress('Verifying the index') });
    return { ...NO_MORE, positions: index.positions, ...(index.faces ?? { corners: new Uint32Array() }), index };
  }
  const mesh = readMesh(bytes, name, { precision, progress: reportProgress('Reading') });
  const arrays = { ...mesh, scalars: mesh.format === 'ply' ? readPlyScalars(bytes, mesh.warnings) : [] };
  if (mesh.walls !== null) arrays.warnings.push('paper and bfs give no answers, because they know no walls');
  if (eps !== undefined) joinVertices(arrays, eps);
  return arrays;
}

function build({ positions, corners, offsets }: Arrays): MeshIndex {
  return new MeshIndex(positions, corners, { offsets, progress: reportProgress('Building the index') });
}

function makeTree(positions: Float32Array, triangles: Uint32Array): unknown {
  if (triangles.length === 0) return null;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  const onProgress = reportProgress('Preparing the picture');
  const tree = new MeshBVH(geometry, { onProgress: (fraction: number) => onProgress(fraction, 1) });
  return MeshBVH.serialize(tree, { cloneBuffers: false });
}

/** Opens the mesh, unless another one has been requested meanwhile. */
async function open(source: Source, opening: number): Promise<void> {
  latestOpening = opening;
  await initialize();
  reply({ kind: 'progress', stage: 'Reading', fraction: null });
  const bytes = source.kind === 'file' ? new Uint8Array(await source.content.arrayBuffer()) : null;
  if (opening !== latestOpening) return;
  const mesh = source.kind === 'file' ? read(bytes!, source) : makeExample(source.name);
  const { result: opened, seconds: buildSeconds } = timed(() => mesh.index ?? build(mesh));
  reply({ kind: 'progress', stage: 'Preparing the picture', fraction: null });
  const surface = makeSurface(mesh.positions, mesh.corners, mesh.offsets);
  const tree = makeTree(surface.positions, surface.triangles);
  index?.dispose();
  index = opened;
  current = opening;
  faces = { corners: mesh.corners, offsets: mesh.offsets };
  walls = mesh.walls;
  curvature = null;
  ++latestComputation;
  reply({
    kind: 'opened',
    opened: {
      opening, name: source.name, surface, tree,
      vertices: opened.vertexCount,
      faces: mesh.offsets === null ? mesh.corners.length / 3 : Math.max(mesh.offsets.length - 1, 0),
      meanEdge: opened.meanEdgeLength,
      indexBytes: opened.byteLength,
      buildSeconds, warnings: mesh.warnings, scalars: mesh.scalars,
      methods: walls === null ? METHODS : ['exact', 'ball'],
    },
  }, [surface.positions.buffer, surface.normals.buffer, surface.triangles.buffer]);
}

/**
 * Calls `work` for each method of the query in turn, `rounds` times. Returns whether all was done: no newer query and no
 * other mesh has come meanwhile.
 */
async function forEachMethod(
  query: Query, work: (index: MeshIndex, method: Method) => void, rounds = 1,
): Promise<boolean> {
  const asked = index!;
  latestQuery = Math.max(latestQuery, query.id);
  for (const method of Array<Method[]>(rounds).fill(query.methods).flat()) {
    await nextTask();
    if (query.id < latestQuery || index !== asked) return false;
    work(asked, method);
  }
  return true;
}

async function answer(query: Query): Promise<void> {
  await forEachMethod(query, (index, method) => {
    const ids = index.neighborhood(query.vertex, query.radius, { method, walls });
    reply({ kind: 'answer', id: query.id, method, ids }, [ids.buffer]);
  });
}

// Times. A browser compiles code again while it runs, faster code each time, and another process may take the processor for
// a moment. So the methods first run without a clock; then they are measured in turn, several times; and the median counts.
const WARM_UP = 40; // milliseconds for each method
const ROUNDS = 9;
const BATCH = 2; // milliseconds, as the clock of a browser is coarse

/** Milliseconds for `runs` queries. */
function duration(index: MeshIndex, query: Query, method: Method, runs: number): number {
  const begin = performance.now();
  for (let run = 0; run < runs; ++run) index.viewNeighborhood(query.vertex, query.radius, { method, walls });
  return performance.now() - begin;
}

/** Returns how many queries take as long as a batch. */
function warmUp(index: MeshIndex, query: Query, method: Method): number {
  let [runs, spent, last] = [1, 0, 0];
  while (spent < WARM_UP) {
    last = duration(index, query, method, runs);
    spent += last;
    if (last < BATCH) runs *= 2;
  }
  return runs;
}

async function time(query: Query): Promise<void> {
  const runs = new Map<Method, number>();
  const measured = new Map<Method, number[]>(query.methods.map((method) => [method, []]));
  const isDone = await forEachMethod(query, (index, method) => runs.set(method, warmUp(index, query, method)))
    && await forEachMethod(query, (index, method) => {
      const count = runs.get(method)!;
      measured.get(method)!.push((1000 * duration(index, query, method, count)) / count);
    }, ROUNDS);
  if (!isDone) return;
  const median = (times: number[]) => times.sort((a, b) => a - b)[ROUNDS >> 1];
  reply({ kind: 'times', id: query.id, times: new Map([...measured].map(([method, times]) => [method, median(times)])) });
}

/** Milliseconds for a part of a computation, after which queries are answered. */
const PART = 80;

/**
 * Calls `work` with all vertices, a part at a time, in index order. Returns whether no other computation has begun
 * meanwhile.
 */
async function forEachPart(stage: string, work: (index: MeshIndex, vertices: Uint32Array) => void): Promise<boolean> {
  const computation = ++latestComputation;
  const order = index!.permutation;
  for (let begin = 0, rows = 256; begin < order.length; ) {
    await nextTask();
    if (computation !== latestComputation) {
      reply({ kind: 'progress', stage: null, fraction: null });
      return false;
    }
    const vertices = order.subarray(begin, begin + rows);
    const { seconds } = timed(() => work(index!, vertices));
    begin += vertices.length;
    rows = Math.max(64, Math.round(rows * Math.min(2, Math.max(0.5, PART / (1000 * seconds)))));
    reply({ kind: 'progress', stage, fraction: begin / order.length });
  }
  return computation === latestComputation;
}

async function computeCounts(radius: number): Promise<Uint32Array | null> {
  const all = new Uint32Array(index!.vertexCount);
  const isDone = await forEachPart('Counting all neighborhoods', (index, vertices) => {
    const counts = index.counts(radius, { vertices, walls });
    vertices.forEach((v, row) => (all[v] = counts[row]));
  });
  return isDone ? all : null;
}

/** NaN where nothing could be fitted. */
async function computeCurvature(radius: number): Promise<Curvature | null> {
  if (curvature?.radius === radius) return curvature.values;
  const [k1, k2] = [0, 1].map(() => new Float64Array(index!.vertexCount));
  const isDone = await forEachPart('Fitting all neighborhoods', (index, vertices) => {
    const found = index.curvature(radius, { faces, vertices, walls });
    vertices.forEach((v, row) => {
      const isFitted = found.state[row] !== 2 && found.state[row] !== 3;
      k1[v] = isFitted ? found.k1[row] : NaN;
      k2[v] = isFitted ? found.k2[row] : NaN;
    });
  });
  if (!isDone) return null;
  const none = new Float64Array();
  curvature = { radius, values: new Curvature(k1, k2, none, none, new Uint8Array()) };
  return curvature.values;
}

async function compute(quantity: QuantityName, radius: number): Promise<void> {
  const values = quantity === 'count'
    ? await computeCounts(radius)
    : (await computeCurvature(radius))?.[quantity as CurvatureName];
  if (values) reply({ kind: 'computed', quantity, radius, values });
}

function findNeighbors(vertex: number): void {
  const ids = index!.neighborhood(vertex, 1, { metric: 'rings' }).filter((v) => v !== vertex);
  reply({ kind: 'neighbors', vertex, ids }, [ids.buffer]);
}

function saveIndex(): void {
  if (walls !== null) throw new Error(`vertex ${walls.indexOf(1)} has no position (NaN), which an index file cannot say`);
  const bytes = index!.save();
  reply({ kind: 'index', bytes }, [bytes.buffer]);
}

async function handle(request: Request, opening: number): Promise<void> {
  if (request.kind === 'open') return open(request.source, opening);
  if (opening !== current) return; // the page did not know yet that another mesh is open
  switch (request.kind) {
    case 'query': return answer(request.query);
    case 'time': return time(request.query);
    case 'neighbors': return findNeighbors(request.vertex);
    case 'compute': return compute(request.quantity, request.radius);
    case 'cancel': ++latestComputation; return;
    case 'save-index': return saveIndex();
  }
}

self.onmessage = ({ data: message }: MessageEvent<Message>) => {
  handle(message.request, message.opening).catch((error: unknown) => {
    const reason = error instanceof Error ? error.message : String(error);
    reply({ kind: 'failed', failed: message, reason });
  });
};
