// SPDX-License-Identifier: MIT
import {
  PROGRESS, choose, chooseSome, expectBytes, expectForVertices, expectNumber, expectPoint, expectSize, expectType,
  expectVertex, expectVertices, toReals, withDefaults, withFaces, withMesh, withPositions,
} from './arguments.js';
import { Curvature } from './curvature.js';
import { Instance, MeshhoodError, Owner, makeInstance } from './instance.js';
import { MASKS, METRIC, METRICS, ROWS, SCALED_ROWS, useFaces, withMasks, withRows } from './rows.js';

const METHODS = ['exact', 'paper', 'bfs', 'ball'];
const ORDERS = ['index', 'id', 'distance'];
const ROW_SORTS = [null, 'id', 'distance']; // by `RowSort` of the library, which the search applies
const UNITS = ['mesh', 'edge'];
const REDUCTIONS = ['sum', 'mean', 'min', 'max', 'var', 'std', 'count', 'median', 'quantile'];
const KERNELS = ['box', 'epanechnikov', 'biweight', 'gaussian'];
const MISSING = ['propagate', 'omit'];
const CORNERS = ['all', 'any'];
const NESTINGS = ['own', 'patch'];
const FITS = ['quadric', 'jet'];
const THICKNESSES = ['ray', 'sphere'];
const EXPECTED_WEIGHTS = "'area' or a typed array of numbers";
const KINDS = [
  'crease', 'mean', 'gaussian', 'k1', 'k2', 'curvedness', 'shape_index', 'area', 'volume', 'gap', 'height',
  'variation',
];

// The options of the calls, with their defaults. Made once: a small query takes less time than spreading them.
const BUILDING = { offsets: null, cut: null, ...PROGRESS };
const QUERY = { method: 'exact', ...METRIC, unit: 'mesh' };
const ANSWER = { sort: null, distances: false };
const SEARCH = { seeds: null, ...METRIC, ...MASKS };
const SCALED_SEARCH = { unit: 'mesh', ...SEARCH };
const QUERY_OF_START = { ...QUERY, ...SEARCH };
const LIST_OF_START = { ...QUERY_OF_START, ...ANSWER };
const COUNTS = { ...QUERY, ...SCALED_ROWS };
const LISTS = { ...QUERY, ...ROWS, ...ANSWER };
const NEAREST = { r: Infinity, ...ROWS };
const DISCS = { ...NEAREST, weights: 'area' };
const SMOOTHING = { weights: null, nan: 'propagate', ...ROWS };
const AGGREGATION = { reduce: 'mean', kernel: 'box', nesting: 'own', ddof: 0, q: 0.5, ...SMOOTHING, scales: null };
const CURVATURE = { ...SCALED_ROWS, normals: null, like: null, fit: 'quadric', filter: true };
const VERTICES_OR_POINTS = { vertices: null, points: null, face: null, faces: null };
const PATCHES = { ...VERTICES_OR_POINTS, ...MASKS, unit: 'mesh', scales: null };
const PATCH = { face: null, faces: null, walls: null, unit: 'mesh' };
const CLIP = { ...PATCH, tolerance: 1e-3 };
const FEATURES = { ...SCALED_ROWS, kinds: 'crease', filter: true };
const ON_FACES = { faces: null };
const SUBMESH = { corners: 'all', ...ON_FACES };
const THICKNESS = { ...VERTICES_OR_POINTS, method: 'ray' };

function chooseMethod({ method, metric }) {
  const place = choose(METHODS, method, 'method');
  if (choose(METRICS, metric, 'metric') !== 0 && place !== 0) {
    throw new MeshhoodError('InvalidOption', `method: '${method}', expected 'exact' with metric '${metric}'`);
  }
  return place;
}

