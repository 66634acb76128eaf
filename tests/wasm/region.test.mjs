// SPDX-License-Identifier: MIT
// Starts of all kinds, and parts of meshes, in the package for JavaScript: the answers of the command line.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { distance, grid, polygons, random, roll, toPly } from './meshes.mjs';
import { build, library, meshhood, read, readArrays, scaled, write } from './setup.mjs';

const { MeshIndex, initialize } = library;
await initialize();

const mesh = roll(70, 15, Float64Array);
const index = build(mesh);
const vertices = mesh.positions.length / 3;
write('roll.ply', toPly(mesh));

const every = (step) => Uint32Array.from({ length: Math.floor(vertices / step) }, (_, i) => step * i);
const mask = (ids) => {
  const bytes = new Uint8Array(vertices);
  for (const v of ids) bytes[v] = 1;
  return bytes;
};
const walls = mask(every(7));
const ignored = mask(every(5));
write('walls.txt', `${every(7).join('\n')}\n`);
write('ignored.txt', `${every(5).join('\n')}\n`);

const query = (...options) => JSON.parse(meshhood('query', 'roll.ply', ...options, '--json')).answers[0].vertices;

test('a neighborhood of a vertex with masks is that of the command line', () => {
  const found = index.neighborhood(502, 5, { walls, ignored, sort: 'id' });
  assert.deepEqual([...found], query('-v', '502', '-r', '5', '--walls', 'walls.txt', '--ignored', 'ignored.txt'));
  assert.ok(found.length > 20);
});

test('a neighborhood of a point with seeds is that of the command line', () => {
  const point = Array.from(mesh.positions.subarray(3 * 502, 3 * 503), (x) => x + 0.25);
  for (const seeds of [null, Uint32Array.of(500, 30)]) {
    const options = seeds === null ? [] : ['--seed', seeds.join()];
    const found = index.neighborhood(point, 6, { seeds, sort: 'id' });
    assert.deepEqual([...found], query('--point', point.join(), '-r', '6', ...options));
    assert.deepEqual(index.viewNeighborhood(point, 6, { seeds }).slice().sort(), found);
    assert.equal(index.count(point, 6, { seeds }), found.length);
    assert.ok(found.length > 20);
  }
});

for (const metric of ['straight', 'path', 'rings']) {
  test(`nested radii by ${metric} have the neighborhoods of each radius, each ring in index order`, () => {
    const place = new Uint32Array(vertices);
    index.permutation.forEach((v, i) => { place[v] = i; });
    const radii = Float64Array.of(0, 1.5, 2, 5.25);
    const { counts, ids } = index.nested(333, radii, { metric, walls, ignored });
    assert.equal(counts.length, 4);
    assert.equal(counts[3], ids.length);
    assert.ok(counts[0] < counts[1] && counts[2] < counts[3]);
    radii.forEach((radius, i) => {
      const expected = index.neighborhood(333, radius, { metric, walls, ignored, sort: 'id' });
      assert.deepEqual(ids.slice(0, counts[i]).sort(), expected);
      const ring = ids.slice(counts[i - 1] ?? 0, counts[i]);
      assert.deepEqual(ring, ring.slice().sort((a, b) => place[a] - place[b]));
    });
    assert.deepEqual(index.nested(333, new Float64Array(), { metric }), { counts: new Uint32Array(), ids: new Uint32Array() });
    for (const [wrong, message] of [[[2, 1], /value 1: radius 1, expected more than 2 before/], [[-1], /radius -1, expected a number >= 0/],
      [[1, NaN], /value 1/], [[NaN], /value 0/], [[1, 1], /value 1/]]) {
      assert.throws(() => index.nested(333, Float64Array.from(wrong), { metric }), { code: 'InvalidRadius', message });
    }
    const words = { metric, walls, ignored };
    const near = index.nearestConnected(333, 20, words);
    assert.deepEqual(near.radii, near.radii.slice().sort());
    near.ids.forEach((w, i) => {
      assert.equal(index.connectingRadius(333, w, words), near.radii[i]);
      assert.ok(index.contains(333, w, near.radii[i], words));
      if (near.radii[i] > 0) assert.ok(!index.contains(333, w, 0.999 * near.radii[i], words));
    });
    assert.deepEqual(near.ids, index.kNearest(20, { ...words, vertices: Uint32Array.of(333) }).ids);
    if (metric === 'rings') assert.throws(() => index.nested([0, 0, 0], radii, { metric }), { code: 'InvalidOption', message: /^start: / });
  });
}

