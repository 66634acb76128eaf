// SPDX-License-Identifier: MIT
// The words of calls on many vertices: the arrays of the command line, bit by bit.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { grid, plates, toPly } from './meshes.mjs';
import { build, library, meshhood, read, readArrays, write } from './setup.mjs';

const { MeshIndex, initialize } = library;
await initialize();

const mesh = grid(30, 25, (row, column) => [row, column, Math.sin(0.4 * row) + Math.cos(0.3 * column)], Float64Array);
const index = build(mesh);
const count = index.vertexCount;
write('hills.ply', toPly(mesh));

const mask = (belongs) => Uint8Array.from({ length: count }, (_, v) => (belongs(v) ? 1 : 0));
const listed = (bytes) => `${[...bytes.keys()].filter((v) => bytes[v] !== 0).join('\n')}\n`;
const walls = mask((v) => v % 25 === 12 && v > 50); // a wall with a gap
const ignored = mask((v) => v % 7 === 3);
const vertices = Uint32Array.of(400, 12, 387, 3, 400);
write('walls.txt', listed(walls));
write('ignored.txt', listed(ignored));
write('vertices.txt', `${vertices.join('\n')}\n`);
const FILTER = ['--walls', 'walls.txt', '--ignored', 'ignored.txt'];
const ROWS = ['--vertices', 'vertices.txt', ...FILTER];

const ofCommandLine = (...words) => {
  meshhood(...words, '-o', 'out.npz');
  return readArrays('out.npz');
};
const numbers = (array) => Array.from(array, Number);
const METRICS = ['straight', 'path', 'surface', 'rings', 'space'];

for (const metric of METRICS) {
  const by = { metric, faces: mesh };
  for (const sort of ['id', 'index', 'distance']) {
    test(`rows by ${metric}, sorted by ${sort}, are those of the command line`, () => {
      const expected = ofCommandLine('batch', 'hills.ply', '-r', '4', '--metric', metric, '--sort', sort, '--distances', ...ROWS);
      const found = index.neighborhoods(4, { vertices, ...by, sort, walls, ignored, distances: true });
      assert.deepEqual(numbers(found.offsets), numbers(expected.indptr));
      assert.deepEqual(numbers(found.ids), numbers(expected.indices));
      assert.deepEqual(found.distances, expected.data);
      assert.deepEqual(index.neighborhoods(4, { vertices, ...by, sort, walls, ignored }).ids, found.ids);
      const one = index.neighborhood(400, 4, { ...by, sort, walls, ignored, distances: true });
      assert.deepEqual(one, { ids: found.ids.slice(0, one.ids.length), distances: found.distances.slice(0, one.ids.length) });
      assert.equal(one.ids.length, found.offsets[1]);
      assert.equal(found.offsets[3] - found.offsets[2], 0); // 387 is a wall
      assert.ok(found.ids.length > 50);
    });
  }

  test(`counts by ${metric} at several scales are those of the command line`, () => {
    const scales = Float64Array.of(3, 0, 5);
    const expected = ofCommandLine('batch', 'hills.ply', '-r', '3,0,5', '--metric', metric, '--count', ...ROWS);
    const found = index.counts(null, { vertices, ...by, scales, walls, ignored });
    assert.deepEqual(numbers(found), numbers(expected.count));
    assert.equal(index.count(400, 5, { ...by, walls, ignored }), found[10]);
    assert.deepEqual(index.counts(Float64Array.of(5, 5, 5, 5, 3), { vertices, ...by, walls, ignored }),
      Uint32Array.of(...found.subarray(10, 14), found[4]));
  });
}

