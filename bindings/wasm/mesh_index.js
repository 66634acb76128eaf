// SPDX-License-Identifier: MIT
import {
  choose, expectBytes, expectFaces, expectMesh, expectNumber, expectPoint, expectRadius, expectSize, expectType,
  expectVertex, expectVertices, toReals, withDefaults, withFaces, withMesh,
} from './arguments.js';
import { Curvature } from './curvature.js';
import { Instance, MeshhoodError, Owner, makeInstance } from './instance.js';

const METHODS = ['exact', 'paper', 'bfs', 'ball'];
const BY_PATH = METHODS.length; // as in bindings/wasm/src/method.h
const METRICS = ['straight', 'path'];
const UNITS = ['mesh', 'edge'];
const REDUCTIONS = ['sum', 'mean', 'min', 'max', 'var', 'std', 'count'];
const KERNELS = ['box', 'epanechnikov', 'biweight'];
const MISSING = ['propagate', 'omit'];
const NESTINGS = ['own', 'patch'];
const FITS = ['quadric', 'jet'];

// The options of the calls, with their defaults.
const BUILDING = { offsets: null, cut: null, progress: undefined };
const QUERY = { method: 'exact', metric: 'straight', unit: 'mesh' };
const ANSWER = { sort: false, distances: false };
const MASKS = { walls: null, ignored: null };
const SEARCH = { seeds: null, ...MASKS };
const SMOOTHING = { weights: null, faces: null, vertices: null, nan: 'propagate', unit: 'mesh' };
const AGGREGATION = { reduce: 'mean', kernel: 'box', nesting: 'own', ddof: 0, ...SMOOTHING };
const CURVATURE = {
  vertices: null, faces: null, normals: null, like: null, fit: 'quadric', filter: true, unit: 'mesh',
};

function chooseMethod(method, metric) {
  const place = choose(METHODS, method, 'method');
  if (choose(METRICS, metric, 'metric') === 0) return place;
  if (method === 'exact') return BY_PATH;
  throw new MeshhoodError('InvalidOption', `method: '${method}', expected 'exact' with metric 'path'`);
}

function build(positions, corners, options = {}) {
  const { offsets, cut, progress } = withDefaults(options, BUILDING);
  expectMesh(positions, { corners, offsets });
  expectVertices(cut, 'cut');
  return makeInstance((instance) =>
    withMesh(instance, positions, { corners, offsets }, (...mesh) => instance.with([cut], (ends) =>
      instance.callWithProgress(progress, 'build', ...mesh, ends, cut?.length ?? 0))));
}

/** What a refit needs, checked. */
function movement(positions, options = {}) {
  const { changed } = withDefaults(options, { changed: null });
  expectType(positions, [Float32Array, Float64Array], 'positions');
  expectVertices(changed, 'changed');
  return { positions, changed };
}

/** Moves the vertices of the index in `instance`. */
function move(instance, { positions, changed }) {
  instance.with([positions, changed], (xyz, list) => instance.call(
    'refit', xyz, positions.length, positions instanceof Float64Array, list, changed?.length ?? 0));
}

/** Ids and distances in ascending order of the ids. */
function sorted({ ids, distances }) {
  if (distances === undefined) return { ids: ids.sort() };
  const order = Array.from(ids.keys()).sort((i, j) => ids[i] - ids[j]);
  return { ids: Uint32Array.from(order, (i) => ids[i]), distances: Float64Array.from(order, (i) => distances[i]) };
}

export class MeshIndex extends Owner {
  #vertexCount;
  #hasWarned = false;

  constructor(positions, corners, options) {
    super(positions instanceof Instance ? positions : build(positions, corners, options));
    this.#vertexCount = this.instance.call('vertex_count') >>> 0;
  }

  static load(bytes, options = {}) {
    const { progress } = withDefaults(options, { progress: undefined });
    expectBytes(bytes, 'bytes');
    return new MeshIndex(makeInstance((instance) =>
      instance.with([bytes], (file) => instance.callWithProgress(progress, 'load', file, bytes.byteLength))));
  }

