// SPDX-License-Identifier: MIT
// Files and arguments made to mislead the package. Its sizes have 32 bits, where those of the command line have 64: a
// count that is small modulo 2^32 is the one that a size of 32 bits would let through.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { runInNewContext } from 'node:vm';

import { plates } from './meshes.mjs';
import { build, library, wordsOfCommandLine } from './setup.mjs';

const { MeshIndex, MeshhoodError, initialize, readMesh } = library;
await initialize();

const TURN = 2 ** 32;
const lines = (...all) => Buffer.from(`${all.join('\n')}\n`, 'latin1');
const floats = (...values) => Buffer.from(Float32Array.from(values).buffer);
const words = (...values) => Buffer.from(Uint32Array.from(values).buffer);

const XYZ = ['property float x', 'property float y', 'property float z'];
const LIST = 'property list uint uint vertex_indices';
const BINARY = ['ply', 'format binary_little_endian 1.0'];
const TEXT = ['ply', 'format ascii 1.0'];
const THREE = floats(0, 0, 0, 1, 0, 0, 0, 1, 0);
const ROWS = ['0 0 0', '1 0 0', '0 1 0'];

function binaryStl(count, facets) {
  const bytes = Buffer.alloc(84 + 50 * facets);
  bytes.writeUInt32LE(count, 80);
  return bytes;
}

const WRAPPING = Math.ceil(TURN / 50); // so many facets take 4 bytes modulo 2^32

const refused = {
  'vertices.ply': Buffer.concat([lines(...BINARY, `element vertex ${TURN + 3}`, ...XYZ, 'end_header'), THREE]),
  'text_vertices.ply': lines(...TEXT, `element vertex ${TURN + 3}`, ...XYZ, 'end_header', ...ROWS),
  'most_vertices.ply': lines(...TEXT, 'element vertex 18446744073709551615', ...XYZ, 'end_header', ...ROWS),
  'faces.ply': Buffer.concat([
    lines(...BINARY, 'element vertex 3', ...XYZ, `element face ${TURN + 1}`, LIST, 'end_header'), THREE, words(3, 0, 1, 2)]),
  'list.ply': Buffer.concat([
    lines(...BINARY, 'element vertex 3', ...XYZ, 'element face 1', LIST, 'end_header'), THREE, words(TURN - 1, 0, 1, 2)]),
  'list_of_doubles.ply': Buffer.concat([
    lines(...BINARY, 'element vertex 3', ...XYZ, 'element other 1', 'property list uint double a', 'end_header'),
    THREE, words(TURN / 8 + 1, 0, 0)]),
  'other.ply': Buffer.concat([
    lines(...BINARY, `element other ${TURN + 1}`, 'property uchar a', 'element vertex 3', ...XYZ, 'end_header'),
    Buffer.of(0), THREE]),
  'corner.ply': lines(...TEXT, 'element vertex 3', ...XYZ, 'element face 1', LIST, 'end_header', ...ROWS, `3 0 1 ${TURN + 2}`),
  'vertices.off': lines('OFF', `${TURN + 3} 1 0`, ...ROWS, '3 0 1 2'),
  'faces.off': lines('OFF', `3 ${TURN + 1} 0`, ...ROWS, '3 0 1 2'),
  'sides.off': lines('OFF', '3 1 0', ...ROWS, `${TURN + 3} 0 1 2`),
  'corner.off': lines('OFF', '3 1 0', ...ROWS, `3 0 1 ${TURN + 2}`),
  'corner.obj': lines('v 0 0 0', 'v 1 0 0', 'v 0 1 0', `f 1 2 ${TURN + 3}`),
  'back.obj': lines('v 0 0 0', 'v 1 0 0', 'v 0 1 0', `f 1 2 -${TURN + 1}`),
  'facets.stl': binaryStl(WRAPPING, 0),
  'one_facet.stl': binaryStl(WRAPPING + 1, 1),
  'huge.ply': lines(...TEXT, 'element vertex 1', ...XYZ.map((x) => x.replace('float', 'double')), 'end_header', '1e151 0 0'),
  'escape.ply': lines(...TEXT, 'element \x1b[2J\x07 \x00'),
  '<img src=x onerror=alert(1)>.obj': lines('v 0'),
  'control \x01\x1b[2J\x7f\x85\n.obj': lines('v 0'),
  '"\'&`.off': lines('OFF', 'x'),
};

for (const [name, content] of Object.entries(refused)) {
  test(`${JSON.stringify(name)} is refused in the words of the command line`, () => {
    // Without exceptions, the reader of STL cannot add to its error why the file is not a binary one.
    const message = wordsOfCommandLine(name, content).replace(/; and it is not a binary STL.*/, '');
    assert.throws(() => readMesh(content, name), { name: 'MeshhoodError', message });
  });
}

