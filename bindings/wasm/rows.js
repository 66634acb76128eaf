// SPDX-License-Identifier: MIT
// The words of every call on many vertices: which rows, their radii, and what the searches may pass.
import { expectType, expectVertices, toReals } from './arguments.js';

// Options with their defaults.
export const MASKS = { walls: null, ignored: null };
export const ROWS = { scales: null, ...MASKS };

/** `r` is a radius, or one for each row; or null, with `scales` for all rows. `unit` is a factor. */
function readRadius(r, scales, unit) {
  if ((r === null || r === undefined) === (scales === null)) {
    throw new TypeError('r: expected a radius, or one for each row; or null, and several radii for all rows as scales');
  }
  if (typeof r === 'number') return { common: unit * r, list: null };
  const list = scales === null ? toReals(r, 'r') : toReals(scales, 'scales');
  return { common: 0, list: list.map((radius) => unit * radius) };
}

/** Calls `use` while the masks are in the memory of the module, and restrict its searches. */
export function withMasks(instance, { walls, ignored }, use) {
  for (const [mask, name] of [[walls, 'walls'], [ignored, 'ignored']]) {
    if (mask !== null) expectType(mask, [Uint8Array], name);
  }
  return instance.with([walls, ignored], (wallMask, ignoredMask) => {
    instance.call('restrict_search', wallMask, walls?.length ?? 0, ignoredMask, ignored?.length ?? 0);
    return use();
  });
}

/** The same for rows. `use` gets the six arguments that describe them; `vertices` is null for all. */
export function withRows(instance, vertices, r, { scales = null, walls, ignored }, unit, use) {
  expectVertices(vertices, 'vertices');
  const { common, list } = readRadius(r, scales, unit);
  return withMasks(instance, { walls, ignored }, () => instance.with([vertices, list], (ids, radii) =>
    use(ids, vertices?.length ?? 0, common, radii, list?.length ?? 0, scales !== null)));
}
