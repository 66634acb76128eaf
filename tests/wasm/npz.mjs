// SPDX-License-Identifier: MIT
import { inflateRawSync } from 'node:zlib';

const TYPES = {
  '<f8': Float64Array, '<f4': Float32Array, '<i4': Int32Array, '<u4': Uint32Array, '<i8': BigInt64Array,
  '<u8': BigUint64Array, '|u1': Uint8Array,
};

function readArray(npy) {
  const size = npy.readUInt16LE(8);
  const type = /'descr': '([^']+)'/.exec(npy.toString('latin1', 10, 10 + size))[1];
  const Type = TYPES[type] ?? Uint8Array; // the bytes of a text
  return new Type(new Uint8Array(npy.subarray(10 + size)).buffer);
}

/** The arrays of an NPZ file that the command line has written, by their names. */
export function arraysOf(zip) {
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