test('connecting radii are those of the command line, and the least that contain the vertex', () => {
  const near = index.nearestConnected(333, 60);
  const printed = JSON.parse(meshhood('connect', 'roll.ply', '-v', '333', '--nearest', '60', '--json'));
  assert.deepEqual([...near.ids], printed.vertices);
  assert.deepEqual([...near.radii], printed.radii);
  near.ids.forEach((w, i) => assert.equal(index.connectingRadius(333, w), near.radii[i]));
  const w = near.ids[40];
  assert.ok(index.contains(333, w, near.radii[40]));
  assert.ok(!index.contains(333, w, 0.999 * near.radii[40]));
  assert.equal(index.connectingRadius(333, 334, { walls: mask([334]) }), Infinity);
});

test('the nearest vertex is that of a scan', () => {
  const next = random(9);
  for (let i = 0; i < 50; ++i) {
    const point = Float64Array.from({ length: 3 }, () => 20 * next() - 6);
    const all = Array.from({ length: vertices }, (_, w) => distance([...point, ...mesh.positions], 0, w + 1));
    const expected = Math.min(...all);
    assert.deepEqual(index.nearest(point), { vertex: all.indexOf(expected), distance: expected });
  }
});

test('no search crosses an edge that was cut', () => {
  const flat = grid(4, 4, (row, column) => [row, column, 0]);
  const around = Uint32Array.of(0, 1, 4, 0); // all edges of vertex 0
  const cut = build(flat, { cut: around });
  assert.deepEqual(cut.neighborhood(0, 10), Uint32Array.of(0));
  assert.equal(cut.count(1, 10), 15);
  assert.throws(() => build(flat, { cut: Uint32Array.of(0, 15) }), { code: 'InvalidOption', message: /not joined/ });
});

test('a refitted index answers as a new one', () => {
  const moved = mesh.positions.map((x, i) => x + 0.3 * Math.sin(i));
  const expected = build({ ...mesh, positions: moved });
  const expectSame = (refitted) => {
    for (const v of [0, 333, 1000]) {
      for (const method of ['exact', 'bfs', 'paper', 'ball']) {
        assert.deepEqual(
          refitted.neighborhood(v, 4, { sort: 'id', method }), expected.neighborhood(v, 4, { sort: 'id', method }));
      }
      const byPath = { metric: 'path', distances: true };
      assert.deepEqual(refitted.neighborhood(v, 4, byPath), expected.neighborhood(v, 4, byPath));
    }
  };
  const old = build(mesh);
  for (const method of ['exact', 'bfs', 'paper', 'ball']) old.neighborhood(0, 4, { method }); // what it makes is not kept
  old.neighborhood(0, 4, { metric: 'path' });
  const refitted = old.refit(moved);
  expectSame(refitted);
  assert.ok(refitted.quality().gain > 0.5);
  assert.deepEqual(refitted.refit(mesh.positions).save(), index.save());
  const some = Uint32Array.of(333, 334, 335);
  const partly = mesh.positions.slice();
  for (const v of some) partly.set(moved.subarray(3 * v, 3 * v + 3), 3 * v);
  const unread = moved.map((x, i) => (some.includes(Math.floor(i / 3)) ? x : NaN));
  assert.deepEqual(old.refit(unread, { changed: some }).save(), old.refit(partly).save());
  const wrong = moved.slice();
  wrong[30] = NaN;
  assert.throws(() => old.refit(wrong), { code: 'InvalidMesh', message: /vertex 10/ });
  assert.throws(() => old.refit(moved.subarray(3)), { code: 'InvalidMesh' });
  assert.throws(() => old.refit(moved, { changed: Uint32Array.of(vertices) }), { code: 'VertexOutOfRange' });
  assert.deepEqual(old.save(), index.save());
  assert.deepEqual(old.neighborhood(333, 4), index.neighborhood(333, 4));
  old.dispose();
  expectSame(refitted);
  assert.throws(() => old.refit(moved), /has been disposed/);
});

test('a refit in place gives the index that a refit gives, and keeps it after an error', () => {
  const moved = mesh.positions.map((x, i) => x + 0.3 * Math.sin(i));
  const moving = build(mesh);
  for (const method of ['exact', 'bfs', 'paper', 'ball']) moving.neighborhood(0, 4, { method }); // what it makes is not kept
  assert.equal(moving.refitInPlace(moved), undefined);
  const expected = build(mesh).refit(moved);
  assert.deepEqual(moving.save(), expected.save());
  const unread = moved.map((_, i) => (i < 9 ? i : NaN));
  const changed = Uint32Array.of(0, 1, 2);
  moving.refitInPlace(unread, { changed });
  const partly = expected.refit(unread, { changed });
  assert.deepEqual(moving.save(), partly.save());
  for (const method of ['exact', 'bfs', 'paper', 'ball']) {
    assert.deepEqual(moving.neighborhood(333, 4, { method }), partly.neighborhood(333, 4, { method }));
  }
  assert.throws(() => moving.refitInPlace(unread), { code: 'InvalidMesh', message: /vertex 3/ });
  assert.throws(() => moving.refitInPlace(moved, { changed: Uint32Array.of(vertices) }), { code: 'VertexOutOfRange' });
  assert.deepEqual(moving.save(), partly.save());
  assert.deepEqual(moving.neighborhood(333, 4), partly.neighborhood(333, 4));
});

