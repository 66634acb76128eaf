// SPDX-License-Identifier: MIT
// The public part of the package. meshhood.d.ts documents it.
import { Instance, MeshhoodError, initialize } from './instance.js';

export { MeshhoodError, initialize };

const FORMATS = ['ply', 'obj', 'off', 'stl'];
const PRECISIONS = ['file', 'float', 'double'];
const METHODS = ['exact', 'paper', 'bfs', 'ball'];
const UNITS = ['mesh', 'edge'];

/** The place of `value` in `choices`. */
function choose(choices, value, name) {
  const place = choices.indexOf(value);
  if (place >= 0) return place;
  const expected = choices.map((choice) => `'${choice}'`).join(', ');
  throw new MeshhoodError('InvalidOption', `${name}: '${value}', expected one of ${expected}`);
}

function expectType(value, types, name) {
  if (types.some((type) => value instanceof type)) return;
  const found = value === null || typeof value !== 'object' ? String(value) : value.constructor?.name;
  throw new TypeError(`${name}: ${found}, expected ${types.map((type) => type.name).join(' or ')}`);
}

function expectBytes(value, name) {
  if (value instanceof ArrayBuffer || ArrayBuffer.isView(value)) return;
  throw new TypeError(`${name}: ${typeof value}, expected an ArrayBuffer or a typed array`);
}

function expectVertex(v) {
  if (!Number.isInteger(v)) throw new TypeError(`vertex ${String(v)}, expected a whole number`);
}

function expectRadius(radius) {
  if (typeof radius !== 'number') throw new TypeError(`radius ${String(radius)}, expected a number`);
}

/** Lets go of the memory of an index that is collected without `dispose`. */
const forgotten = new FinalizationRegistry((instance) => instance.dispose());

export function readMesh(bytes, name, { precision = 'file', strict = false, progress } = {}) {
  expectBytes(bytes, 'bytes');
  const place = choose(PRECISIONS, precision, 'precision');
  const instance = new Instance();
  try {
    instance.with(bytes, (file) =>
      instance.with(new TextEncoder().encode(name), (text, length) =>
        instance.callWithProgress(progress, 'read_mesh', file, bytes.byteLength, text, length, place, strict)));
    return takeMesh(instance);
  } finally {
    instance.dispose();
  }
}

function takeMesh(instance) {
  const take = (Type, address, count) => instance.view(Type, instance.call(address), instance.call(count)).slice();
  const Reals = instance.call('mesh_is_double') ? Float64Array : Float32Array;
  const offsets = take(Uint32Array, 'mesh_offsets', 'mesh_offset_count');
  const warnings = instance.call('mesh_warnings');
  return {
    format: FORMATS[instance.call('mesh_format')],
    positions: take(Reals, 'mesh_positions', 'mesh_scalar_count'),
    corners: take(Uint32Array, 'mesh_corners', 'mesh_corner_count'),
    offsets: offsets.length === 0 ? null : offsets,
    warnings: instance.text(warnings, instance.call('text_size')).split('\n').filter((line) => line !== ''),
  };
}

export class MeshIndex {
  #instance;