test('aggregates with masks, paths, scales and a radius for each row are those of the command line', () => {
  const values = Float64Array.from({ length: count }, (_, v) => mesh.positions[3 * v + 2]);
  write('values.txt', `${values.join('\n')}\n`);
  const common = ['aggregate', 'hills.ply', '--values', 'values.txt', ...ROWS];
  for (const metric of METRICS) {
    const expected = ofCommandLine(...common, '-r', '2,5', '--metric', metric, '--kernel', 'biweight').values;
    const options = { vertices, metric, faces: mesh, walls, ignored, kernel: 'biweight' };
    assert.deepEqual(index.aggregate(values, null, { ...options, scales: Float64Array.of(2, 5) }), expected, metric);
    const each = index.aggregate(values, Float64Array.of(2, 5, 2, 5, 5), options);
    assert.deepEqual(each, Float64Array.of(expected[0], expected[6], expected[2], expected[8], expected[9]), metric);
    assert.ok(Number.isNaN(each[2]));
  }
  const smooth = index.smooth(values, 3, { vertices, metric: 'path', walls });
  assert.ok(Math.abs(smooth[0] - values[400]) < 1 && smooth[0] !== index.smooth(values, 3, { vertices, walls })[0]);
  assert.throws(() => index.aggregate(values, 2, { metric: 'ring' }), { message: /^metric: 'ring', expected one of 'straight', 'path', 'rings', 'space', 'surface'/ });
  assert.throws(() => index.aggregate(values, 2, { metric: 'rings', unit: 'edge' }), { message: /^unit: 'edge'/ });
});

test('curvatures with masks, metrics and scales are those of the command line', () => {
  for (const metric of METRICS) {
    const expected = ofCommandLine('curvature', 'hills.ply', '-r', '3,5', '--metric', metric, ...ROWS);
    const found = index.curvature(null, { faces: mesh, vertices, metric, walls, ignored, scales: Float64Array.of(3, 5) });
    for (const part of ['k1', 'k2', 'd1', 'd2']) assert.deepEqual(found[part], expected[part], `${metric}: ${part}`);
    assert.deepEqual(numbers(found.state), numbers(expected.state));
    assert.equal(found.state[2], 2);
  }
});

test('paths along the surface follow the faces, the masks and the positions', () => {
  const sheet = grid(8, 8, (row, column) => [row, column, 0]);
  const along = { metric: 'surface', faces: sheet };
  const flat = build(sheet);
  const diagonal = () => [1, 8].flatMap((v) => [...flat.kNearest(64, { ...along, vertices: Uint32Array.of(v) }).distances]);
  const lengths = diagonal();
  const isDiagonal = (length) => Math.abs(length - Math.SQRT2) < 1e-15;
  for (const [v, w] of [[1, 8], [0, 9]]) assert.ok(isDiagonal(flat.connectingRadius(v, w, along))); // a side, or a line over it
  assert.equal([[1, 8], [0, 9]].filter(([v, w]) => flat.connectingRadius(v, w, { metric: 'path' }) === 2).length, 1);
  assert.ok(flat.count(0, 9.5, along) > flat.count(0, 9.5, { metric: 'path' }));
  const walled = { ...along, walls: Uint8Array.from({ length: 64 }, (_, v) => (v === 0 ? 1 : 0)) };
  assert.equal(flat.count(1, 99, walled), 63);
  assert.deepEqual(diagonal(), lengths);
  const half = { corners: sheet.corners.slice(0, 3 * Math.floor(sheet.corners.length / 6)), offsets: null };
  assert.throws(() => flat.count(0, 1, { metric: 'surface' }), { code: 'InvalidOption', message: /^faces: expected/ });
  const hit = flat.firstHit([0.25, 0.25, 1], [0, 0, -1], { faces: sheet });
  const brush = flat.neighborhood(hit.point, 1.25, { ...along, seeds: hit.vertices, sort: 'id', distances: true });
  assert.deepEqual([...brush.ids.subarray(0, 2)], [0, 1]);
  assert.equal(brush.distances[0], Math.hypot(0.25, 0.25)); // a straight line in the face
  assert.throws(() => flat.curvature(3, { metric: 'surface', normals: sheet.positions }), { code: 'InvalidOption' });
  flat.firstHit([0.2, 0.2, 1], [0, 0, -1], { faces: half }); // other faces replace what is kept
  assert.deepEqual(diagonal(), lengths);
  flat.refitInPlace(sheet.positions.map((x) => 2 * x));
  assert.deepEqual(diagonal(), lengths.map((length) => 2 * length));
  flat.dispose();
});

