// SPDX-License-Identifier: MIT
// The package for JavaScript under Node: reading, building, loading and queries. MESHHOOD_GOLDEN is the folder of the
// golden files.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { distance, grid, plates, polygons, random, roll, toPly } from './meshes.mjs';
import { build, library, meshhood, read as readFile, readArrays, scaled, write } from './setup.mjs';

const { MeshIndex, MeshhoodError, initialize, readMesh } = library;

test('nothing works before the module is compiled, and the error says what to call', () => {
  assert.throws(() => new MeshIndex(new Float32Array(), new Uint32Array()), /call initialize\(\) first/);
});

test('compiling twice at once compiles', async () => {
  await Promise.all([initialize(), initialize()]);
  await initialize();
});

const golden = (name) => readFileSync(join(process.env.MESHHOOD_GOLDEN, name));

const families = { roll: roll(60, 12), 'double roll': roll(40, 9, Float64Array), plates: plates(18), polygons: polygons(300, 260) };

for (const [name, mesh] of Object.entries(families)) {
  test(`rows of ${name} by each method are those of the command line`, () => {
    write('family.ply', toPly(mesh));
    const index = build(mesh);
    const next = random(1);
    const vertices = Uint32Array.from({ length: scaled(1000) }, () => Math.floor(index.vertexCount * next()));
    // Also radii at which a vertex lies exactly on the boundary.
    const radii = Float64Array.from(vertices, (v, i) =>
      (i % 3 === 0 ? distance(mesh.positions, v, Math.floor(index.vertexCount * next())) : 6 * next()));
    write('rows.txt', `${vertices.join('\n')}\n`);
    write('radii.txt', `${radii.join('\n')}\n`);
    for (const method of ['exact', 'bfs', 'paper', 'ball']) {
      meshhood('batch', 'family.ply', '--vertices', 'rows.txt', '--radii', 'radii.txt', '--method', method, '-o', 'rows.npz');
      const { indptr, indices } = readArrays('rows.npz');
      const found = index.neighborhoods(radii, { vertices, method, sort: 'id' });
      assert.deepEqual(Array.from(found.offsets), Array.from(indptr, Number));
      assert.deepEqual(Array.from(found.ids), Array.from(indices), method);
      assert.deepEqual(index.counts(radii, { vertices, method }), found.offsets.slice(1).map((end, row) => end - found.offsets[row]));
      assert.ok(found.ids.length > 5 * scaled(1000));
    }
  });
}

test('a view is the answer without a copy', () => {
  const index = build(families.roll);
  const view = index.viewNeighborhood(100, 3);
  assert.deepEqual(view.slice(), index.neighborhood(100, 3, { sort: 'index' }));
  assert.equal(view.buffer.byteLength, index.memoryBytes);
});

test('radii in mean edge lengths', () => {
  const index = build(grid(20, 20, (row, column) => [2 * row, 2 * column, 0]));
  const edge = index.meanEdgeLength;
  assert.ok(edge > 2 && edge < 2 * Math.SQRT2);
  assert.deepEqual(index.neighborhood(210, 3, { unit: 'edge' }), index.neighborhood(210, 3 * edge));
  const points = new MeshIndex(new Float32Array(6), new Uint32Array());
  assert.throws(() => points.neighborhood(0, 1, { unit: 'edge' }), { message: /no edges of positive length/ });
});

test('the golden index files load, and save to the same bytes', () => {
  const names = readdirSync(process.env.MESHHOOD_GOLDEN).filter((name) => !name.startsWith('paper'));
  assert.ok(names.length >= 4);
  for (const name of names) {
    const index = MeshIndex.load(golden(name));
    assert.deepEqual(Buffer.from(index.save()), golden(name), name);
    assert.deepEqual([...index.permutation.sort()], [...Array(index.vertexCount).keys()], name);
  }
});