test('a count of elements without properties costs nothing', () => {
  const file = Buffer.concat([
    lines(...BINARY, 'element other 18446744073709551615', 'element vertex 3', ...XYZ, 'end_header'), THREE]);
  assert.equal(readMesh(file, 'other.ply').positions.length, 9);
});

test('comments may say anything', () => {
  for (const comment of ['end_header', 'this is not the end_header', 'element vertex 9', '<script>', `\x1b${'x'.repeat(60_000)}`]) {
    const file = lines(...TEXT, `comment ${comment}`, 'element vertex 3', ...XYZ, 'end_header', ...ROWS);
    assert.deepEqual([...readMesh(file, 'comment.ply').positions], [0, 0, 0, 1, 0, 0, 0, 1, 0]);
  }
});

test('a long name is part of the message, and of no more than one', () => {
  const name = `${'n'.repeat(1_000_000)}.obj`;
  assert.throws(() => readMesh(lines('v 0'), name), { message: `${name}:1:4: vertex 1 has no y, expected x y z` });
});

test('an array of more bytes than the module can address is refused as too large', () => {
  for (const size of [TURN, TURN - 1, TURN - 63, TURN - 64, TURN - 65]) {
    const bytes = new Uint8Array(size); // pages of zeros, which take no memory
    assert.throws(() => readMesh(bytes, 'large.stl'), { name: 'MeshhoodError', code: 'TooLarge' }, `${size}`);
    assert.throws(() => MeshIndex.load(bytes), { name: 'MeshhoodError', code: 'TooLarge' }, `${size}`);
  }
});

test('arrays are what they are, and not what they say', () => {
  const mesh = plates(6);
  const index = build(mesh);
  const vertices = Uint32Array.of(0, 30, 5);
  const right = index.counts(2, { vertices });
  class Longer extends Uint32Array {
    get length() {
      return 1000;
    }
  }
  class Renamed extends Uint32Array {
    get [Symbol.toStringTag]() {
      return 'Float64Array';
    }
  }
  for (const Type of [Longer, Renamed]) assert.deepEqual(index.counts(2, { vertices: Type.from(vertices) }), right);
  class Elsewhere extends Uint8Array {
    get byteOffset() {
      return 1;
    }
  }
  assert.deepEqual(MeshIndex.load(Elsewhere.from(index.save())).save(), index.save());
  class Going extends Float64Array {
    * [Symbol.iterator]() { // an address, too, and a size
      yield* [9, 9, 9, 64, 5];
    }
  }
  assert.deepEqual(index.neighborhood(Going.of(1, 2, 0), 2), index.neighborhood([1, 2, 0], 2));
  assert.deepEqual(index.nearest(Going.of(1, 2, 0)), index.nearest([1, 2, 0]));
  const imitations = [
    new Proxy(vertices, {}), new Proxy(vertices, { get: (array, name) => array[name] }), Object.create(vertices)];
  for (const imitation of imitations) {
    const refused = (name, expected) => ({ name: 'TypeError', message: `${name}: Proxy, expected ${expected}` });
    assert.throws(() => index.counts(2, { vertices: imitation }), refused('vertices', 'Uint32Array'));
    assert.throws(() => index.counts(imitation), refused('r', 'a number or a typed array of numbers'));
    assert.throws(() => readMesh(imitation, 'a.ply'), refused('bytes', 'an ArrayBuffer or a typed array'));
  }
});

test('arrays of another realm, as of an iframe, are arrays', () => {
  const mesh = plates(6);
  const there = (array) => runInNewContext(`${array.constructor.name}.from(numbers)`, { numbers: [...array] });
  const positions = there(mesh.positions);
  assert.ok(!(positions instanceof Float64Array));
  const index = new MeshIndex(positions, there(mesh.corners));
  assert.deepEqual(index.save(), build(mesh).save());
  assert.deepEqual(MeshIndex.load(there(index.save()).buffer).save(), index.save());
  const point = Float64Array.of(1, 2, 0);
  assert.deepEqual(index.neighborhood(there(point), 2), index.neighborhood(point, 2));
  const [vertices, walls] = [Uint32Array.of(1, 8), new Uint8Array(72).fill(1, 40)];
  assert.deepEqual(index.counts(2, { vertices: there(vertices), walls: there(walls) }), index.counts(2, { vertices, walls }));
});

test('arrays whose memory has been sent elsewhere are refused by name', () => {
  const mesh = plates(6);
  const index = build(mesh);
  const sent = (array) => (structuredClone(array, { transfer: [array.buffer] }), array);
  const refused = (name, type) => ({ name: 'TypeError', message: `${name}: a detached ${type}, expected one with its memory` });
  assert.throws(() => new MeshIndex(sent(mesh.positions.slice()), mesh.corners), refused('positions', 'Float64Array'));
  assert.throws(() => index.counts(1, { walls: sent(new Uint8Array(72)) }), refused('walls', 'Uint8Array'));
  assert.throws(() => index.aggregate(sent(new Float32Array(72)), 1), refused('values', 'Float32Array'));
  for (const bytes of [sent(new Uint8Array(9)), sent(new Uint8Array(9)).buffer, sent(new DataView(new ArrayBuffer(9)))]) {
    assert.throws(() => readMesh(bytes, 'a.ply'), refused('bytes', bytes.constructor.name));
  }
});