const NEED_FACES = {
  closestPoint: (from, options) => from.closestPoint([3.3, 4.2, 9], options),
  firstHit: (from, options) => from.firstHit([3.3, 4.2, 9], [0, 0, -1], options),
  alongSurface: (from, options) => from.neighborhood(400, 4, { metric: 'surface', ...options }),
  discs: (from, options) => from.discs(8, { vertices, ...options }),
  smooth: (from, options) => from.smooth(mesh.positions, 3, { vertices, weights: 'area', ...options }),
  invariants: (from, options) => from.invariants(2, { vertices, ...options }),
  gaps: (from, options) => from.gaps(2, { vertices, ...options }),
  patch: (from, options) => from.patch(400, 2, options),
  clip: (from, options) => from.clip(400, 2, options),
  measure: (from, options) => from.measure(400, 2, options),
  gap: (from, options) => from.gap(400, 2, options),
  submesh: (from, options) => from.submesh(vertices, { corners: 'any', ...options }),
  rim: (from, options) => from.rim(vertices, 400, 99, options),
  curvature: (from, options) => from.curvature(3, { vertices, ...options }),
  features: (from, options) => from.features(3, { vertices, ...options }),
  thickness: (from, options) => from.thickness(options),
};

test('an index that holds the faces uses them where none are given, also after a refit; another asks for them', () => {
  meshhood('build', 'hills.ply', '--faces', '-o', 'hills.mhi');
  const held = MeshIndex.load(read('hills.mhi'));
  const refuse = (call, message) => assert.throws(call, { code: 'InvalidOption', message });
  const moved = mesh.positions.map((x, i) => x + 0.1 * Math.sin(i));
  for (const [holding, other] of [[held, index], [held.refit(moved), index.refit(moved)]]) {
    for (const [name, call] of Object.entries(NEED_FACES)) {
      assert.deepEqual(call(holding, {}), call(other, { faces: mesh }), name);
      refuse(() => call(other, {}), 'faces: expected the faces of the mesh, which this index does not have');
    }
  }
  const flipped = { corners: mesh.corners.slice().reverse() };
  assert.deepEqual(held.curvature(3, { faces: flipped }), index.curvature(3, { faces: flipped }));
  const normals = mesh.positions;
  assert.deepEqual(held.curvature(3, { normals }), index.curvature(3, { normals }));
  for (const needing of [{ faces: mesh }, { metric: 'surface' }]) {
    refuse(() => held.curvature(3, { normals, ...needing }), "normals: expected null with faces, or with metric 'surface'");
  }
});

test('masks whose content changes are other masks, and calls without have none', () => {
  const barrier = new Uint8Array(count);
  const whole = index.count(400, 3);
  for (const v of [400, 401]) {
    barrier[v] = 1;
    assert.equal(index.count(v, 3, { walls: barrier }), 0);
    assert.equal(index.neighborhood(v, 3, { walls: barrier }).length, 0);
    assert.equal(index.count(400, 3), whole);
    barrier[v] = 0;
    assert.equal(index.count(v, 3, { walls: barrier }), index.count(v, 3));
  }
  for (const method of ['paper', 'bfs']) {
    assert.throws(() => index.count(400, 3, { method, walls: barrier }), { message: /^method: '\w+', expected 'exact'/ });
    assert.ok(index.count(400, 3, { method }) >= whole);
  }
  barrier[401] = 1;
  assert.equal(index.count(400, 3, { method: 'ball', walls: barrier }), index.count(400, 3, { metric: 'space' }) - 1);
});

test('the nearest unconnected vertices are those of the command line', () => {
  const sheets = plates(12);
  write('plates.ply', toPly(sheets));
  const index = build(sheets);
  const expected = ofCommandLine('unconnected', 'plates.ply', '-r', '1.5');
  const found = index.nearestUnconnected(1.5);
  assert.deepEqual(found.distance, expected.distance);
  assert.deepEqual(numbers(found.vertex).map((v) => (v === 2 ** 32 - 1 ? -1 : v)), numbers(expected.other));
  assert.ok(found.distance.some(Number.isFinite));
  const other = new Uint8Array(index.vertexCount);
  other[found.vertex[5]] = 1;
  assert.ok(index.nearestUnconnected(1.5, { vertices: Uint32Array.of(5), ignored: other }).vertex[0] !== found.vertex[5]);
});

