// SPDX-License-Identifier: MIT
// A misspelt option of the package for JavaScript is an error. Without one it would change nothing, and the answer would
// be that of another question.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { plates, toPly } from './meshes.mjs';
import { build, library } from './setup.mjs';

const { MeshIndex, initialize, readMesh } = library;
await initialize();

const mesh = plates(6);
const index = build(mesh);
const heights = mesh.positions.filter((_, i) => i % 3 === 2);

/** Every call that takes options, with one that it knows. */
const CALLS = {
  readMesh: [(options) => readMesh(toPly(mesh), 'mesh.ply', options), 'precision'],
  MeshIndex: [(options) => new MeshIndex(mesh.positions, mesh.corners, options), 'offsets'],
  load: [(options) => MeshIndex.load(index.save(), options), 'progress'],
  refit: [(options) => index.refit(mesh.positions, options), 'changed'],
  refitInPlace: [(options) => index.refitInPlace(mesh.positions, options), 'changed'],
  neighborhood: [(options) => index.neighborhood(5, 3, options), 'unit'],
  neighborhoods: [(options) => index.neighborhoods(3, options), 'distances'],
  nearestUnconnected: [(options) => index.nearestUnconnected(3, options), 'walls'],
  nearest: [(options) => index.nearest([0, 0, 0], options), 'walls'],
  kNearest: [(options) => index.kNearest(3, options), 'metric'],
  discs: [(options) => index.discs(3, { faces: mesh, ...options }), 'weights'],
  closestPoint: [(options) => index.closestPoint([0, 0, 0], { ...options, faces: mesh }), 'faces'],
  firstHit: [(options) => index.firstHit([0, 0, 9], [0, 0, -1], { ...options, faces: mesh }), 'faces'],
  thickness: [(options) => index.thickness({ faces: mesh, ...options }), 'method'],
  invariants: [(options) => index.invariants(2, { faces: mesh, ...options }), 'scales'],
  gaps: [(options) => index.gaps(2, { faces: mesh, ...options }), 'walls'],
  patch: [(options) => index.patch(5, 2, { faces: mesh, ...options }), 'unit'],
  measure: [(options) => index.measure(5, 2, { faces: mesh, ...options }), 'walls'],
  gap: [(options) => index.gap(5, 2, { faces: mesh, ...options }), 'unit'],
  viewNeighborhood: [(options) => index.viewNeighborhood(5, 3, options), 'metric'],
  count: [(options) => index.count(5, 3, options), 'method'],
  counts: [(options) => index.counts(3, options), 'vertices'],
  nested: [(options) => index.nested(5, Float64Array.of(1, 2), options), 'walls'],
  contains: [(options) => index.contains(5, 6, 2, options), 'seeds'],
  connectingRadius: [(options) => index.connectingRadius(5, 6, options), 'ignored'],
  nearestConnected: [(options) => index.nearestConnected(5, 6, options), 'walls'],
  aggregate: [(options) => index.aggregate(heights, 2, options), 'reduce'],
  smooth: [(options) => index.smooth(heights, 2, options), 'weights'],
  curvature: [(options) => index.curvature(2, { faces: mesh, ...options }), 'filter'],
  features: [(options) => index.features(2, { faces: mesh, ...options }), 'kinds'],
  submesh: [(options) => index.submesh(Uint32Array.of(1), { faces: mesh, ...options }), 'corners'],
  rim: [(options) => index.rim(Uint32Array.of(1), 1, 1, { ...options, faces: mesh }), 'faces'],
};

for (const [name, [call, known]] of Object.entries(CALLS)) {
  test(`${name} refuses an unknown option, and names the one that was meant`, () => {
    call({ [known]: undefined });
    assert.throws(() => call({ [`${known}s`]: undefined }), {
      name: 'TypeError', message: `unknown option '${known}s', did you mean '${known}'?`,
    });
    assert.throws(() => call({ zzzzzzzz: 1 }), { name: 'TypeError', message: /^unknown option 'zzzzzzzz', expected one of [a-z]/ });
    assert.throws(() => call({ toString: 1 }), { name: 'TypeError', message: /^unknown option 'toString'/ });
  });
}