test('numbers beyond 32 bits are not taken modulo 2^32', () => {
  const mesh = plates(6);
  const index = build(mesh);
  const heights = mesh.positions.filter((_, i) => i % 3 === 2);
  const variances = (ddof) => index.aggregate(heights, 2, { reduce: 'var', ddof });
  for (const ddof of [TURN, TURN + 1, 2 ** 53, 1e300]) {
    assert.throws(() => variances(ddof), { code: 'InvalidOption', message: `ddof: ${ddof}, expected at most 1` });
  }
  const one = { vertices: Uint32Array.of(1) };
  for (const size of [TURN, 2 ** 33, 1e18, 1e300]) {
    const expected = (name) => ({ code: 'InvalidOption', message: `${name}: ${size}, expected at most ${TURN - 1}` });
    assert.throws(() => index.kNearest(size, one), expected('k'));
    assert.throws(() => index.gap([0, 0, 0], 1, { faces: mesh, face: size }), expected('face'));
  }
  for (const k of [2 ** 28, TURN - 1]) {
    const message = `k: ${k} vertices for each of 1 rows, expected at most ${2 ** 28 - 1} in all`;
    assert.throws(() => index.kNearest(k, one), { code: 'TooLarge', message });
  }
  const scales = Float64Array.from({ length: 2 ** 22 }, () => 1); // by 72 rows are more than 2^28 numbers
  assert.throws(() => index.aggregate(heights, null, { scales }), { code: 'TooLarge', message: /more than 268435455 numbers/ });
  assert.equal(index.count(0, TURN + 1, { metric: 'rings' }), index.count(0, index.vertexCount, { metric: 'rings' }));
  assert.deepEqual(index.nearestConnected(0, TURN + 1), index.nearestConnected(0, index.vertexCount));
  for (const v of [TURN, TURN + 1, 2 ** 53, 1e300, -TURN]) {
    for (const ask of [() => index.neighborhood(v, 1), () => index.nested(v, Float64Array.of(1)), () => index.count(v, 1),
      () => index.contains(0, v, 1), () => index.connectingRadius(v, 0)]) {
      assert.throws(ask, { code: 'VertexOutOfRange', message: /, but the mesh has 72 vertices$/ });
    }
  }
  assert.throws(() => index.neighborhood(1e300, 1), { message: 'vertex 1e+300, but the mesh has 72 vertices' });
});

test('numbers that are not finite, denormal or huge give a right answer or an error', () => {
  const index = build(plates(6));
  const all = index.neighborhood(0, Infinity, { sort: 'id' });
  assert.equal(all.length, index.vertexCount);
  assert.deepEqual(index.neighborhood(0, 1.7e308, { sort: 'id' }), all);
  assert.deepEqual(index.neighborhood(0, 5e-324), Uint32Array.of(0));
  assert.deepEqual(index.neighborhood(0, -0), Uint32Array.of(0));
  for (const x of [NaN, Infinity, -Infinity, 1e151]) {
    assert.throws(() => index.nearest([x, 0, 0]), MeshhoodError);
    assert.throws(() => index.neighborhood([0, 0, x], 1), MeshhoodError);
    assert.throws(() => index.refit(Float64Array.of(x)), MeshhoodError);
  }
  for (const r of [NaN, -1, -Infinity]) {
    assert.throws(() => index.nested(0, Float64Array.of(r)), { code: 'InvalidRadius' });
    assert.throws(() => index.aggregate(new Float64Array(72), r), { code: 'InvalidRadius' });
    assert.throws(() => index.curvature(r, { normals: new Float64Array(216) }), MeshhoodError);
  }
  assert.deepEqual(index.neighborhood(0, Infinity, { sort: 'id' }), all);
});

test('the mesh without vertices answers nothing, and refuses the rest', () => {
  const index = new MeshIndex(new Float32Array(), new Uint32Array());
  assert.equal(index.vertexCount, 0);
  assert.deepEqual(index.counts(1), new Uint32Array());
  assert.deepEqual(index.aggregate(new Float64Array(), 1), new Float64Array());
  assert.throws(() => index.aggregate(new Float64Array(5), 1), { code: 'InvalidOption', message: '5 values, expected 1 for each of 0 vertices' });
  const masks = { walls: new Uint8Array(), ignored: new Uint8Array() };
  assert.deepEqual(index.aggregate(new Float64Array(), 1, { weights: new Float64Array(), ...masks }), new Float64Array());
  assert.throws(() => index.neighborhood(0, 1), { code: 'VertexOutOfRange' });
  assert.throws(() => index.nearest([0, 0, 0]), { code: 'VertexOutOfRange' });
  assert.equal(index.counts(1).length, 0);
});
