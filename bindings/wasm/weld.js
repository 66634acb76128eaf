// SPDX-License-Identifier: MIT
import { expectNumber, withDefaults, withMesh } from './arguments.js';
import { Instance } from './instance.js';

/** The position of the first vertex of each id. */
function keptPositions(positions, ids) {
  const kept = new positions.constructor(positions.length);
  let count = 0;
  ids.forEach((id, v) => {
    if (id === count) kept.set(positions.subarray(3 * v, 3 * v + 3), 3 * count++);
  });
  return kept.slice(0, 3 * count);
}

export function weld(positions, corners, options = {}) {
  const { offsets, eps } = withDefaults(options, { offsets: null, eps: 0 });
  expectNumber(eps, 'eps');
  const instance = new Instance();
  try {
    withMesh(instance, positions, { corners, offsets }, () => instance.call('weld', eps));
    const ids = instance.takeIds();
    return {
      positions: keptPositions(positions, ids),
      corners: instance.takeCounts(),
      offsets: offsets === null ? null : Uint32Array.from(offsets),
      ids,
    };
  } finally {
    instance.dispose();
  }
}