  save() {
    const address = this.instance.call('save');
    const bytes = this.instance.take(Uint8Array, address, this.instance.call('saved_size'));
    this.instance.call('release_saved');
    return bytes;
  }

  get vertexCount() {
    return this.#vertexCount;
  }

  get byteLength() {
    return this.instance.call('index_bytes') >>> 0;
  }

  get meanEdgeLength() {
    return this.instance.call('mean_edge_length');
  }

  get positions() {
    const Reals = this.instance.call('graph_is_double') ? Float64Array : Float32Array;
    return this.instance.take(Reals, this.instance.call('graph_positions'), 3 * this.vertexCount);
  }

  get permutation() {
    return this.instance.take(Uint32Array, this.instance.call('permutation'), this.vertexCount);
  }

  refit(positions, options) {
    const change = movement(positions, options);
    return new MeshIndex(makeInstance((copy) => move(copy, change), this.instance.clone()));
  }

  refitInPlace(positions, options) {
    move(this.instance, movement(positions, options));
  }

  quality() {
    this.instance.call('quality');
    const [meanRadius, rebuiltRadius, gain] = this.instance.takeReals();
    return { meanRadius, rebuiltRadius, gain };
  }

  #expectVertex(v) {
    expectVertex(v, this.#vertexCount);
  }