test('the same file gives the same index and the same answers as the command line', () => {
  const mesh = roll(70, 15);
  write('roll.ply', toPly(mesh));
  meshhood('build', 'roll.ply', '-o', 'roll.mhi');
  const saved = readFile('roll.mhi');
  const read = readMesh(toPly(mesh), 'roll.ply');
  assert.deepEqual(read.positions, mesh.positions);
  assert.deepEqual(read.corners, mesh.corners);
  const index = build(read);
  assert.deepEqual(Buffer.from(index.save()), saved);
  for (const method of ['exact', 'paper', 'bfs', 'ball']) {
    const { vertices } = JSON.parse(
      meshhood('query', 'roll.mhi', '-v', '500', '-r', '3.5', '--method', method, '--json')).answers[0];
    assert.deepEqual([...MeshIndex.load(saved).neighborhood(500, 3.5, { method, sort: 'id' })], vertices);
  }
  write('page.mhi', index.save());
  assert.match(meshhood('check', 'page.mhi', '--mesh', 'roll.ply'), /\S/);
});

test('a vertex of NaN in no face is a wall that calls may take', () => {
  const scan = readMesh(Buffer.from('OFF\n4 1 0\nnan nan nan\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n'), 'scan.off');
  const { walls } = scan;
  assert.deepEqual([...walls], [1, 0, 0, 0]);
  assert.deepEqual([...scan.positions.subarray(0, 3)], [0, 0, 0]);
  assert.deepEqual(scan.warnings, ['line 3: vertices without a position (NaN), the first of which is 0, are walls']);
  const scanned = new MeshIndex(scan.positions, scan.corners);
  assert.equal(scanned.nearest([0, 0, 0]).vertex, 0);
  assert.equal(scanned.nearest([0, 0, 0], { walls }).vertex, 1);
  assert.deepEqual([...scanned.neighborhood([0, 0, 0], 2, { walls, sort: 'id' })], [1, 2, 3]);
  assert.deepEqual([...scanned.neighborhood(1, Infinity, { walls, metric: 'space', sort: 'id' })], [1, 2, 3]);
  assert.equal(readMesh(toPly(polygons(50, 20)), 'p.ply').walls, null);
});