/** Points of faces: their coordinates and faces; or vertices. What is not asked for is null. */
function readPoints(given) {
  const vertices = expectVertices(given.vertices, 'vertices');
  const face = expectVertices(given.face, 'face');
  if ((given.points === null) !== (face === null) || (given.points !== null && vertices !== null)) {
    throw new MeshhoodError('InvalidOption', 'points: expected points and the face of each, or vertices');
  }
  if (face === null) return { coordinates: null, face, vertices };
  const coordinates = toReals(given.points, 'points');
  if (coordinates.length === 3 * face.length) return { coordinates, face, vertices };
  throw new MeshhoodError('InvalidOption',
    `points: ${coordinates.length} coordinates, expected three for each of ${face.length} faces`);
}

/** Of rows of seven numbers. */
const columns = (numbers, begin, end) => Float64Array.from(
  { length: (numbers.length / 7) * (end - begin) },
  (_, i) => numbers[7 * Math.floor(i / (end - begin)) + begin + (i % (end - begin))]);

const isVertex = (start) => typeof start === 'number';

/** The same for one start. Only the exact method takes points. */
function chooseMethodFrom(start, given) {
  const place = chooseMethod(given);
  if (place === 0 || isVertex(start)) return place;
  throw new MeshhoodError('InvalidOption', "start: a point, which needs method 'exact'");
}

function build(positions, corners, options = {}) {
  const { offsets, cut, progress } = withDefaults(options, BUILDING);
  const edges = expectVertices(cut, 'cut');
  return makeInstance((instance) =>
    withMesh(instance, positions, { corners, offsets }, () => instance.with([edges], (ends) =>
      instance.callWithProgress(progress, 'build', ends, edges?.length ?? 0))));
}

/** Moves the vertices of the index in `instance`. */
function move(instance, positions, options = {}) {
  const changed = expectVertices(withDefaults(options, { changed: null }).changed, 'changed');
  withPositions(instance, positions, () => instance.with([changed], (list) =>
    instance.call('refit', list, changed?.length ?? 0)));
}

export class MeshIndex extends Owner {
  #vertexCount;
  #hasWarned = false;
  #holdsOffsets = null; // not known yet

  constructor(positions, corners, options) {
    super(positions instanceof Instance ? positions : build(positions, corners, options));
    this.#vertexCount = this.instance.call('vertex_count') >>> 0;
  }

  static load(bytes, options = {}) {
    const { progress } = withDefaults(options, PROGRESS);
    const content = expectBytes(bytes, 'bytes');
    return new MeshIndex(makeInstance((instance) =>
      instance.with([content], (file) => instance.callWithProgress(progress, 'load', file, content.length))));
  }

  save() {
    const bytes = this.instance.takeArray(Uint8Array, 'save');
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

  get faces() {
    if (!this.instance.call('held_faces')) return null;
    const { ids, counts } = this.instance.takeAnswer();
    return { corners: ids, offsets: counts.length === 0 ? null : counts };
  }

  get positions() {
    const { constructor: Reals, byteOffset, length } = this.#viewPositions();
    return this.instance.take(Reals, byteOffset, length);
  }

  #viewPositions() {
    const Reals = this.instance.call('graph_is_double') ? Float64Array : Float32Array;
    return this.instance.view(Reals, this.instance.call('graph_positions'), 3 * this.vertexCount);
  }