test('features with masks and scales are those of the command line', () => {
  const kinds = ['crease', 'area', 'volume', 'gap', 'height', 'variation'];
  const expected = ofCommandLine('features', 'hills.ply', '-r', '3,5', '--kinds', kinds.join(','), ...ROWS);
  const options = { faces: mesh, vertices, walls, ignored };
  const found = index.features(null, { ...options, kinds, scales: Float64Array.of(3, 5) });
  assert.deepEqual(found, expected.features);
  const rings = ofCommandLine('features', 'hills.ply', '-r', '3', '--metric', 'rings', ...ROWS).features;
  assert.deepEqual(index.features(3, { ...options, metric: 'rings' }), rings);
  const crease = index.features(5, options);
  assert.deepEqual(crease, Float64Array.from(vertices, (_, row) => found[6 * (5 + row)]));
  assert.ok(Number.isNaN(crease[2]) && Number.isFinite(crease[0]));
  assert.throws(() => index.features(3, { ...options, kinds: ['crest'] }), { code: 'InvalidOption', message: /^kinds: 'crest'/ });
  assert.throws(() => index.features(0, options), { code: 'InvalidRadius' });
});

/** The corner of a cube, cut off, and its mirror image 0.2 above. */
const corners = {
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1, 0, 0, 0.2, 1, 0, 0.2, 0, 1, 0.2, 0, 0, 1.2),
  corners: Uint32Array.of(0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2, 4, 6, 5, 4, 5, 7, 4, 7, 6, 5, 6, 7),
  offsets: null,
};

function near(found, expected) {
  assert.ok(Math.abs(found - expected) < 1e-14, `${found} for ${expected}`);
}

test('areas, volumes and gaps are those of the command line', () => {
  write('corners.ply', toPly(corners));
  write('wall.txt', '3\n');
  const two = build(corners);
  const options = { faces: corners, walls: Uint8Array.of(0, 0, 0, 1, 0, 0, 0, 0), scales: Float64Array.of(0.1, 0.4) };
  const asked = ['corners.ply', '-r', '0.1,0.4', '--walls', 'wall.txt'];
  const expected = ofCommandLine('invariants', ...asked);
  const { area, volume } = two.invariants(null, options);
  assert.deepEqual([area, volume], [expected.area, expected.volume]);
  const wanted = ofCommandLine('gaps', ...asked);
  const gaps = two.gaps(null, options);
  const signed = (ids) => numbers(ids).map((id) => (id === 2 ** 32 - 1 ? -1 : id));
  assert.deepEqual([signed(gaps.face), signed(gaps.vertices)], [numbers(wanted.face), numbers(wanted.corners)]);
  for (const part of ['distance', 'point', 'barycentric']) assert.deepEqual(gaps[part], wanted[part], part);
  assert.ok(gaps.distance.includes(Infinity) && gaps.distance.some(Number.isFinite));
  const rows = two.invariants(Float64Array.of(0.4, 0.1), { ...options, scales: null, vertices: Uint32Array.of(4, 0) });
  assert.deepEqual(rows.area, Float64Array.of(area[12], area[0]));
  const spots = { faces: corners, points: Float64Array.of(0.3, 0.3, 0.2, 0, 0, 0), face: Uint32Array.of(4, 0) };
  const one = two.measure([0.3, 0.3, 0.2], 0.4, { faces: corners, face: 4 });
  assert.deepEqual(two.invariants(0.4, spots).volume[0], one.volume);
  assert.deepEqual(two.invariants(null, { ...spots, scales: Float64Array.of(0.1, 0.4) }).area[2], one.area);
  assert.equal(two.gaps(Float64Array.of(0.4, 0.1), spots).distance.length, 2);
  assert.throws(() => two.gaps(1, { ...spots, vertices: Uint32Array.of(0) }), { message: /^points: expected points and/ });
  two.dispose();
});

