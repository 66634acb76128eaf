// SPDX-License-Identifier: MIT
// Aggregates and curvature in the package for JavaScript: the values of the command line, bit by bit.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { grid, polygons, random, roll, toPly } from './meshes.mjs';
import { build, library, meshhood, readArrays, write } from './setup.mjs';

const { initialize } = library;
await initialize();

/** Hills with a fold, and normals that point up. */
const hills = grid(40, 35, (row, column) =>
  [row, column, 2 * Math.sin(0.4 * row) + Math.cos(0.3 * row + 0.5 * column)], Float64Array);
const rolled = roll(60, 14);
const mixed = polygons(200, 300);
const meshes = { hills, rolled, mixed };
for (const [name, mesh] of Object.entries(meshes)) write(`${name}.ply`, toPly(mesh));

const next = random(21);
const values = (mesh, channels = 1) =>
  Float64Array.from({ length: (channels * mesh.positions.length) / 3 }, () => 10 * next() - 3);
const toText = (numbers) => `${Array.from(numbers).join('\n')}\n`;

for (const [name, mesh] of Object.entries(meshes)) {
  test(`curvatures of ${name} are those of the command line`, () => {
    const index = build(mesh);
    const choices = [[{}, []], [{ like: 'libigl' }, ['--like-libigl']], [{ filter: false }, ['--no-filter']]];
    for (const [options, flags] of choices) {
      meshhood('curvature', `${name}.ply`, '-r', '3.5', '-o', 'k.npz', ...flags);
      const expected = readArrays('k.npz');
      const found = index.curvature(3.5, { faces: mesh, ...options });
      for (const part of ['k1', 'k2', 'd1', 'd2']) assert.deepEqual(found[part], expected[part], `${part} ${flags}`);
      assert.deepEqual([...found.state], [...expected.state]);
      assert.ok(found.state.includes(0));
    }
  });

  test(`aggregates of ${name} are those of the command line`, () => {
    const index = build(mesh);
    const signal = values(mesh);
    write('values.txt', toText(signal));
    const aggregate = (...options) => {
      meshhood('aggregate', `${name}.ply`, '--values', 'values.txt', '-o', 'a.npz', ...options);
      return readArrays('a.npz').values;
    };
    const all = ['sum', 'mean', 'min', 'max', 'var', 'std', 'count', 'median', 'quantile'];
    const together = index.aggregate(signal, 3, { reduce: all, q: 0.9 });
    assert.deepEqual(together, aggregate('-r', '3', '--reduce', all.join(','), '--quantile', '0.9'));
    for (const [place, reduce] of all.slice(0, -1).entries()) {
      const each = index.aggregate(signal, 3, { reduce });
      assert.deepEqual(each, together.filter((_, i) => i % all.length === place), reduce);
    }
    for (const kernel of ['epanechnikov', 'biweight', 'gaussian']) {
      const expected = aggregate('-r', '2,4', '--kernel', kernel, '--nesting', 'patch', '--weights', 'area');
      const options = { kernel, nesting: 'patch', weights: 'area', faces: mesh };
      assert.deepEqual(index.aggregate(signal, null, { scales: Float64Array.of(2, 4), ...options }), expected, kernel);
    }
  });
}

test('several channels are each by itself', () => {
  const index = build(hills);
  const signal = values(hills, 2);
  const vertices = Uint32Array.of(700, 3);
  const found = index.aggregate(signal, 3, { vertices });
  for (const channel of [0, 1]) {
    const alone = index.aggregate(signal.filter((_, i) => i % 2 === channel), 3, { vertices });
    assert.deepEqual(found.filter((_, i) => i % 2 === channel), alone);
  }
});

test('missing values are left out or spread', () => {
  const index = build(hills);
  const signal = values(hills);
  signal[700] = NaN;
  const vertices = Uint32Array.of(700);
  assert.ok(Number.isNaN(index.aggregate(signal, 2, { vertices })[0]));
  const count = index.count(700, 2);
  assert.deepEqual(index.aggregate(signal, 2, { vertices, nan: 'omit', reduce: 'count' }), Float64Array.of(count - 1));
});

test('smoothing is the mean by a Gaussian', () => {
  const index = build(hills);
  const signal = values(hills);
  const smooth = index.smooth(signal, 4);
  assert.equal(smooth.length, signal.length);
  assert.deepEqual(smooth, index.aggregate(signal, 4 * 1.5784315224822145, { kernel: 'gaussian' }));
  assert.deepEqual(index.smooth(Float32Array.from(signal, () => 2), 4), new Float64Array(signal.length).fill(2));
  assert.throws(() => index.smooth(signal, NaN), { code: 'InvalidRadius' });
  for (const [call, message] of [
    [() => index.smooth(signal, signal), 'fwhm Float64Array, expected a number'],
    [() => index.smooth(signal, 5n), 'fwhm 5n, expected a number'],
    [() => index.count(signal, 1, { unit: 'mesh' }), `start: ${signal.length} values, expected a vertex or three numbers`],
    [() => index.contains(1, [...signal], 1), 'vertex Array, expected a whole number'],
    [() => index.smooth(signal, 4, { unit: signal }), "unit: Float64Array, expected one of 'mesh', 'edge'"],
  ]) {
    assert.throws(call, { message });
  }
});

