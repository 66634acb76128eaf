// SPDX-License-Identifier: MIT
// The words of every call on many vertices: which rows, their radii, and what the searches may pass.
import { choose, expectForVertices, expectType, expectVertices, refuseType, toReals, withFaces } from './arguments.js';
import { MeshhoodError } from './instance.js';

// Options with their defaults.
export const MASKS = { walls: null, ignored: null };
export const METRIC = { metric: 'straight', faces: null };
export const ROWS = { vertices: null, ...METRIC, ...MASKS, unit: 'mesh' };
export const SCALED_ROWS = { ...ROWS, scales: null };

// The places are those of MetricName.
export const METRICS = ['straight', 'path', 'rings', 'space', 'surface'];

/** Makes the surface of these faces, or of those that the index holds, unless it is that of the last call. */
export function useFaces(instance, faces) {
  withFaces(instance, faces, () => instance.call('use_faces'));
}

const isMissing = (value) => value === null || value === undefined;

/**
 * `r` is a radius, or one for each row; or null, with `scales` for all rows. A call that takes no scales has undefined.
 * `unit` is a factor.
 */
function readRadius(r, scales, unit) {
  const areScales = !isMissing(scales);
  if (areScales && !isMissing(r)) refuseType(r, 'r', 'null with scales');
  if (scales === null && isMissing(r)) {
    refuseType(r, 'r', 'a radius, or one for each row; or null, and several radii for all rows as scales');
  }
  if (typeof r === 'number') return { common: unit * r, list: null, areScales };
  const list = areScales ? toReals(scales, 'scales') : toReals(r, 'r', 'a number or a typed array of numbers');
  return { common: 0, list: list.map((radius) => unit * radius), areScales };
}

function readMask(instance, mask, name) {
  if (isMissing(mask)) return null;
  return expectForVertices(expectType(mask, [Uint8Array], name), name, instance.call('vertex_count') >>> 0);
}

/** Calls `use` when the module searches by the metric and with the masks. */
export function withMasks(instance, given, use) {
  const { metric = 'straight', faces = null, unit = 'mesh' } = given;
  const place = choose(METRICS, metric, 'metric');
  if (metric === 'rings' && unit === 'edge') {
    throw new MeshhoodError('InvalidOption', "unit: 'edge', but with metric 'rings' the radius is a number of edges");
  }
  const walls = readMask(instance, given.walls, 'walls');
  const ignored = readMask(instance, given.ignored, 'ignored');
  if (metric === 'surface') useFaces(instance, faces);
  return instance.with([walls, ignored], (wallMask, ignoredMask) => {
    instance.call('search_by', place, wallMask, walls?.length ?? 0, ignoredMask, ignored?.length ?? 0);
    return use();
  });
}

/** The same for rows, which are then those of the call. `scale` is that of the unit. */
export function withRows(instance, r, given, scale, use) {
  const vertices = expectVertices(given.vertices, 'vertices');
  const { common, list, areScales } = readRadius(r, given.scales, scale);
  return withMasks(instance, given, () => instance.with([vertices, list], (ids, radii) => {
    instance.call('use_rows', ids, vertices?.length ?? 0, common, radii, list?.length ?? 0, areScales);
    return use();
  }));
}