test('options in other letters are named, too', () => {
  assert.throws(() => index.neighborhood(5, 3, { Sort: true }), { message: "unknown option 'Sort', did you mean 'sort'?" });
  assert.throws(() => index.count(5, 3, { sort: true }), { message: "unknown option 'sort', expected one of method, metric, faces, unit, seeds, walls, ignored" });
});

const TRUTH = 'true or false';
const NAMES = 'a name or an array of names';

/** Options of one type: the call, the option, and how a message calls what is expected. */
const TYPED = [
  [CALLS.neighborhood, 'distances', TRUTH], [CALLS.neighborhoods, 'distances', TRUTH], [CALLS.curvature, 'filter', TRUTH],
  [CALLS.features, 'filter', TRUTH], [CALLS.readMesh, 'strict', TRUTH], [CALLS.readMesh, 'progress', 'a function'],
  [CALLS.MeshIndex, 'progress', 'a function'], [CALLS.load, 'progress', 'a function'], [CALLS.aggregate, 'reduce', NAMES],
  [CALLS.features, 'kinds', NAMES],
];

test('options of another type are refused by name, and leave the index usable', () => {
  const values = [[1, '1'], [2, '2'], [1n, '1n'], [{}, 'Object'], [new Set(), 'Set'], [Object.create(null), 'object']];
  const truths = [['yes', "'yes'"], ['true', "'true'"], ['0', "'0'"], [[], 'Array']];
  for (const [[call], name, expected] of TYPED) {
    const others = expected === NAMES ? values : [...values, ...truths];
    for (const [value, found] of expected === 'a function' ? others : [...others, [null, 'null']]) {
      assert.throws(() => call({ [name]: value }), { name: 'TypeError', message: `${name}: ${found}, expected ${expected}` });
    }
  }
  for (const call of [CALLS.readMesh, CALLS.MeshIndex, CALLS.load]) call[0]({ progress: null });
  for (const distances of [true, false]) assert.equal(index.neighborhood(5, 3, { distances }).ids !== undefined, distances);
  assert.throws(() => index.instance.call('nearest_connected', 1n), TypeError); // before the module is entered
  assert.ok(index.count(5, 3) > 0);
});

test('an error names the argument that it is about', () => {
  const point = ': coordinate 0 is nan, expected a finite number of magnitude up to 2^500';
  const ids = Uint32Array.of(1);
  const start = [NaN, 0, 0];
  const expected = 'expected an object with corners';
  const cutting = (...cut) => () => build(mesh, { cut: Uint32Array.from(cut) });
  for (const [call, message] of [
    [() => index.curvature(2, { faces: mesh.corners }), `faces: Uint32Array, ${expected}`],
    [() => index.submesh(ids, { faces: {} }), `faces: Object, ${expected}`],
    [() => index.thickness({ faces: 'all' }), `faces: 'all', ${expected}`],
    [() => index.gaps(2, { faces: { corners: [0, 1, 2] } }), 'corners: Array, expected Uint32Array or Int32Array or Uint16Array'],
    [() => new MeshIndex(mesh.positions), 'corners: undefined, expected Uint32Array or Int32Array or Uint16Array'],
    [cutting(0, 1, 2), 'cut: edges: 3 ends, expected two for each edge'],
    [cutting(0, 71), 'cut: edge 0: vertices 0 and 71 are not joined by an edge'],
    [cutting(0, 1, 0, 99), 'cut: edge 1: vertex 99, but the mesh has 72 vertices'],
    [() => index.rim(ids, start, 1, { faces: mesh }), `start${point}`],
    [() => index.patch(start, 1, { faces: mesh, face: 0 }), `start${point}`],
    [() => index.count(start, 1), `start${point}`],
    [() => index.neighborhood(start, 1, { seeds: ids }), `start${point}`],
    [() => index.nearest(start), `point${point}`],
  ]) {
    assert.throws(call, { message });
  }
});

test('options that are no object are refused', () => {
  for (const options of ['edge', null, 3, true]) {
    assert.throws(() => index.neighborhood(5, 3, options), { name: 'TypeError', message: `options: ${options}, expected an object` });
  }
});