test('a clipped patch ends at the sphere, and its points lie on the faces', () => {
  const two = build(corners);
  const { area } = two.invariants(0.4, { faces: corners, vertices: Uint32Array.of(0) });
  const disc = two.clip(0, 0.4, { faces: corners });
  near(disc.area, area[0]);
  assert.deepEqual([...new Set(disc.faces)], [...two.patch(0, 0.4, { faces: corners })]);
  assert.equal(disc.corners.length, 3 * disc.faces.length);
  assert.deepEqual([...disc.vertices.subarray(0, 3)], [0, 0, 0]);
  disc.positions.forEach((x, i) => {
    const [row, axis] = [Math.floor(i / 3), i % 3];
    const parts = [0, 1, 2].map((k) =>
      disc.weights[3 * row + k] * corners.positions[3 * disc.vertices[3 * row + k] + axis]);
    near(parts[0] + parts[1] + parts[2], x);
    if (row > 0 && axis === 0) near(Math.hypot(...disc.positions.subarray(i, i + 3)), 0.4);
  });
  const coarse = two.clip(0, 0.4, { faces: corners, tolerance: 0.1 });
  assert.ok(coarse.faces.length < disc.faces.length);
  assert.equal(two.clip([0.3, 0.3, 0.2], 0.01, { faces: corners, face: 4 }).faces[0], 4);
  assert.throws(() => two.clip(0, 1, { faces: corners, tolerance: 0 }), { code: 'InvalidOption', message: /^tolerance/ });
  assert.throws(() => two.clip(0, 1, { faces: corners, tolerance: '1' }), { name: 'TypeError', message: /^tolerance/ });
  two.dispose();
});

test('area, volume and gap of a vertex are a row of all, and so of a point', () => {
  const two = build(corners);
  const options = { faces: corners };
  const all = two.invariants(0.4, options);
  const gaps = two.gaps(0.4, options);
  for (let v = 0; v < two.vertexCount; ++v) {
    const { area, volume } = two.measure(v, 0.4, options);
    near(area, all.area[v]);
    near(volume, all.volume[v]);
    const gap = two.gap(v, 0.4, options);
    assert.equal(gap?.face ?? 2 ** 32 - 1, gaps.face[v]);
    if (gap === null) continue;
    near(gap.distance, gaps.distance[v]);
    assert.deepEqual(gap.vertices, gaps.vertices.slice(3 * v, 3 * v + 3));
  }
  const point = [0.3, 0.3, 0.2];
  near(two.measure(point, 0.1, { faces: corners, face: 4 }).area, Math.PI * 0.01);
  near(two.measure(point, 0.1, { faces: corners, face: 4 }).volume, (2 / 3) * Math.PI * 0.001);
  assert.equal(two.gap(point, 0.1, { faces: corners, face: 4 }), null);
  const gap = two.gap(point, 0.25, { faces: corners, face: 4 });
  assert.equal(gap.face, 0);
  near(gap.distance, 0.2);
  [0.3, 0.3, 0].forEach((x, axis) => near(gap.point[axis], x));
  const walls = Uint8Array.of(1, 0, 0, 0, 0, 0, 0, 0);
  assert.deepEqual(two.measure(0, 0.4, { faces: corners, walls }), { area: 0, volume: NaN });
  assert.deepEqual(two.measure([0.3, 0.3, 0.5], 0.2, { faces: corners, face: 4 }), { area: 0, volume: NaN });
  assert.equal(two.gap(0, 0.4, { faces: corners, walls }), null);
  assert.throws(() => two.measure(point, 1, options), { name: 'TypeError', message: /^face: null/ });
  assert.throws(() => two.gap(8, 1, options), { code: 'VertexOutOfRange' });
  assert.throws(() => two.gap(0, -1, options), { code: 'InvalidRadius' });
  two.dispose();
});