  #scale(unit) {
    if (choose(UNITS, unit, 'unit') === 0) return 1;
    const length = this.meanEdgeLength;
    if (length > 0) return length;
    throw new MeshhoodError('InvalidOption', "unit: 'edge', but the mesh has no edges of positive length");
  }

  // Neighborhoods.

  queryBall(v, r, options = {}) {
    const { method, metric, unit, sort, distances } = withDefaults(options, { ...QUERY, ...ANSWER });
    const place = chooseMethod(method, metric);
    const scale = this.#scale(unit);
    if (v === null || typeof v === 'object') return this.#queryMany(place, v, r, scale, { sort, distances });
    this.#query(place, v, r, scale, distances);
    return this.#takeNeighborhood(sort, distances);
  }

  viewBall(v, r, options = {}) {
    const { method, metric, unit } = withDefaults(options, QUERY);
    const count = this.#query(chooseMethod(method, metric), v, r, this.#scale(unit), false);
    return this.instance.view(Uint32Array, this.instance.call('answer_ids'), count);
  }

  count(v, r, options = {}) {
    const { method, metric, unit } = withDefaults(options, QUERY);
    const place = chooseMethod(method, metric);
    const scale = this.#scale(unit);
    if (v === null || typeof v === 'object') return this.#queryMany(place, v, r, scale, { countOnly: true });
    this.#expectVertex(v);
    expectRadius(r);
    return this.instance.call('count', place, v, scale * r) >>> 0;
  }

  /** Returns the number of ids. */
  #query(method, v, r, scale, distances) {
    this.#expectVertex(v);
    expectRadius(r);
    return this.instance.call('query', method, v, scale * r, distances);
  }

  /** Of one vertex or region. */
  #takeNeighborhood(sort, distances) {
    const ids = this.instance.takeIds();
    const found = distances ? { ids, distances: this.instance.takeReals() } : { ids };
    const answer = sort ? sorted(found) : found;
    return distances ? answer : answer.ids;
  }

  #queryMany(method, v, r, scale, { sort = false, distances = false, countOnly = false }) {
    expectVertices(v, 'vertices');
    const isList = typeof r !== 'number';
    if (isList) expectType(r, [Float64Array], 'radii');
    const radii = isList ? r.map((radius) => scale * radius) : null;
    this.instance.with([v, radii], (vertices, list) => this.instance.call('batch', method, vertices, v?.length ?? 0,
      isList ? 0 : scale * r, list, radii?.length ?? 0, countOnly, distances, sort));
    const answer = countOnly ? this.instance.takeCounts() : this.#takeRows(distances);
    this.instance.releaseAnswer();
    return answer;
  }

  #takeRows(distances) {
    const rows = { offsets: this.instance.takeCounts(), ids: this.instance.takeIds() };
    return distances ? { ...rows, distances: this.instance.takeReals() } : rows;
  }

  // Regions.

  queryRegion(start, r, options = {}) {
    const { unit, sort, distances, ...search } = withDefaults(options, { unit: 'mesh', ...ANSWER, ...SEARCH });
    expectRadius(r);
    const radius = this.#scale(unit) * r;
    const isNear = this.#search(start, search, () => this.instance.call('region', radius, distances));
    this.#warnUnless(isNear);
    return this.#takeNeighborhood(sort, distances);
  }

  queryNested(start, radii, options = {}) {
    const { unit, ...search } = withDefaults(options, { unit: 'mesh', ...SEARCH });
    const scale = this.#scale(unit);
    const scaled = toReals(radii, 'radii').map((radius) => scale * radius);
    const isNear = this.#search(start, search, () =>
      this.instance.with([scaled], (list) => this.instance.call('nested', list, scaled.length)));
    this.#warnUnless(isNear);
    return this.#takeRings();
  }

  queryRings(v, k, options = {}) {
    const masks = withDefaults(options, MASKS);
    this.#expectVertex(v);
    expectSize(k, 'k');
    this.#search(v, { seeds: null, ...masks }, () => this.instance.call('rings', v, k));
    return this.#takeRings();
  }

  contains(start, w, r, options = {}) {
    const { unit, ...search } = withDefaults(options, { unit: 'mesh', ...SEARCH });
    this.#expectVertex(w);
    expectRadius(r);
    const radius = this.#scale(unit) * r;
    return this.#search(start, search, () => this.instance.call('contains', w, radius)) !== 0;
  }

  connectingRadius(start, w, options = {}) {
    const search = withDefaults(options, SEARCH);
    this.#expectVertex(w);
    return this.#search(start, search, () => this.instance.call('connecting_radius', w));
  }

  nearestConnected(start, k, options = {}) {
    const search = withDefaults(options, SEARCH);
    expectSize(k, 'k');
    this.#search(start, search, () => this.instance.call('nearest_connected', k));
    return { ids: this.instance.takeIds(), radii: this.instance.takeReals() };
  }

  nearest(point) {
    expectPoint(point, 'point');
    const vertex = this.instance.call('nearest', ...point) >>> 0;
    return { vertex, distance: this.instance.takeReals()[0] };
  }

  /** Once for each index: a pointer that leaves the mesh would cause many. */
  #warnUnless(isNear) {
    if (isNear || this.#hasWarned) return;
    this.#hasWarned = true;
    console.warn('meshhood: the start is farther than the radius from the vertices where the search starts, so the ' +
      'region is empty; nearest() returns the nearest vertex and its distance');
  }

  /** Calls `use` while the start and the masks are in the memory of the module, and returns its result. */
  #search(start, { seeds, walls, ignored }, use) {
    if (typeof start === 'number') this.#expectVertex(start);
    else expectPoint(start, 'start');
    if (seeds !== null && typeof start === 'number') {
      throw new MeshhoodError('InvalidOption', 'seeds: expected null, for the start is a vertex');
    }
    expectVertices(seeds, 'seeds');
    for (const [mask, name] of [[walls, 'walls'], [ignored, 'ignored']]) {
      if (mask !== null) expectType(mask, [Uint8Array], name);
    }
    return this.instance.with([seeds, walls, ignored], (seedList, wallMask, ignoredMask) => {
      if (typeof start === 'number') this.instance.call('start_at_vertex', start);
      else this.instance.call('start_at_point', ...start, seedList, seeds?.length ?? 0);
      this.instance.call('restrict_search', wallMask, walls?.length ?? 0, ignoredMask, ignored?.length ?? 0);
      return use();
    });
  }

  #takeRings() {
    return { counts: this.instance.takeCounts(), ids: this.instance.takeIds() };
  }

  // Values and shape.

  aggregate(values, r, options = {}) {
    const { reduce, weights, kernel, vertices, nan, nesting, ddof, faces, unit } = withDefaults(options, AGGREGATION);
    const scale = this.#scale(unit);
    const signal = toReals(values, 'values');
    const radii = (typeof r === 'number' ? Float64Array.of(r) : toReals(r, 'r')).map((radius) => scale * radius);
    const channels = Math.max(1, Math.floor(signal.length / this.vertexCount) || 0);
    const choices = [
      choose(REDUCTIONS, reduce, 'reduce'), choose(KERNELS, kernel, 'kernel'), choose(MISSING, nan, 'nan'),
      choose(NESTINGS, nesting, 'nesting'),
    ];
    expectSize(ddof, 'ddof');
    expectVertices(vertices, 'vertices');
    const weighed = this.#weights(weights, faces);
    this.instance.with([signal, weighed, vertices, radii], (numbers, weightList, rows, radiusList) =>
      this.instance.call('aggregate', numbers, signal.length, channels, weightList, weighed?.length ?? 0,
        rows, vertices?.length ?? 0, radiusList, radii.length, ...choices, ddof));
    const aggregates = this.instance.takeReals();
    this.instance.releaseAnswer();
    return aggregates;
  }

  smooth(values, fwhm, options = {}) {
    const chosen = withDefaults(options, SMOOTHING);
    expectNumber(fwhm, 'fwhm');
    const radius = this.instance.call('smoothing_radius', fwhm);
    return this.aggregate(values, radius, { ...chosen, reduce: 'mean', kernel: 'biweight' });
  }

  #weights(weights, faces) {
    if (weights === null) return null;
    if (typeof weights !== 'string') return toReals(weights, 'weights');
    choose(['area'], weights, 'weights');
    if (faces === null) {
      throw new MeshhoodError('InvalidOption', "weights: 'area' needs the option faces, which an index does not keep");
    }
    expectFaces(faces);
    withFaces(this.instance, faces, (...six) => this.instance.call('areas', ...six));
    return this.instance.takeReals();
  }

  curvature(r, options = {}) {
    const { vertices, faces, normals, like, fit, filter, unit } = withDefaults(options, CURVATURE);
    expectRadius(r);
    const radius = this.#scale(unit) * r;
    expectVertices(vertices, 'vertices');
    if (like !== null) choose(['libigl'], like, 'like');
    const place = choose(FITS, fit, 'fit');
    this.#useNormals(faces, normals);
    this.instance.with([vertices], (rows) => this.instance.call(
      'curvature', rows, vertices?.length ?? 0, radius, place, Boolean(filter), like !== null));
    return this.#takeCurvature();
  }

  #useNormals(faces, normals) {
    if ((faces === null) === (normals === null)) {
      throw new MeshhoodError('InvalidOption', 'faces: expected the faces of the mesh, or normals, and not both');
    }
    if (faces !== null) {
      expectFaces(faces);
      withFaces(this.instance, faces, (...six) => this.instance.call('use_normals_of_faces', ...six));
    } else {
      const vectors = toReals(normals, 'normals');
      this.instance.with([vectors], (list) => this.instance.call('use_normals', list, vectors.length));
    }
  }

  #takeCurvature() {
    const rows = this.instance.call('curvature_rows');
    const take = (which, size) => this.instance.take(Float64Array, this.instance.call('curvature_reals', which), size);
    const state = this.instance.take(Uint8Array, this.instance.call('curvature_states'), rows);
    const curvature = new Curvature(take(0, rows), take(1, rows), take(2, 3 * rows), take(3, 3 * rows), state);
    this.instance.call('release_curvature');
    return curvature;
  }
}