test('an animation of refits in place needs no more memory after its first frames', () => {
  const moving = build(mesh);
  const changed = Uint32Array.of(333, 334, 335);
  let before = 0;
  for (let frame = 0; frame < 200; ++frame) {
    moving.refitInPlace(mesh.positions.map((x, i) => x + 0.1 * Math.sin(i + frame)), frame % 2 === 0 ? {} : { changed });
    moving.neighborhood(333, 4);
    if (frame === 5) before = moving.memoryBytes;
  }
  console.log(`${before} bytes after some frames, ${moving.memoryBytes} after 200`);
  assert.equal(moving.memoryBytes, before);
});

test('an animation of many refits needs no more memory than its first', () => {
  let moving = build(mesh).refit(mesh.positions);
  const before = moving.memoryBytes;
  for (let frame = 0; frame < 50; ++frame) {
    const next = moving.refit(mesh.positions.map((x, i) => x + 0.1 * Math.sin(i + frame)));
    moving.dispose();
    moving = next;
    moving.neighborhood(333, 4);
  }
  console.log(`${before} bytes after one refit, ${moving.memoryBytes} after 50 more`);
  assert.ok(moving.memoryBytes <= before + 2 ** 20);
});

test('the mesh and the rim of a region are those of the command line', () => {
  const ids = index.neighborhood(502, 5);
  meshhood('region', 'roll.ply', '-v', '502', '-r', '5', '-o', 'part.ply', '--arrays', 'part.npz');
  const expected = readArrays('part.npz');
  const faces = mesh;
  const part = index.submesh(ids, { faces });
  assert.deepEqual([...part.vertices], [...expected.vertices].map(Number));
  assert.deepEqual([...part.faces], [...expected.faces].map(Number));
  assert.equal(part.offsets, null);
  part.corners.forEach((corner, i) => {
    const [face, place] = [part.faces[Math.floor(i / 3)], i % 3];
    assert.equal(part.vertices[corner], mesh.corners[3 * face + place]);
    const at = 3 * part.vertices[corner];
    assert.deepEqual(part.positions.slice(3 * corner, 3 * corner + 3), mesh.positions.slice(at, at + 3));
  });
  const rim = index.rim(ids, 502, 5, { faces });
  assert.deepEqual(rim.flatMap((line) => [...line.points]), [...expected.rim_points]);
  assert.ok(rim.length > 0);
  for (const { points } of rim) {
    for (let i = 0; i < points.length; i += 3) {
      assert.ok(Math.abs(distance([...points.subarray(i, i + 3), ...mesh.positions], 0, 503) - 5) < 1e-9);
    }
  }
  index.count(502, 5, { metric: 'surface', faces, walls }); // masks and paths of another call
  assert.deepEqual(index.rim(ids, mesh.positions.subarray(3 * 502, 3 * 503), 5, { faces }), rim);
  assert.deepEqual(index.submesh(ids, { faces }), part);
});

test('a part of polygons keeps its polygons', () => {
  const mixed = polygons(40, 30);
  const part = build(mixed).submesh(Uint32Array.from({ length: 25 }, (_, v) => v), { corners: 'any', faces: mixed });
  assert.equal(part.offsets.length, part.faces.length + 1);
  part.faces.forEach((face, i) => {
    const own = part.corners.slice(part.offsets[i], part.offsets[i + 1]).map((corner) => part.vertices[corner]);
    assert.deepEqual(own, mixed.corners.slice(mixed.offsets[face], mixed.offsets[face + 1]));
  });
  assert.ok(part.faces.length > 5);
});