test('the patch of a vertex or of a point has faces', () => {
  const two = build(corners);
  assert.deepEqual([...two.patch(0, 0.1, { faces: corners })], [0, 1, 2]);
  assert.deepEqual([...two.patch(0, 0.8, { faces: corners })], [0, 1, 2, 3]);
  assert.deepEqual([...two.patch([0.3, 0.3, 0.2], 0.1, { faces: corners, face: 4 })], [4]);
  const walls = Uint8Array.of(0, 0, 0, 1, 0, 0, 0, 0);
  assert.deepEqual([...two.patch(0, 0.8, { faces: corners, walls })], [0]);
  assert.deepEqual([...two.patch(0, 0.8, { faces: corners })], [0, 1, 2, 3]);
  two.refitInPlace(corners.positions.map((x) => 2 * x));
  assert.deepEqual([...two.patch(0, 0.8, { faces: corners })], [0, 1, 2]);
  for (const face of [8, 2 ** 32]) {
    assert.throws(() => two.patch([0, 0, 0], 1, { faces: corners, face }), { code: 'InvalidOption' });
  }
  assert.throws(() => two.patch([0, 0, 0], 1, { faces: corners }), { name: 'TypeError', message: /^face: null/ });
  assert.throws(() => two.patch(0, 1, { faces: corners, face: 1 }), { code: 'InvalidOption', message: /^face/ });
  assert.throws(() => two.patch(8, 1, { faces: corners }), { code: 'VertexOutOfRange' });
  assert.throws(() => two.patch(0, -1, { faces: corners }), { code: 'InvalidRadius' });
  assert.throws(() => two.gaps(1), { code: 'InvalidOption', message: /^faces/ });
  assert.throws(() => two.invariants(1, { faces: corners, metric: 'path' }), /metric/);
  two.dispose();
});

test('the nearest of many vertices are those of each, by connecting radius and by paths', () => {
  const k = 9;
  const { ids, distances } = index.kNearest(k, { vertices, walls, ignored });
  vertices.forEach((v, row) => {
    const { ids: one, radii } = index.nearestConnected(v, k, { walls, ignored });
    assert.deepEqual([...ids.subarray(k * row, k * row + one.length)], [...one]);
    assert.deepEqual([...distances.subarray(k * row, k * row + one.length)], [...radii]);
    for (let i = k * row + one.length; i < k * (row + 1); ++i) assert.deepEqual([ids[i], distances[i]], [2 ** 32 - 1, Infinity]);
  });
  assert.equal(ids[2 * k], 2 ** 32 - 1); // 387 is a wall
  const one = Uint32Array.of(400);
  const paths = index.kNearest(20, { vertices: one, metric: 'path', walls });
  const within = index.neighborhood(400, paths.distances[19], { metric: 'path', walls, distances: true });
  assert.deepEqual([...paths.distances], [...within.distances.subarray(0, 20)]);
  const short = index.kNearest(20, { vertices: one, metric: 'path', r: 1.5 });
  assert.equal(short.distances.filter(Number.isFinite).length, index.neighborhood(400, 1.5, { metric: 'path' }).length);
  assert.equal(index.kNearest(2).ids.length, 2 * count);
  assert.deepEqual([...index.kNearest(3, { vertices: one, metric: 'rings' }).distances], [0, 1, 1]);
  assert.throws(() => index.kNearest(3, { r: -1 }), { code: 'InvalidRadius' });
  const none = { code: 'InvalidOption', message: 'k: 0, expected at least 1' };
  assert.throws(() => index.kNearest(0), none);
  assert.throws(() => index.nearestConnected(400, 0), none);
  assert.throws(() => index.kNearest(null), { name: 'TypeError', message: /^k: null, expected a whole number/ });
});

