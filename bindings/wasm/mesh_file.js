// SPDX-License-Identifier: MIT
import { choose, expectBytes, withDefaults } from './arguments.js';
import { Instance } from './instance.js';

const FORMATS = ['ply', 'obj', 'off', 'stl'];
const PRECISIONS = ['file', 'float', 'double'];

const READING = { precision: 'file', strict: false, progress: undefined };

export function readMesh(bytes, name, options = {}) {
  const { precision, strict, progress } = withDefaults(options, READING);
  expectBytes(bytes, 'bytes');
  const place = choose(PRECISIONS, precision, 'precision');
  const encoded = new TextEncoder().encode(name);
  const instance = new Instance();
  try {
    instance.with([bytes, encoded], (file, text) => instance.callWithProgress(
      progress, 'read_mesh', file, bytes.byteLength, text, encoded.length, place, strict));
    return takeMesh(instance);
  } finally {
    instance.dispose();
  }
}

function takeMesh(instance) {
  const take = (Type, address, count) => instance.take(Type, instance.call(address), instance.call(count));
  const Reals = instance.call('mesh_is_double') ? Float64Array : Float32Array;
  const { ids, counts } = instance.takeAnswer();
  const walls = take(Uint8Array, 'mesh_walls', 'mesh_wall_count');
  const warnings = instance.call('mesh_warnings');
  return {
    format: FORMATS[instance.call('mesh_format')],
    positions: take(Reals, 'mesh_positions', 'mesh_scalar_count'),
    corners: ids,
    offsets: counts.length === 0 ? null : counts,
    walls: walls.length === 0 ? null : walls,
    warnings: instance.text(warnings, instance.call('warnings_size')).split('\n').filter((line) => line !== ''),
  };
}