test('a sphere has the curvature of its radius', () => {
  const ball = grid(30, 60, (row, column) => {
    const [theta, phi] = [(Math.PI * (row + 0.5)) / 30, (2 * Math.PI * column) / 59];
    return [5 * Math.sin(theta) * Math.cos(phi), 5 * Math.sin(theta) * Math.sin(phi), 5 * Math.cos(theta)];
  }, Float64Array);
  const curvature = build(ball).curvature(1.5, { normals: ball.positions, vertices: Uint32Array.of(15 * 60 + 30) });
  const near = (array, expected) => assert.ok(Math.abs(array[0] - expected) < 0.02, `${array} ${expected}`);
  near(curvature.k1, 0.2);
  near(curvature.mean, 0.2);
  near(curvature.gaussian, 0.04);
  near(curvature.curvedness, 0.2);
  assert.ok(curvature.shapeIndex[0] > 0.9);
});

test('quantities of principal curvatures follow their definitions', () => {
  const { Curvature } = library;
  const none = new Float64Array();
  const [k1, k2] = [Float64Array.of(2, 1, 0, 1), Float64Array.of(2, -1, 0, 0)];
  const curvature = new Curvature(k1, k2, none, none, new Uint8Array(4));
  assert.deepEqual(curvature.mean, Float64Array.of(2, 0, 0, 0.5));
  assert.deepEqual(curvature.gaussian, Float64Array.of(4, -1, 0, 0));
  assert.deepEqual(curvature.shapeIndex, Float64Array.of(1, 0, NaN, 0.5));
  curvature.curvedness.forEach((value, i) => assert.ok(Math.abs(value - [2, 1, 0, Math.SQRT1_2][i]) < 1e-15));
});

test('normals of other faces replace those that are kept, and faces may change in place', () => {
  const index = build(hills);
  const flipped = { corners: hills.corners.slice() };
  const first = index.curvature(3, { faces: flipped }).mean;
  for (let i = 0; i < flipped.corners.length; i += 3) flipped.corners.subarray(i, i + 2).reverse();
  const second = index.curvature(3, { faces: flipped }).mean;
  assert.ok(Math.abs(first[700]) > 0.01);
  second.forEach((value, v) => assert.ok(Math.abs(value + first[v]) < 1e-12));
});

test('wrong arguments give the errors of C++ and leave the index usable', () => {
  const index = build(hills);
  const signal = values(hills);
  const refuse = (call, expected) => assert.throws(call, expected);
  refuse(() => index.curvature(3), { code: 'InvalidOption', message: /^faces: expected the faces/ });
  refuse(() => index.curvature(3, { faces: hills, normals: hills.positions }), { code: 'InvalidOption' });
  const other = { corners: Uint32Array.of(0, 1, 9999) };
  refuse(() => index.curvature(3, { faces: other }), { code: 'InvalidMesh', message: /9999/ });
  refuse(() => index.curvature(3, { normals: new Float64Array(6) }), { code: 'InvalidMesh' });
  refuse(() => index.curvature(-3, { faces: hills }), { code: 'InvalidRadius' });
  refuse(() => index.curvature(3, { faces: hills, fit: 'cubic' }), { code: 'InvalidOption', message: /'jet'/ });
  refuse(() => index.curvature(3, { faces: hills, vertices: [1] }), TypeError);
  const vertices = Uint32Array.of(1, 9999);
  refuse(() => index.curvature(3, { faces: hills, vertices }), { code: 'VertexOutOfRange', message: /row 1/ });
  refuse(() => index.aggregate(signal, 3, { reduce: 'medium' }), { code: 'InvalidOption', message: /^reduce/ });
  refuse(() => index.aggregate(signal, 3, { reduce: [] }), { code: 'InvalidOption', message: /no reductions/ });
  refuse(() => index.aggregate(signal, 3, { q: 2 }), { code: 'InvalidOption', message: /quantile is 2/ });
  refuse(() => index.aggregate(signal, 3, { reduce: 'max', kernel: 'biweight' }), { message: /kernel is for sum/ });
  refuse(() => index.aggregate(signal, 3, { weights: 'area' }), { code: 'InvalidOption', message: /faces/ });
  refuse(() => index.aggregate(signal, 3, { weights: signal }), { code: 'InvalidOption', message: /weights: vertex 0 has -/ });
  refuse(() => index.aggregate(signal, null, { scales: new Float64Array() }), { code: 'InvalidOption', message: /no radii/ });
  refuse(() => index.aggregate([1, 2], 3), TypeError);
  refuse(() => index.aggregate(new BigInt64Array(1400), 3), TypeError);
  assert.equal(index.aggregate(signal, 0)[5], signal[5]);
});