test('discs have the first of the nearest vertices whose areas reach a sum', () => {
  const ones = new Float64Array(count).fill(1);
  const few = index.discs(4.5, { vertices, weights: ones });
  assert.deepEqual([...few.offsets], [0, 5, 10, 15, 20, 25]);
  const { ids } = index.kNearest(5, { vertices });
  assert.deepEqual(few.ids, ids);
  const one = Uint32Array.of(400);
  const disc = index.discs(8, { vertices: one, faces: mesh, metric: 'path' });
  assert.deepEqual(disc.ids, index.kNearest(disc.ids.length, { vertices: one, metric: 'path' }).ids);
  assert.ok(disc.ids.length > 3 && disc.ids.length < 12);
  assert.throws(() => index.discs(null, { faces: mesh }), { name: 'TypeError', message: /^area null, expected a number/ });
  assert.throws(() => index.discs(8), { code: 'InvalidOption', message: /^faces: expected/ });
  assert.throws(() => index.discs(0, { weights: ones }), { code: 'InvalidOption', message: /^area: 0/ });
});

test('the closest point of the surface is that of the command line', () => {
  for (const point of [[3.3, 4.2, 9], [-1, 2.5, 0], [10.5, 10.25, -3]]) {
    const [expected] = JSON.parse(meshhood('closest', 'hills.ply', '--point', point.join(','), '--json'));
    const found = index.closestPoint(point, { faces: mesh });
    assert.deepEqual({ ...found, vertices: [...found.vertices], barycentric: [...found.barycentric], point: [...found.point] }, expected);
  }
  const { point, vertices: seeds } = index.closestPoint([3.3, 4.2, 9], { faces: mesh });
  assert.ok(index.neighborhood(point, 2, { seeds }).length > 5);
  assert.throws(() => index.closestPoint([1, 2, 3]), { code: 'InvalidOption', message: /^faces: expected/ });
  assert.throws(() => index.closestPoint([1, 2, Infinity], { faces: mesh }), { code: 'InvalidOption' });
});

test('the first hit of a ray is the point of the surface on it', () => {
  const hit = index.firstHit([3.3, 4.2, 9], [0, 0, -0.5], { faces: mesh });
  const { face, barycentric, vertices: corners, point, distance: height } = hit;
  const { face: nearest, distance: off } = index.closestPoint(point, { faces: mesh });
  assert.equal(face, nearest);
  assert.ok(off < 1e-14);
  assert.deepEqual([...corners].sort(), [...mesh.corners.subarray(3 * face, 3 * face + 3)].sort());
  for (const [axis, expected] of [3.3, 4.2, 9 - height].entries()) {
    const at = barycentric.reduce((sum, weight, i) => sum + weight * mesh.positions[3 * corners[i] + axis], 0);
    assert.ok(Math.abs(at - expected) < 1e-14);
    assert.ok(Math.abs(point[axis] - expected) < 1e-14);
  }
  assert.equal(index.firstHit([3.3, 4.2, 9], [0, 0, 1], { faces: mesh }), null);
  assert.throws(() => index.firstHit([3, 4, 9], [0, 0, 0], { faces: mesh }), { code: 'InvalidOption', message: /^direction/ });
  assert.throws(() => index.firstHit([3, 4, 9], [0, 0, -1]), { code: 'InvalidOption', message: /^faces: expected/ });
  assert.throws(() => index.firstHit([3, 4, 9], 5, { faces: mesh }), { name: 'TypeError', message: /^direction/ });
});