test('a mesh says the format of its file', () => {
  const numbers = Buffer.alloc(56); // of FreeSurfer: 3 vertices, 1 face, both as arrays
  [3, 1].forEach((count, i) => numbers.writeInt32BE(count, 4 * i));
  [0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((x, i) => numbers.writeFloatBE(x, 8 + 4 * i));
  [0, 1, 2].forEach((v, i) => numbers.writeInt32BE(v, 44 + 4 * i));
  const files = {
    ply: toPly(polygons(50, 20)),
    obj: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n',
    off: 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n',
    stl: 'solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n',
    vtk: '# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n',
    freesurfer: Buffer.concat([Buffer.from('\xff\xff\xfecreated by\n\n', 'latin1'), numbers]),
  };
  for (const [format, file] of Object.entries(files)) assert.equal(readMesh(Buffer.from(file), 'a').format, format);
});

test('polygons, precision and warnings of a file', () => {
  const mesh = polygons(50, 20);
  const read = readMesh(toPly(mesh), 'p.ply');
  assert.ok(read.positions instanceof Float64Array);
  assert.deepEqual(read.offsets, mesh.offsets);
  assert.ok(readMesh(toPly(mesh), 'p.ply', { precision: 'float' }).positions instanceof Float32Array);
  const far = Buffer.from('v 451234.5 5412345.2 0\nv 451234.6 5412345.2 0\nv 451234.6 5412345.3 0\nf 1 2 3\n');
  assert.equal(readMesh(far, 'far.obj').positions[1], 5412345.2);
  assert.deepEqual(readMesh(far, 'far.obj').warnings, []);
  const rounded = readMesh(far, 'far.obj', { precision: 'float', strict: true });
  assert.match(rounded.warnings[0], /^the mean edge is .* floats are 0.5 apart at 5.41e\+06/);
  const more = Buffer.concat([toPly(mesh), Buffer.from('1 2 3\n')]);
  assert.match(readMesh(more, 'p.ply').warnings[0], /^line \d+: data after the last element$/);
  assert.throws(() => readMesh(more, 'p.ply', { strict: true }), { code: 'MalformedFile' });
});

test('a mesh is read only with a name', () => {
  const bytes = toPly(polygons(50, 20));
  for (const [name, found] of [[undefined, 'undefined'], [{ precision: 'float' }, 'Object'], [42, '42'], [null, 'null']]) {
    assert.throws(() => readMesh(bytes, name), { name: 'TypeError', message: `name: ${found}, expected a string` });
  }
});

test('every damaged index file is refused, with the place of the damage', () => {
  const bytes = golden('float.mhi');
  const next = random(3);
  for (let i = 0; i < scaled(300); ++i) {
    const damaged = Buffer.from(bytes);
    const at = Math.floor(bytes.length * next());
    damaged[at] ^= 1 << Math.floor(8 * next());
    assert.throws(() => MeshIndex.load(damaged), { code: 'MalformedIndex' }, `byte ${at}`);
  }
  for (let size = 0; size < bytes.length; size += 997) {
    assert.throws(() => MeshIndex.load(bytes.subarray(0, size)), { code: 'MalformedIndex' }, `${size} bytes`);
  }
});

test('a wrong argument gives the error of C++ and leaves the index usable', () => {
  const index = build(families.roll);
  const expected = index.neighborhood(7, 2);
  const vertices = index.vertexCount;
  for (const v of [vertices, -1, 2 ** 32, 2 ** 53]) {
    const message = `vertex ${v}, but the mesh has ${vertices} vertices`;
    assert.throws(() => index.neighborhood(v, 1), { code: 'VertexOutOfRange', message });
    assert.throws(() => index.count(v, 1), { code: 'VertexOutOfRange', message });
  }
  for (const radius of [-1, NaN, -Infinity]) {
    const message = `radius ${String(radius).toLowerCase().replace('infinity', 'inf')}, expected a number >= 0`;
    assert.throws(() => index.neighborhood(7, radius), { code: 'InvalidRadius', message });
    assert.throws(() => index.count(7, radius, { method: 'bfs' }), { code: 'InvalidRadius', message });
  }
  assert.throws(() => index.neighborhoods(1, { vertices: Uint32Array.of(1, vertices) }), { code: 'VertexOutOfRange', message: /row 1/ });
  assert.throws(() => index.neighborhoods(Float64Array.of(1, 2), { vertices: Uint32Array.of(1) }), { message: '2 radii for 1 rows' });
  assert.throws(() => index.neighborhood(1, 1, { method: 'best' }), { code: 'InvalidOption', message: /expected one of/ });
  for (const v of [1.5, NaN, '1', undefined]) assert.throws(() => index.neighborhood(v, 1), TypeError);
  for (const radius of ['1', null, undefined]) assert.throws(() => index.viewNeighborhood(1, radius), TypeError);
  assert.throws(() => index.neighborhoods(1, { vertices: [1, 2] }), { name: 'TypeError', message: /^vertices: Array, expected Uint32Array/ });
  assert.deepEqual(index.neighborhood(7, 2), expected);
});

test('arrays that are no mesh are refused in the words of C++', () => {
  const positions = new Float32Array(9);
  const refuse = (xyz, corners, options, expected) => assert.throws(() => new MeshIndex(xyz, corners, options), expected);
  refuse(positions, Uint32Array.of(0, 1, 3), {}, { code: 'InvalidMesh', message: /3/ });
  refuse(positions, Int32Array.of(0, 1, -1), {}, { code: 'InvalidMesh', message: /-1/ });
  refuse(Float32Array.of(0, NaN, 0), new Uint32Array(), {}, { code: 'InvalidMesh', message: /finite/ });
  refuse(new Float32Array(8), new Uint32Array(), {}, { code: 'InvalidMesh' });
  refuse(positions, Uint32Array.of(0, 1), {}, { code: 'InvalidMesh' });
  refuse(positions, Uint32Array.of(0, 1), { offsets: Uint32Array.of(0, 3) }, { code: 'InvalidMesh' });
  refuse([0, 0, 0], new Uint32Array(), {}, TypeError);
  refuse(positions, [0, 1, 2], {}, TypeError);
  refuse(positions, undefined, {}, TypeError);
});

test('indices of 16 bits, as three.js makes them, give the same index', () => {
  for (const mesh of [families.roll, families.polygons]) {
    const narrow = { ...mesh, corners: Uint16Array.from(mesh.corners), offsets: mesh.offsets && Uint16Array.from(mesh.offsets) };
    assert.deepEqual(build(narrow).save(), build(mesh).save());
    assert.deepEqual(build(mesh).curvature(3, { faces: narrow }), build(mesh).curvature(3, { faces: mesh }));
    const ids = build(mesh).neighborhood(7, 3);
    assert.deepEqual(build(narrow).submesh(ids, { faces: narrow }), build(mesh).submesh(ids, { faces: mesh }));
  }
  assert.throws(() => build({ positions: new Float32Array(9), corners: Uint16Array.of(0, 1, 3) }), { code: 'InvalidMesh', message: /3/ });
});

test('progress is reported, can cancel, and its exceptions are passed on', () => {
  const mesh = roll(300, 60);
  const seen = [];
  build(mesh, { progress: (done, total) => { seen.push(done / total); } });
  assert.equal(seen[0], 0);
  assert.equal(seen.at(-1), 1);
  assert.deepEqual(seen, [...seen].sort((a, b) => a - b));
  assert.throws(() => build(mesh, { progress: () => false }), { code: 'Cancelled' });
  const failure = new Error('from the callback');
  for (const thrown of [failure, null, undefined, 0, new MeshhoodError('InvalidOption', 'of another index')]) {
    try {
      build(mesh, { progress() { throw thrown; } });
      assert.fail();
    } catch (error) {
      assert.equal(error, thrown);
    }
  }
  assert.throws(() => readMesh(toPly(mesh), 'a.ply', { progress: () => false }), { code: 'Cancelled' });
});

test('too little memory is an error and not a crash', () => {
  const header = 'ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty float x\nproperty float y\n' +
    'property float z\nend_header\n';
  assert.throws(() => readMesh(new TextEncoder().encode(header), 'short.ply'), { code: 'MalformedFile' });
});

test('a result that is too large is refused by its size, and the index lives', () => {
  const index = build(grid(300, 300, (row, column) => [row, column, 0]));
  const expected = index.counts(2);
  const vertices = Uint32Array.from({ length: 16_000 }, (_, row) => row);
  const refused = (most) => ({
    code: 'TooLarge', message: new RegExp(`^the result of \\d+ rows, .*\\d{10,} bytes, exceeds max_bytes, ${most}\\d{9}$`),
  });
  const ids = vertices.subarray(0, 7_000); // of 2.5 GB, which is more than one array can have
  for (const options of [{}, { vertices: ids }, { distances: true, vertices }, { metric: 'space' }, { method: 'paper', vertices: ids }]) {
    assert.throws(() => index.neighborhoods(Infinity, options), refused(options.distances ? 3 : 2));
    assert.throws(() => index.neighborhoods(Infinity, { ...options, method: 'bfs', metric: 'straight' }), refused(1));
  }
  const weights = new Float64Array(index.vertexCount).fill(1);
  assert.throws(() => index.discs(80_000, { weights }), refused(3));
  assert.deepEqual(index.counts(2), expected);
  console.log(`${index.memoryBytes} bytes after results that were too large`);
  assert.ok(index.memoryBytes < 100 * 2 ** 20);
});

test('rows by radii that no array can have are refused, and the index lives', () => {
  const mesh = grid(256, 256, (row, column) => [row, column, 0]);
  const index = build(mesh);
  const expected = index.counts(2);
  const scales = (count) => new Float64Array(count).fill(0.001);
  const options = { scales: scales(2 ** 16 + 1), faces: mesh };
  const refused = { code: 'TooLarge', message: /^the result of 65537 radii by 65536 rows by \d+ columns, expected at most/ };
  assert.throws(() => index.counts(null, { scales: options.scales }), refused);
  for (const call of ['curvature', 'features', 'invariants', 'gaps']) {
    assert.throws(() => index[call](null, options), refused);
  }
  for (const [call, radii] of [['curvature', 2 ** 12 / 2], ['gaps', 2 ** 12 / 8]]) { // whose rows have several numbers
    const message = new RegExp(`^the result of ${radii} radii by 65536 rows by \\d+ columns, expected at most`);
    assert.throws(() => index[call](null, { scales: scales(radii), faces: mesh }), { code: 'TooLarge', message });
  }
  assert.deepEqual(index.counts(2), expected);
});

test('a mesh of a million vertices takes less than 400 MB, with all methods in use', () => {
  const index = build(grid(1000, 1000, (row, column) => [row, column, 0]));
  const counts = ['exact', 'bfs', 'paper', 'ball'].map((method) => index.count(500_500, 10, { method }));
  assert.deepEqual(counts, [317, 317, 317, 317]);
  console.log(`${index.memoryBytes} bytes for a million vertices`);
  assert.ok(index.memoryBytes < 400 * 2 ** 20);
});

test('memory stays flat over many queries, refused ones included', () => {
  const mesh = families.roll;
  const index = build(mesh);
  const next = random(5);
  const runQuery = () => {
    const v = Math.floor(index.vertexCount * next());
    const radius = 5 * next();
    for (const method of ['exact', 'paper']) index.neighborhood(v, radius, { method, distances: true });
    index.count(v, radius, { method: 'bfs' });
    assert.throws(() => index.neighborhood(v + 1e6, radius), MeshhoodError);
  };
  for (let i = 0; i < 1000; ++i) runQuery();
  index.neighborhood(0, Infinity, { distances: true });
  const before = index.memoryBytes;
  for (let i = 0; i < scaled(25_000); ++i) runQuery();
  for (let i = 0; i < 100; ++i) index.neighborhoods(3);
  const grown = index.memoryBytes - before;
  console.log(`${before} bytes, ${grown} more after ${4 * scaled(25_000)} queries and 100 batches`);
  assert.ok(grown <= 2 ** 20);
});

test('a refused refit takes no memory, and leaves what queries have needed', () => {
  const mesh = grid(150, 150, (row, column) => [row, column, 0]);
  const index = build(mesh);
  const wrong = { nan: mesh.positions.slice().fill(NaN, 0, 1), short: mesh.positions.slice(3) };
  const ask = () => index.closestPoint([3, 4, 5], { faces: mesh }).distance;
  assert.equal(ask(), 5);
  const before = index.memoryBytes;
  for (let i = 0; i < 20; ++i) {
    for (const positions of Object.values(wrong)) {
      assert.throws(() => index.refitInPlace(positions), { code: 'InvalidMesh' });
      assert.throws(() => index.refitInPlace(positions, { changed: Uint32Array.of(0) }), { code: 'InvalidMesh' });
      assert.equal(ask(), 5);
    }
  }
  console.log(`${index.memoryBytes - before} bytes more after refused refits`);
  assert.ok(index.memoryBytes - before <= 2 ** 20);
});

test('forgotten indexes are collected, also while nothing else can run', () => {
  const mesh = roll(10, 10);
  const before = process.memoryUsage().external;
  let most = 0;
  for (let i = 0; i < 1000; ++i) {
    build(mesh);
    most = Math.max(most, process.memoryUsage().external - before);
  }
  console.log(`${most} bytes at most of 1000 forgotten indexes, each of ${build(mesh).memoryBytes}`);
  assert.ok(most < 500 * build(mesh).memoryBytes);
});

test('a disposed index gives its memory back and refuses calls', () => {
  const index = build(families.roll);
  assert.ok(index.memoryBytes > 0);
  index.dispose();
  index.dispose();
  assert.equal(index.memoryBytes, 0);
  assert.throws(() => index.neighborhood(0, 1), /has been disposed/);
});