test('a part has offsets if the whole mesh has, also a part of triangles alone', () => {
  const positions = Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0);
  const house = { positions, corners: Uint32Array.of(0, 1, 2, 3, 1, 4, 2), offsets: Uint32Array.of(0, 4, 7) };
  const triangle = Uint32Array.of(1, 4, 2);
  assert.deepEqual([...build(house).submesh(triangle, { faces: house }).offsets], [0, 3]);
  for (const [whole, expected] of [[house, [0, 3]], [mesh, null]]) {
    write('whole.ply', toPly(whole));
    meshhood('build', 'whole.ply', '--faces', '-o', 'whole.mhi');
    const { offsets } = MeshIndex.load(read('whole.mhi')).submesh(triangle);
    assert.deepEqual(offsets && [...offsets], expected);
  }
});

test('wrong arguments of searches from starts give the errors of C++ and leave the index usable', () => {
  const refuse = (call, expected) => assert.throws(call, expected);
  refuse(() => index.neighborhood(vertices, 1), { code: 'VertexOutOfRange' });
  refuse(() => index.neighborhood([0, 0, NaN], 1), { code: 'InvalidOption', message: /coordinate 2 is nan/ });
  refuse(() => index.neighborhood([0, 0, 0], 1, { seeds: Uint32Array.of(vertices) }), { code: 'VertexOutOfRange' });
  refuse(() => index.neighborhood(1, 1, { seeds: Uint32Array.of(1) }), { code: 'InvalidOption', message: /^seeds/ });
  refuse(() => index.neighborhood(1, -1), { code: 'InvalidRadius' });
  refuse(() => index.neighborhood(1, 1, { walls: new Uint8Array(3) }), { message: /^walls: 3 values/ });
  refuse(() => index.neighborhood(1, 1, { walls: [1] }), TypeError);
  for (const [point, found] of [[[1, 2], '2 values'], [Uint32Array.of(1, 2, 3), 'Uint32Array'], [null, 'null']]) {
    const refusal = (name, expected) => ({ name: 'TypeError', message: `${name}: ${found}, expected ${expected}` });
    refuse(() => index.neighborhood(point, 1), refusal('start', 'a vertex or three numbers'));
    refuse(() => index.nearest(point), refusal('point', 'three numbers'));
  }
  refuse(() => index.neighborhood([0, 0, 0], 1, { method: 'bfs' }), { code: 'InvalidOption', message: /^start: / });
  refuse(() => index.count([0, 0, 0], 1, { metric: 'rings' }), { code: 'InvalidOption', message: /^start: / });
  refuse(() => index.count(1, 1, { seeds: Uint32Array.of(1) }), { code: 'InvalidOption', message: /^seeds/ });
  refuse(() => index.contains(1, vertices, 1), { code: 'VertexOutOfRange' });
  refuse(() => new MeshIndex(new Float32Array(), new Uint32Array()).nearest([0, 0, 0]), { code: 'VertexOutOfRange' });
  const [faces, one] = [mesh, Uint32Array.of(1)];
  refuse(() => index.submesh(one, { faces: { corners: Uint32Array.of(0, 1, vertices) } }), { code: 'InvalidMesh' });
  refuse(() => index.submesh(Uint32Array.of(vertices), { faces }), { code: 'VertexOutOfRange', message: /position 0/ });
  refuse(() => index.submesh(one, { faces, corners: 'one' }), { code: 'InvalidOption', message: /^corners: 'one'/ });
  refuse(() => index.rim(one, vertices, 1, { faces }), { code: 'VertexOutOfRange' });
  refuse(() => index.rim(one, 1, -1, { faces }), { code: 'InvalidRadius' });
  assert.deepEqual(index.neighborhood(7, 2), build(mesh).neighborhood(7, 2));
});

test('a point farther from the mesh than the radius causes one warning for each index', (context) => {
  const warn = context.mock.method(console, 'warn', () => {});
  const { positions, corners } = grid(5, 5, (row, column) => [row, column, 0]);
  const near = new MeshIndex(positions, corners);
  assert.equal(near.neighborhood([2, 2, 3], 3).length, 1);
  const walls = new Uint8Array(25).fill(1);
  assert.equal(near.neighborhood([2, 2, 3], 3, { walls, seeds: Uint32Array.of(12) }).length, 0);
  assert.throws(() => near.neighborhood([2, 2, 3], 3, { walls }), { code: 'VertexOutOfRange', message: /all vertices .* are walls/ });
  assert.equal(warn.mock.callCount(), 0);
  assert.equal(near.neighborhood([2, 2, 3], 2.9).length, 0);
  assert.equal(near.nested([2, 2, 3], Float64Array.of(1, 2.9)).ids.length, 0);
  assert.equal(warn.mock.callCount(), 1);
  assert.match(warn.mock.calls[0].arguments[0], /farther than the radius/);
  new MeshIndex(positions, corners).nested([2, 2, 3], Float64Array.of(1, 2.9));
  assert.equal(warn.mock.callCount(), 2);
});