  #positionsOf(vertices) {
    const all = this.#viewPositions();
    const positions = new all.constructor(3 * vertices.length);
    vertices.forEach((v, row) => positions.set(all.subarray(3 * v, 3 * v + 3), 3 * row));
    return positions;
  }

  get permutation() {
    const ids = this.instance.call('permutation');
    if (ids === 0) return Uint32Array.from({ length: this.vertexCount }, (_, v) => v);
    return this.instance.take(Uint32Array, ids, this.vertexCount);
  }

  refit(positions, options) {
    return new MeshIndex(makeInstance((copy) => move(copy, positions, options), this.instance.clone()));
  }

  refitInPlace(positions, options) {
    move(this.instance, positions, options);
  }

  quality() {
    this.instance.call('quality');
    const [meanRadius, rebuiltRadius, gain] = this.instance.takeReals();
    return { meanRadius, rebuiltRadius, gain };
  }

  #scale(unit) {
    if (choose(UNITS, unit, 'unit') === 0) return 1;
    const length = this.meanEdgeLength;
    if (length > 0) return length;
    throw new MeshhoodError('InvalidOption', "unit: 'edge', but the mesh has no edges of positive length");
  }

  // Neighborhoods of one start.

  neighborhood(start, r, options = {}) {
    const given = withDefaults(options, LIST_OF_START);
    const { sort, distances } = given;
    if (sort !== null) choose(ORDERS, sort, 'sort');
    this.#find(start, r, given, distances || sort === 'distance');
    if (sort !== null) this.instance.call('sort_answer', ORDERS.indexOf(sort), false);
    const ids = this.instance.takeIds();
    return distances ? { ids, distances: this.instance.takeReals() } : ids;
  }

  viewNeighborhood(start, r, options = {}) {
    const count = this.#find(start, r, withDefaults(options, QUERY_OF_START), false);
    return this.instance.view(Uint32Array, this.instance.call('answer_ids'), count);
  }

  count(start, r, options = {}) {
    const given = withDefaults(options, QUERY_OF_START);
    const place = chooseMethodFrom(start, given);
    expectNumber(r, 'radius');
    return this.#search(start, given, () => this.instance.call('count', place, this.#scale(given.unit) * r) >>> 0);
  }

  /** The answer is then in the memory of the module. Returns the number of its ids. */
  #find(start, r, given, distances) {
    const place = chooseMethodFrom(start, given);
    expectNumber(r, 'radius');
    return this.#search(start, given, () => {
      this.#warnUnless(this.instance.call('neighborhood', place, this.#scale(given.unit) * r, distances));
      return this.instance.call('answer_ids_size') >>> 0;
    });
  }

  nested(start, radii, options = {}) {
    const given = withDefaults(options, SCALED_SEARCH);
    const scale = this.#scale(given.unit);
    const scaled = toReals(radii, 'radii').map((radius) => scale * radius);
    return this.#search(start, given, () => {
      this.#warnUnless(this.instance.with([scaled], (list) => this.instance.call('nested', list, scaled.length)));
      return { counts: this.instance.takeCounts(), ids: this.instance.takeIds() };
    });
  }

  contains(start, w, r, options = {}) {
    const given = withDefaults(options, SCALED_SEARCH);
    expectVertex(w, this.#vertexCount);
    expectNumber(r, 'radius');
    const radius = this.#scale(given.unit) * r;
    return this.#search(start, given, () => this.instance.call('contains', w, radius)) !== 0;
  }

  connectingRadius(start, w, options = {}) {
    const search = withDefaults(options, SEARCH);
    expectVertex(w, this.#vertexCount);
    return this.#search(start, search, () => this.instance.call('connecting_radius', w));
  }

  nearestConnected(start, k, options = {}) {
    const search = withDefaults(options, SEARCH);
    expectSize(k, 'k', Infinity);
    const most = Math.min(k, 2 ** 32 - 1); // a size of the module
    this.#search(start, search, () => this.instance.call('nearest_connected', most));
    return { ids: this.instance.takeIds(), radii: this.instance.takeReals() };
  }

  nearest(point, options = {}) {
    const masks = withDefaults(options, { walls: null });
    const xyz = expectPoint(point, 'point');
    const vertex = withMasks(this.instance, masks, () => this.instance.call('nearest', ...xyz) >>> 0);
    return { vertex, distance: this.instance.takeReals()[0] };
  }

  closestPoint(point, options = {}) {
    const { faces } = withDefaults(options, ON_FACES);
    const xyz = expectPoint(point, 'point');
    useFaces(this.instance, faces);
    this.instance.call('closest_point', ...xyz);
    return this.#takeSurfacePoint();
  }

  firstHit(origin, direction, options = {}) {
    const { faces } = withDefaults(options, ON_FACES);
    const ray = [...expectPoint(origin, 'origin'), ...expectPoint(direction, 'direction')];
    useFaces(this.instance, faces);
    this.instance.call('first_hit', ...ray);
    return this.#takeSurfacePointOrNull();
  }

  #takeSurfacePoint() {
    const numbers = this.instance.takeReals();
    return {
      face: this.instance.takeCounts()[0], vertices: this.instance.takeIds(), barycentric: numbers.slice(0, 3),
      point: numbers.slice(3, 6), distance: numbers[6],
    };
  }

  #takeSurfacePointOrNull() {
    const found = this.#takeSurfacePoint();
    return found.distance === Infinity ? null : found;
  }

  /** Once for each index: a pointer that leaves the mesh would cause many. */
  #warnUnless(isNear) {
    if (isNear || this.#hasWarned) return;
    this.#hasWarned = true;
    console.warn('meshhood: the start is farther than the radius from the vertices where the search starts, so the ' +
      'neighborhood is empty; nearest() returns the nearest vertex and its distance');
  }

  /** The coordinates of a point; or a vertex of the mesh, alone. */
  #readStart(start) {
    if (isVertex(start)) return [expectVertex(start, this.#vertexCount)];
    const place = expectPoint(start, 'start', 'a vertex or three numbers');
    this.instance.call('check_start', ...place);
    return place;
  }

  /** Calls `use` while the start and the masks are in the memory of the module, and returns its result. */
  #search(start, given, use) {
    const seeds = expectVertices(given.seeds, 'seeds');
    const place = this.#readStart(start);
    if (seeds !== null && isVertex(start)) {
      throw new MeshhoodError('InvalidOption', 'seeds: expected null, for the start is a vertex');
    }
    return withMasks(this.instance, given, () => this.instance.with([seeds], (seedList) => {
      if (isVertex(start)) this.instance.call('start_at_vertex', start);
      else this.instance.call('start_at_point', ...place, seedList, seeds?.length ?? 0);
      return use();
    }));
  }

  // Neighborhoods of many vertices.

  neighborhoods(r, options = {}) {
    const given = withDefaults(options, LISTS);
    const { sort, distances } = given;
    if (sort !== null) choose(ORDERS, sort, 'sort');
    const place = chooseMethod(given);
    const { ids, reals, counts } = this.#askRows(r, given, () => {
      this.instance.call('batch', place, false, distances || sort === 'distance', Math.max(0, ROW_SORTS.indexOf(sort)));
      if (sort === 'index') this.instance.call('sort_answer', ORDERS.indexOf(sort), true);
    });
    return distances ? { offsets: counts, ids, distances: reals } : { offsets: counts, ids };
  }

  counts(r, options = {}) {
    const given = withDefaults(options, COUNTS);
    const place = chooseMethod(given);
    return this.#askRows(r, given, () => this.instance.call('batch', place, true, false, 0)).counts;
  }

  /** The answer to what `use` calls for the rows. */
  #askRows(r, given, use) {
    withRows(this.instance, r, given, this.#scale(given.unit), use);
    return this.instance.takeAnswer();
  }

  kNearest(k, options = {}) {
    const given = withDefaults(options, NEAREST);
    expectSize(k, 'k');
    expectNumber(given.r, 'radius');
    const { ids, reals } = this.#askRows(given.r, given, () => this.instance.call('k_nearest', k));
    return { ids, distances: reals };
  }

  discs(area, options = {}) {
    const given = withDefaults(options, DISCS);
    expectNumber(area, 'area');
    const areas = this.#weights(given.weights, given.faces);
    if (areas === null) throw new TypeError(`weights: null, expected ${EXPECTED_WEIGHTS}`);
    expectNumber(given.r, 'radius');
    const { ids, reals, counts } = this.#askRows(given.r, given, () => this.instance.with([areas], (list) =>
      this.instance.call('discs', area, list, areas.length)));
    return { offsets: counts, ids, distances: reals };
  }

  nearestUnconnected(r, options = {}) {
    const given = withDefaults(options, ROWS);
    const { ids, reals } = this.#askRows(r, given, () => this.instance.call('nearest_unconnected'));
    return { vertex: ids, distance: reals };
  }

  // The surface in a ball.

  invariants(r, options = {}) {
    const { reals } = this.#askSurface('invariants', r, withDefaults(options, PATCHES));
    return { area: reals.slice(0, reals.length / 2), volume: reals.slice(reals.length / 2) };
  }

  gaps(r, options = {}) {
    const { ids, reals, counts } = this.#askSurface('gaps', r, withDefaults(options, PATCHES));
    return {
      face: counts, vertices: ids, barycentric: columns(reals, 0, 3), point: columns(reals, 3, 6),
      distance: columns(reals, 6, 7),
    };
  }

  #askSurface(name, r, given) {
    const points = readPoints(given);
    useFaces(this.instance, given.faces);
    return this.#askRows(r, given, () => this.#callOnPoints(name, points));
  }

  /** Calls the function of this name for points of faces, or with null for vertices. */
  #callOnPoints(name, { coordinates, face }, ...more) {
    return this.instance.with([face, coordinates], (faces, list) =>
      this.instance.call(name, faces, face?.length ?? 0, list, ...more));
  }

  patch(start, r, options = {}) {
    this.#callOnPatch('patch', start, r, withDefaults(options, PATCH));
    return this.instance.takeCounts();
  }

  clip(start, r, options = {}) {
    const given = withDefaults(options, CLIP);
    expectNumber(given.tolerance, 'tolerance');
    this.#callOnPatch('clip', start, r, given, given.tolerance);
    const { ids, reals, counts } = this.instance.takeAnswer();
    const values = (reals.length - 1) / 2; // of the points, and of their weights
    return {
      positions: reals.slice(0, values), corners: ids.slice(values), faces: counts, vertices: ids.slice(0, values),
      weights: reals.slice(values, 2 * values), area: reals[2 * values],
    };
  }

  measure(start, r, options = {}) {
    this.#callOnPatch('measure', start, r, withDefaults(options, PATCH));
    const [area, volume] = this.instance.takeReals();
    return { area, volume };
  }

  gap(start, r, options = {}) {
    this.#callOnPatch('gap', start, r, withDefaults(options, PATCH));
    return this.#takeSurfacePointOrNull();
  }

  #callOnPatch(name, start, r, given, ...values) {
    const { face, faces, walls, unit } = given;
    expectNumber(r, 'radius');
    const place = this.#readStart(start);
    if (!isVertex(start)) expectSize(face, 'face');
    else if (face !== null) throw new MeshhoodError('InvalidOption', 'face: expected a point as start');
    useFaces(this.instance, faces);
    const radius = this.#scale(unit) * r;
    withMasks(this.instance, { walls }, () => {
      if (isVertex(start)) this.instance.call('patch_at_vertex', start);
      else this.instance.call('patch_at_point', face, ...place);
      this.instance.call(name, radius, ...values);
    });
  }

  // Regions as meshes.

  submesh(ids, options = {}) {
    const { corners, faces } = withDefaults(options, SUBMESH);
    const count = this.#callOnRegion('submesh', ids, faces, choose(CORNERS, corners, 'corners')) >>> 0;
    const { ids: vertices, counts } = this.instance.takeAnswer();
    const offsets = counts.slice(count, 2 * count + 1);
    return {
      positions: this.#positionsOf(vertices),
      corners: counts.slice(2 * count + 1),
      offsets: this.#haveOffsets(faces) ? offsets : null,
      vertices,
      faces: counts.slice(0, count),
    };
  }

  /** Of the whole mesh, or the form would depend on the region. */
  #haveOffsets(faces) {
    if (faces !== null) return (faces.offsets ?? null) !== null;
    return this.#holdsOffsets ??= this.faces.offsets !== null;
  }

  rim(ids, start, r, options = {}) {
    const { faces } = withDefaults(options, ON_FACES);
    expectNumber(r, 'radius');
    const place = this.#readStart(start);
    this.#callOnRegion('rim', ids, faces, ...(isVertex(start) ? this.#positionsOf(place) : place), r);
    const { ids: edges, reals: points, counts } = this.instance.takeAnswer();
    const lines = (counts.length - 1) / 2; // their offsets, and whether each is closed
    return Array.from({ length: lines }, (_, line) => {
      const [begin, end] = [counts[line], counts[line + 1]];
      return {
        points: points.slice(3 * begin, 3 * end),
        edges: edges.slice(2 * begin, 2 * end),
        isClosed: counts[lines + 1 + line] === 1,
      };
    });
  }

  #callOnRegion(name, ids, faces, ...values) {
    const region = expectType(ids, [Uint32Array], 'ids');
    useFaces(this.instance, faces);
    return this.instance.with([region], (list) => this.instance.call(name, list, region.length, ...values));
  }

  // Values and shape.

  aggregate(values, r, options = {}) {
    const given = withDefaults(options, AGGREGATION);
    const { reduce, weights, kernel, nan, nesting, ddof, q, faces } = given;
    const signal = toReals(values, 'values');
    const channels = this.vertexCount === 0 ? 1 : Math.max(1, Math.floor(signal.length / this.vertexCount));
    const reductions = chooseSome(REDUCTIONS, reduce, 'reduce');
    const choices = [
      choose(KERNELS, kernel, 'kernel'), choose(MISSING, nan, 'nan'), choose(NESTINGS, nesting, 'nesting'),
    ];
    expectSize(ddof, 'ddof', 1);
    expectNumber(q, 'q');
    const weighed = this.#weights(weights, faces);
    return this.#askRows(r, given, () =>
      this.instance.with([signal, weighed, reductions], (numbers, weightList, list) => this.instance.call('aggregate',
        numbers, signal.length, channels, weightList, weighed?.length ?? 0, list, reductions.length, ...choices, ddof,
        q))).reals;
  }

  smooth(values, fwhm, options = {}) {
    const chosen = withDefaults(options, SMOOTHING);
    expectNumber(fwhm, 'fwhm');
    const radius = this.instance.call('smoothing_radius', fwhm);
    return this.aggregate(values, radius, { ...chosen, reduce: 'mean', kernel: 'gaussian' });
  }

  #weights(weights, faces) {
    if (weights === null) return null;
    if (typeof weights !== 'string') {
      return expectForVertices(toReals(weights, 'weights', EXPECTED_WEIGHTS), 'weights', this.#vertexCount);
    }
    choose(['area'], weights, 'weights');
    withFaces(this.instance, faces, () => this.instance.call('areas'));
    return this.instance.takeReals();
  }

  curvature(r, options = {}) {
    const given = withDefaults(options, CURVATURE);
    const { faces, normals, like, fit, filter } = given;
    if (like !== null) choose(['libigl'], like, 'like');
    const place = choose(FITS, fit, 'fit');
    this.#useNormals(given);
    const { reals, counts } = this.#askRows(r, given, () =>
      this.instance.call('curvature', place, filter, like !== null));
    const parts = [[0, 1], [1, 2], [2, 5], [5, 8]].map((ends) => ends.map((end) => end * counts.length));
    return new Curvature(...parts.map((ends) => reals.slice(...ends)), Uint8Array.from(counts));
  }

  features(r, options = {}) {
    const given = withDefaults(options, FEATURES);
    const { faces, kinds, filter } = given;
    const places = chooseSome(KINDS, kinds, 'kinds');
    useFaces(this.instance, faces);
    return this.#askRows(r, given, () => this.instance.with([places], (list) =>
      this.instance.call('features', list, places.length, filter))).reals;
  }

  thickness(options = {}) {
    const given = withDefaults(options, THICKNESS);
    const place = choose(THICKNESSES, given.method, 'method');
    const points = readPoints(given);
    useFaces(this.instance, given.faces);
    this.instance.with([points.vertices], (ids) =>
      this.#callOnPoints('thickness', points, ids, points.vertices?.length ?? 0, place));
    return this.instance.takeAnswer().reals;
  }

  #useNormals({ faces, normals, metric }) {
    if (normals === null) return useFaces(this.instance, faces);
    if (faces !== null || metric === 'surface') {
      throw new MeshhoodError('InvalidOption', "normals: expected null with faces, or with metric 'surface'");
    }
    const vectors = toReals(normals, 'normals');
    this.instance.with([vectors], (list) => this.instance.call('use_normals', list, vectors.length));
  }
}
