// SPDX-License-Identifier: MIT
// The package and the command line. MESHHOOD_PACKAGE is the folder of the package, MESHHOOD_CLI the command line.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';
import { pathToFileURL } from 'node:url';
import { inflateRawSync } from 'node:zlib';

export const library = await import(pathToFileURL(join(process.env.MESHHOOD_PACKAGE, 'meshhood.js')));

const folder = mkdtempSync(join(tmpdir(), 'meshhood-'));
after(() => rmSync(folder, { recursive: true }));

/** Runs the command line in a folder of this test. */
export const meshhood = (...options) =>
  execFileSync(process.env.MESHHOOD_CLI, options, { cwd: folder, encoding: 'utf8', stdio: 'pipe' });
export const write = (name, content) => writeFileSync(join(folder, name), content);
export const read = (name) => readFileSync(join(folder, name));

export const build = (mesh, options) =>
  new library.MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets, ...options });

/** `count` times $MESHHOOD_TEST_SCALE, as in the tests of the library. */
export const scaled = (count) => Math.round(count * Number(process.env.MESHHOOD_TEST_SCALE ?? 1));

const TYPES = { '<f8': Float64Array, '<f4': Float32Array, '<i4': Int32Array, '<u4': Uint32Array, '<i8': BigInt64Array,
  '<u8': BigUint64Array, '|u1': Uint8Array };

function readArray(npy) {
  const size = npy.readUInt16LE(8);
  const type = /'descr': '([^']+)'/.exec(npy.toString('latin1', 10, 10 + size))[1];
  return new TYPES[type](new Uint8Array(npy.subarray(10 + size)).buffer);
}

/** The arrays of an NPZ file that the command line has written. */
export function readArrays(name) {
  const zip = read(name);
  const arrays = {};
  const end = zip.lastIndexOf('PK\x05\x06');
  for (let i = 0, at = zip.readUInt32LE(end + 16); i < zip.readUInt16LE(end + 10); ++i) {
    const [method, bytes, nameSize] = [zip.readUInt16LE(at + 10), zip.readUInt32LE(at + 20), zip.readUInt16LE(at + 28)];
    const local = zip.readUInt32LE(at + 42);
    const begin = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
    const content = zip.subarray(begin, begin + bytes);
    arrays[zip.toString('utf8', at + 46, at + 46 + nameSize).replace(/\.npy$/, '')] =
      readArray(method === 0 ? content : inflateRawSync(content));
    at += 46 + nameSize + zip.readUInt16LE(at + 30) + zip.readUInt16LE(at + 32);
  }
  return arrays;
}