  constructor(positions, corners, { offsets = null, progress } = {}) {
    this.#instance = new Instance();
    forgotten.register(this, this.#instance, this);
    if (positions === LOADING) return;
    expectType(positions, [Float32Array, Float64Array], 'positions');
    expectType(corners, [Uint32Array, Int32Array], 'corners');
    if (offsets !== null) expectType(offsets, [Uint32Array, Int32Array], 'offsets');
    const ends = offsets ?? new Uint32Array();
    this.#instance.with(positions, (xyz) =>
      this.#instance.with(corners, (ids) =>
        this.#instance.with(ends, (begins) =>
          this.#instance.callWithProgress(progress, 'build',
            xyz, positions.length, positions instanceof Float64Array,
            ids, corners.length, corners instanceof Int32Array,
            begins, ends.length, ends instanceof Int32Array))));
  }

  static load(bytes, { progress } = {}) {
    expectBytes(bytes, 'bytes');
    const index = new MeshIndex(LOADING);
    index.#instance.with(bytes, (file) =>
      index.#instance.callWithProgress(progress, 'load', file, bytes.byteLength));
    return index;
  }

  save() {
    const address = this.#instance.call('save');
    const bytes = this.#instance.view(Uint8Array, address, this.#instance.call('saved_size')).slice();
    this.#instance.call('release_saved');
    return bytes;
  }

  get vertexCount() {
    return this.#instance.call('vertex_count') >>> 0;
  }

  get byteLength() {
    return this.#instance.call('index_bytes') >>> 0;
  }

  get memoryBytes() {
    return this.#instance.memoryBytes;
  }

  get meanEdgeLength() {
    return this.#instance.call('mean_edge_length');
  }

  get positions() {
    const Reals = this.#instance.call('graph_is_double') ? Float64Array : Float32Array;
    return this.#instance.view(Reals, this.#instance.call('graph_positions'), 3 * this.vertexCount).slice();
  }

  #scale(unit) {
    if (choose(UNITS, unit, 'unit') === 0) return 1;
    const length = this.meanEdgeLength;
    if (length > 0) return length;
    throw new MeshhoodError('InvalidOption', "unit: 'edge', but the mesh has no edges of positive length");
  }

  queryBall(v, r, { method = 'exact', unit = 'mesh', sort = false, distances = false } = {}) {
    const place = choose(METHODS, method, 'method');
    const scale = this.#scale(unit);
    if (v === null || typeof v === 'object') return this.#queryMany(place, v, r, scale, { sort, distances });
    expectRadius(r);
    const answer = this.#queryOne(place, v, scale * r, distances);
    if (!distances) {
      const ids = answer.ids.slice();
      return sort ? ids.sort() : ids;
    }
    const order = Array.from(answer.ids.keys());
    if (sort) order.sort((i, j) => answer.ids[i] - answer.ids[j]);
    return {
      ids: Uint32Array.from(order, (i) => answer.ids[i]),
      distances: Float64Array.from(order, (i) => answer.distances[i]),
    };
  }

  viewBall(v, r, { method = 'exact', unit = 'mesh' } = {}) {
    const place = choose(METHODS, method, 'method');
    expectRadius(r);
    return this.#queryOne(place, v, this.#scale(unit) * r, false).ids;
  }

  /** Views, valid until the next call. */
  #queryOne(method, v, radius, withDistances) {
    expectVertex(v);
    const count = this.#instance.call('query', method, v, radius, withDistances);
    const addresses = [this.#instance.call('answer_ids'), this.#instance.call('answer_distances')];
    return {
      ids: this.#instance.view(Uint32Array, addresses[0], count),
      distances: withDistances ? this.#instance.view(Float64Array, addresses[1], count) : null,
    };
  }

  queryBallCount(v, r, { method = 'exact', unit = 'mesh' } = {}) {
    const place = choose(METHODS, method, 'method');
    const scale = this.#scale(unit);
    if (v === null || typeof v === 'object') return this.#queryMany(place, v, r, scale, { countOnly: true });
    expectVertex(v);
    expectRadius(r);
    return this.#instance.call('count', place, v, scale * r) >>> 0;
  }

  #queryMany(method, v, r, scale, { sort = false, distances = false, countOnly = false }) {
    if (v !== null) expectType(v, [Uint32Array], 'vertices');
    const isList = typeof r !== 'number';
    if (isList) expectType(r, [Float64Array], 'radii');
    const radii = isList ? r.map((radius) => scale * radius) : new Float64Array();
    const count = this.#instance.with(v ?? new Uint32Array(), (vertices, rows) =>
      this.#instance.with(radii, (list) =>
        this.#instance.call('batch', method, v === null ? 0 : vertices, rows, isList ? 0 : scale * r,
          isList ? list : 0, radii.length, countOnly, distances, sort)) >>> 0);
    const answer = this.#takeRows(count, countOnly, distances);
    this.#instance.call('release_batch');
    return answer;
  }

  #takeRows(count, countOnly, distances) {
    const take = (Type, name, size) => this.#instance.view(Type, this.#instance.call(name), size).slice();
    const offsets = take(Uint32Array, 'answer_offsets', this.#instance.call('answer_offset_count'));
    if (countOnly) return offsets;
    const ids = take(Uint32Array, 'answer_ids', count);
    return distances ? { offsets, ids, distances: take(Float64Array, 'answer_distances', count) } : { offsets, ids };
  }

  dispose() {
    forgotten.unregister(this);
    this.#instance.dispose();
  }
}

/** Given to the constructor by `MeshIndex.load`. */
const LOADING = Symbol('loading');

// Where `using` is known.
if (Symbol.dispose) MeshIndex.prototype[Symbol.dispose] = MeshIndex.prototype.dispose;
