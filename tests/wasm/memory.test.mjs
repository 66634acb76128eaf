// SPDX-License-Identifier: MIT
// Memory that is out in each call of the package: an error that says so, after which the object is disposed, or the
// right answer. The module may have 8 MiB here, of which a call finds a hole of some bytes, and larger ones until it
// succeeds.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { plates, toPly } from './meshes.mjs';
import { build, library, meshhood, read, write } from './setup.mjs';

const { MeshIndex, initialize, readMesh, weld } = library;

const MEMORY_SECTION = 5;
const HAS_MAXIMUM = 1;
const PAGES = 127;

/** Reads an unsigned LEB128 number. Returns it with the place after it. */
function readNumber(bytes, at) {
  let number = 0;
  for (let shift = 0; ; shift += 7) {
    number |= (bytes[at] & 0x7f) << shift;
    if (bytes[at++] < 0x80) return [number, at];
  }
}

/** The module, whose memory may have no more than `PAGES`. */
function limited(bytes) {
  for (let at = 8; at < bytes.length;) {
    const section = bytes[at];
    const [size, begin] = readNumber(bytes, at + 1);
    if (section === MEMORY_SECTION) {
      const [initial, end] = readNumber(bytes, begin + 2);
      assert.equal(bytes[begin + 1] & HAS_MAXIMUM, HAS_MAXIMUM);
      assert.ok(initial < PAGES); // which is one byte
      return Buffer.concat([
        bytes.subarray(0, at), Buffer.of(section, end + 1 - begin), bytes.subarray(begin, end), Buffer.of(PAGES),
        bytes.subarray(begin + size)]);
    }
    at = begin + size;
  }
  throw new Error('the module has no memory');
}

/** The exports of the last instance, and the hole that a new one begins with; null for all of its memory. */
let made = null;
let hole = null;

const { Instance } = WebAssembly;
WebAssembly.Instance = function LimitedInstance(module, imports) {
  const { exports } = new Instance(module, imports);
  const start = () => {
    exports.start();
    made = exports;
    if (hole !== null) fill(exports, hole);
  };
  return { exports: { ...exports, start } };
};

/** Takes all memory but one hole of so many bytes, and what is between the blocks. */
function fill(exports, bytes) {
  const stack = exports.__stack_pointer;
  const top = stack.value;
  const left = exports.allocate(bytes);
  for (let size = 2 ** 16; size > 64; size /= 2) {
    try {
      for (;;) exports.allocate(size - 64);
    } catch {
      stack.value = top;
    }
  }
  exports.release(left);
}

await initialize(limited(readFileSync(join(process.env.MESHHOOD_PACKAGE, 'meshhood.wasm'))));

const mesh = plates(20);
const { positions, corners } = mesh;
const heights = positions.filter((_, i) => i % 3 === 2);
const moved = positions.map((x) => 1.01 * x);
const ids = Uint32Array.from({ length: 300 }, (_, v) => v);
write('mesh.ply', toPly(mesh));
meshhood('build', 'mesh.ply', '--faces', '-o', 'mesh.mhi');
const file = read('mesh.mhi'); // with faces
const onFaces = { faces: mesh };

/** Calls that make an instance of their own. */
const MAKING = {
  readMesh: () => readMesh(toPly(mesh), 'mesh.ply'),
  weld: () => weld(positions, corners),
  MeshIndex: () => build(mesh).vertexCount,
  load: () => MeshIndex.load(file).vertexCount,
};