test('the thickness of a folded sheet is that between its halves', () => {
  const side = 12;
  const sheet = grid(2 * side, side, (row, column) =>
    [Math.min(row, 2 * side - 1 - row), column, row < side ? 0 : 2], Float64Array);
  const folded = build(sheet);
  const inner = 5 * side + 6;
  for (const method of ['ray', 'sphere']) {
    const all = folded.thickness({ faces: sheet, method });
    assert.equal(all.length, folded.vertexCount);
    assert.equal(all[inner], 2);
    const some = Uint32Array.of(3 * side + 1, inner);
    assert.deepEqual(folded.thickness({ faces: sheet, vertices: some, method }), Float64Array.of(all[some[0]], 2));
    const { face, point } = folded.closestPoint([5.25, 6.5, 0], { faces: sheet });
    const spots = { faces: sheet, points: Float64Array.from(point), face: Uint32Array.of(face), method };
    assert.deepEqual(folded.thickness(spots), Float64Array.of(2));
    assert.throws(() => folded.thickness({ ...spots, vertices: some }), { code: 'InvalidOption', message: /^points: expected/ });
    assert.throws(() => folded.thickness({ ...spots, points: new Float64Array(4) }), {
      code: 'InvalidOption', message: /^points: 4 coordinates, expected three for each of 1 faces/,
    });
    assert.throws(() => folded.thickness({ ...spots, face: null }), { code: 'InvalidOption', message: /^points: expected/ });
    assert.throws(() => folded.thickness({ ...spots, face: Uint32Array.of(9999) }), {
      code: 'InvalidOption', message: /^faces: row 0: face 9999/,
    });
  }
  assert.throws(() => folded.thickness(), { code: 'InvalidOption', message: /^faces: expected/ });
  assert.throws(() => folded.thickness({ faces: sheet, method: 'ball' }), { code: 'InvalidOption', message: /^method: 'ball'/ });
  assert.throws(() => folded.thickness({ faces: sheet, vertices: Uint32Array.of(999) }), { code: 'VertexOutOfRange' });
  folded.dispose();
});

test('words that contradict each other are refused', () => {
  const scales = Float64Array.of(1, 2);
  const heights = new Float64Array(count);
  const refuse = (call, message) => assert.throws(call, { name: 'TypeError', message });
  refuse(() => index.counts(1, { scales }), 'r: 1, expected null with scales');
  refuse(() => index.counts(null), 'r: null, expected a radius, or one for each row; or null, and several radii for all rows as scales');
  for (const [r, found] of [['1.5', "'1.5'"], [1n, '1n'], [[1, 2], 'Array'], [undefined, 'undefined'], [null, 'null']]) {
    refuse(() => index.neighborhoods(r), `r: ${found}, expected a number or a typed array of numbers`);
  }
  refuse(() => index.aggregate([1], 1), 'values: Array, expected a typed array of numbers');
  for (const call of [(o) => index.aggregate(heights, 1, o), (o) => index.discs(1, o)]) {
    refuse(() => call({ weights: 5 }), "weights: 5, expected 'area' or a typed array of numbers");
  }
  refuse(() => index.aggregate(new BigInt64Array(), 1), 'values: BigInt64Array, expected a typed array of numbers');
  assert.throws(() => index.neighborhoods(null, { scales }), { name: 'TypeError', message: /^unknown option 'scales'/ });
  assert.throws(() => index.counts(Float64Array.of(1, 2)), { code: 'InvalidRadius' });
  assert.throws(() => index.counts(1, { walls: new Uint8Array(3) }), { code: 'InvalidOption' });
  assert.throws(() => index.counts(1, { walls: [1] }), TypeError);
  const none = `0 values, expected one for each of ${count} vertices`; // and not all vertices
  for (const name of ['walls', 'ignored']) {
    for (const call of [(o) => index.counts(1, o), (o) => index.count(5, 1, o), (o) => index.aggregate(heights, 1, o)]) {
      assert.throws(() => call({ [name]: new Uint8Array() }), { code: 'InvalidOption', message: `${name}: ${none}` });
    }
  }
  for (const call of [(o) => index.aggregate(heights, 1, o), (o) => index.smooth(heights, 1, o), (o) => index.discs(1, o)]) {
    assert.throws(() => call({ weights: new Float64Array() }), { code: 'InvalidOption', message: `weights: ${none}` });
  }
  for (const method of ['paper', 'bfs']) {
    const message = `method: '${method}', expected 'exact' or 'ball' with walls or ignored vertices`;
    assert.throws(() => index.counts(1, { walls, method }), { code: 'InvalidOption', message });
  }
  assert.throws(() => index.counts(1, { metric: 'rings', unit: 'edge' }), { code: 'InvalidOption', message: /^unit/ });
  assert.throws(() => index.neighborhood(5, 1, { sort: true }), { code: 'InvalidOption', message: /^sort: true/ });
  assert.equal(index.count(400, 0), 1);
});
