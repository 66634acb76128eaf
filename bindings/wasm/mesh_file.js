// SPDX-License-Identifier: MIT
import { PROGRESS, choose, expectBytes, expectString, withDefaults } from './arguments.js';
import { Instance } from './instance.js';

const FORMATS = ['ply', 'obj', 'off', 'stl', 'vtk', 'freesurfer'];
const PRECISIONS = ['file', 'float', 'double'];

const READING = { precision: 'file', strict: false, ...PROGRESS };

export function readMesh(bytes, name, options = {}) {
  const { precision, strict, progress } = withDefaults(options, READING);
  const content = expectBytes(bytes, 'bytes');
  expectString(name, 'name');
  const place = choose(PRECISIONS, precision, 'precision');
  const encoded = new TextEncoder().encode(name);
  const instance = new Instance();
  try {
    instance.with([content, encoded], (file, text) => instance.callWithProgress(
      progress, 'read_mesh', file, content.length, text, encoded.length, place, strict));
    return takeMesh(instance);
  } finally {
    instance.dispose();
  }
}

/** Those of the mesh in the memory of the module. */
export function takePositions(instance) {
  return instance.takeArray(instance.call('mesh_is_double') ? Float64Array : Float32Array, 'mesh_positions');
}

function takeMesh(instance) {
  const { ids, counts } = instance.takeAnswer();
  const walls = instance.takeArray(Uint8Array, 'mesh_walls');
  const warnings = instance.takeArray(Uint8Array, 'mesh_warnings');
  return {
    format: FORMATS[instance.call('mesh_format')],
    positions: takePositions(instance),
    corners: ids,
    offsets: counts.length === 0 ? null : counts,
    walls: walls.length === 0 ? null : walls,
    warnings: new TextDecoder().decode(warnings).split('\n').filter((line) => line !== ''),
  };
}