const OF_INDEX = {
  save: (index) => index.save(),
  byteLength: (index) => index.byteLength,
  meanEdgeLength: (index) => index.meanEdgeLength,
  faces: (index) => index.faces,
  positions: (index) => index.positions,
  permutation: (index) => index.permutation,
  refit: (index) => index.refit(moved).neighborhood(5, 4),
  refitInPlace: (index) => (index.refitInPlace(moved), index.neighborhood(5, 4)),
  quality: (index) => index.quality(),
  neighborhood: (index) => index.neighborhood(5, 6, { distances: true }),
  viewNeighborhood: (index) => index.viewNeighborhood(5, 6).slice(),
  count: (index) => index.count(5, 6, { method: 'bfs' }),
  nested: (index) => index.nested(5, Float64Array.of(2, 6)),
  contains: (index) => index.contains(5, 46, 3),
  connectingRadius: (index) => index.connectingRadius(5, 300),
  nearestConnected: (index) => index.nearestConnected(5, 60),
  nearest: (index) => index.nearest([3, 3, 1]),
  closestPoint: (index) => index.closestPoint([3, 3, 1], onFaces),
  firstHit: (index) => index.firstHit([3.2, 3.3, 9], [0, 0, -1], onFaces),
  neighborhoods: (index) => index.neighborhoods(3),
  counts: (index) => index.counts(3),
  kNearest: (index) => index.kNearest(9),
  discs: (index) => index.discs(9, onFaces),
  nearestUnconnected: (index) => index.nearestUnconnected(3),
  invariants: (index) => index.invariants(2, onFaces),
  gaps: (index) => index.gaps(2, onFaces),
  patch: (index) => index.patch(5, 2, onFaces),
  clip: (index) => index.clip(5, 2, onFaces),
  measure: (index) => index.measure(5, 2, onFaces),
  gap: (index) => index.gap(5, 2, onFaces),
  submesh: (index) => index.submesh(ids, onFaces),
  rim: (index) => index.rim(ids, 150, 40, onFaces),
  aggregate: (index) => index.aggregate(heights, 3),
  smooth: (index) => index.smooth(heights, 3),
  curvature: (index) => index.curvature(3, onFaces),
  features: (index) => index.features(3, { ...onFaces, kinds: 'mean' }),
  thickness: (index) => index.thickness(onFaces),
};

/** Calls that need no memory, or no more than is left between blocks. */
const WITHOUT_MEMORY = ['byteLength', 'permutation', 'nearest'];

/** How often the call fails, each time with another object of `make`, until it answers as with all memory. */
function failures(call, make) {
  const right = call(make());
  for (let bytes = 0, failed = 0; ; bytes = Math.max(256, 2 * bytes), ++failed) {
    assert.ok(bytes < PAGES * 2 ** 16, `no answer, though ${bytes / 2} bytes are left`);
    const object = make();
    try {
      if (object === undefined) hole = bytes;
      else fill(made, bytes);
      assert.deepEqual(call(object), right);
      return failed;
    } catch (error) {
      if (error.code !== 'TooLarge') throw error;
      assert.equal(error.message, 'not enough memory');
      // A refit fails in its copy, and leaves the index.
      assert.ok(object === undefined || object.memoryBytes === 0 || call === OF_INDEX.refit);
    } finally {
      hole = null;
    }
  }
}

function testAll(calls, make) {
  for (const [name, call] of Object.entries(calls)) {
    test(`${name} fails by an error where memory is out`, () => {
      const failed = failures(call, make);
      console.log(`${name}: ${failed} failures`);
      assert.equal(failed === 0, WITHOUT_MEMORY.includes(name));
    });
  }
}

testAll(MAKING, () => undefined);
testAll(OF_INDEX, () => MeshIndex.load(file));

test('an instance for which there are no addresses left is an error, too', () => {
  const { Instance: limitedInstance } = WebAssembly;
  const cause = new RangeError('WebAssembly.Instance(): Out of memory: Cannot allocate Wasm memory for new instance');
  WebAssembly.Instance = function FullInstance() {
    throw cause;
  };
  try {
    for (const call of Object.values(MAKING)) {
      assert.throws(call, { name: 'MeshhoodError', code: 'TooLarge', message: 'not enough memory', cause });
    }
  } finally {
    WebAssembly.Instance = limitedInstance;
  }
});

test('a result for which the engine has no memory is an error, too, and the index lives', () => {
  const index = MeshIndex.load(file);
  const { prototype } = Object.getPrototypeOf(Uint8Array);
  const { slice } = prototype;
  const cause = new RangeError('Array buffer allocation failed');
  const copies = ['save', 'faces', 'positions', 'permutation', 'neighborhood', 'neighborhoods', 'counts'];
  prototype.slice = () => {
    throw cause;
  };
  try {
    for (const name of copies) {
      assert.throws(() => OF_INDEX[name](index), { code: 'TooLarge', message: 'not enough memory', cause }, name);
    }
  } finally {
    prototype.slice = slice;
  }
  for (const name of copies) assert.deepEqual(OF_INDEX[name](index), OF_INDEX[name](MeshIndex.load(file)));
});

test('no call is left out', () => {
  const methods = (type) => Object.getOwnPropertyNames(type.prototype).filter((name) => name !== 'constructor');
  assert.deepEqual(Object.keys(OF_INDEX), methods(MeshIndex).filter((name) => name !== 'vertexCount'));
  const functions = Object.keys(library).filter((name) => !['MeshhoodError', 'Curvature', 'initialize', 'version'].includes(name));
  assert.deepEqual(Object.keys(MAKING).filter((name) => name !== 'load').sort(), functions.sort());
});
