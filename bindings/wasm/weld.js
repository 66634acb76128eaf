// SPDX-License-Identifier: MIT
import { expectNumber, withDefaults, withMesh } from './arguments.js';
import { Instance } from './instance.js';
import { takePositions } from './mesh_file.js';

export function weld(positions, corners, options = {}) {
  const { offsets, eps } = withDefaults(options, { offsets: null, eps: 0 });
  expectNumber(eps, 'eps');
  const instance = new Instance();
  try {
    withMesh(instance, positions, { corners, offsets }, () => instance.call('weld', eps));
    return {
      positions: takePositions(instance),
      corners: instance.takeCounts(),
      offsets: offsets === null ? null : Uint32Array.from(offsets),
      ids: instance.takeIds(),
    };
  } finally {
    instance.dispose();
  }
}
