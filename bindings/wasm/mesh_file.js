// SPDX-License-Identifier: MIT
import { PROGRESS, choose, expectBytes, withDefaults } from './arguments.js';
import { Instance } from './instance.js';

const FORMATS = ['ply', 'obj', 'off', 'stl', 'vtk', 'freesurfer'];
const PRECISIONS = ['file', 'float', 'double'];

const READING = { precision: 'file', strict: false, ...PROGRESS };

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
  const Reals = instance.call('mesh_is_double') ? Float64Array : Float32Array;
  const { ids, counts } = instance.takeAnswer();
  const walls = instance.takeArray(Uint8Array, 'mesh_walls');
  const warnings = instance.takeArray(Uint8Array, 'mesh_warnings');
  return {
    format: FORMATS[instance.call('mesh_format')],
    positions: instance.takeArray(Reals, 'mesh_positions'),
    corners: ids,
    offsets: counts.length === 0 ? null : counts,
    walls: walls.length === 0 ? null : walls,
    warnings: new TextDecoder().decode(warnings).split('\n').filter((line) => line !== ''),
  };
}
