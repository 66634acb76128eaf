// SPDX-License-Identifier: MIT
// Welding in the package for JavaScript.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { roll } from './meshes.mjs';
import { library } from './setup.mjs';

const { MeshIndex, MeshhoodError, initialize, weld } = library;
await initialize();

/** A mesh of triangles with vertices of their own. */
function soup({ positions, corners }) {
  const apart = new positions.constructor(3 * corners.length);
  corners.forEach((v, i) => apart.set(positions.subarray(3 * v, 3 * v + 3), 3 * i));
  return { positions: apart, corners: corners.map((_, i) => i) };
}

for (const Reals of [Float32Array, Float64Array]) {
  test(`triangles with vertices of their own become connected (${Reals.name})`, () => {
    const mesh = roll(20, 8, Reals);
    const apart = soup(mesh);
    assert.equal(new MeshIndex(apart.positions, apart.corners).count(0, Infinity), 3);
    const { positions, corners, offsets, ids } = weld(apart.positions, apart.corners);
    assert.ok(positions instanceof Reals);
    assert.equal(positions.length, mesh.positions.length);
    assert.equal(offsets, null);
    assert.deepEqual(corners, Uint32Array.from(apart.corners, (v) => ids[v]));
    assert.equal(new MeshIndex(positions, corners).count(0, Infinity), mesh.positions.length / 3);
    const place = (xyz, v) => xyz.slice(3 * v, 3 * v + 3);
    ids.forEach((id, v) => assert.deepEqual(place(positions, id), place(apart.positions, v)));
  });
}

test('polygons keep their offsets', () => {
  const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0);
  const offsets = Uint16Array.of(0, 2, 6);
  const welded = weld(positions, Uint16Array.of(0, 2, 0, 1, 2, 3), { offsets });
  assert.deepEqual(welded.offsets, Uint32Array.of(0, 2, 6));
  assert.deepEqual(welded.corners, Uint32Array.of(0, 1, 0, 1, 1, 2));
  assert.deepEqual(welded.ids, Uint32Array.of(0, 1, 1, 2));
  assert.deepEqual(weld(positions, Uint16Array.of(0, 2, 0, 1, 2, 3), { offsets, eps: 1 }).ids, new Uint32Array(4));
});

test('positions of a subclass give positions of its type', () => {
  class Points extends Float32Array {
    constructor(count) {
      super(typeof count === 'number' ? 3 * count : count);
    }
  }
  const positions = new Points(3);
  positions.set([1, 0, 0, 0, 1, 0], 3);
  const welded = weld(positions, Uint32Array.of(0, 1, 2));
  assert.deepEqual(welded.positions, Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0));
});

test('wrong arguments are refused', () => {
  const positions = Float64Array.of(0, 0, 0);
  for (const eps of [-1, NaN, Infinity]) {
    assert.throws(() => weld(positions, new Uint32Array(), { eps }),
      (error) => error instanceof MeshhoodError && error.code === 'InvalidOption' && /eps/.test(error.message));
  }
  assert.throws(() => weld(positions, Uint32Array.of(0, 1, 2)),
    (error) => error instanceof MeshhoodError && error.code === 'InvalidMesh' && /face 0/.test(error.message));
  assert.throws(() => weld(positions, new Uint32Array(), { epsilon: 1 }), /did you mean 'eps'|expected one of/);
  for (const corners of [new Uint32Array(), Uint32Array.of(0, 0, 0)]) {
    assert.throws(() => weld(positions, corners, { offsets: new Uint32Array() }),
      { code: 'InvalidMesh', message: 'offsets: no values, expected one for each face and one more' });
  }
  assert.throws(() => weld([0, 0, 0], new Uint32Array()), TypeError);
  assert.throws(() => weld(positions, new Uint32Array(), { eps: '1' }), TypeError);
});
