// SPDX-License-Identifier: MIT
// From a mesh to what is drawn: triangles, positions near the origin, smooth normals.
import type { Surface } from './messages';

type Reals = Float32Array | Float64Array;

/** Polygons as fans of triangles. A copy in any case: the tree of the picture sorts it, and the page gets it. */
export function triangulate(corners: Uint32Array, offsets: Uint32Array | null): Uint32Array {
  if (offsets === null) return corners.slice();
  const faces = Math.max(offsets.length - 1, 0);
  const sides = (face: number) => offsets[face + 1] - offsets[face];
  let count = 0;
  for (let face = 0; face < faces; ++face) count += Math.max(sides(face) - 2, 0);
  const triangles = new Uint32Array(3 * count);
  let end = 0;
  for (let face = 0; face < faces; ++face) {
    const first = offsets[face];
    for (let i = 2; i < sides(face); ++i) {
      triangles[end++] = corners[first];
      triangles[end++] = corners[first + i - 1];
      triangles[end++] = corners[first + i];
    }
  }
  return triangles;
}

function boundingBox(positions: Reals): { low: number[]; high: number[] } {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3) {
    for (let axis = 0; axis < 3; ++axis) {
      const x = positions[i + axis];
      if (x < low[axis]) low[axis] = x;
      if (x > high[axis]) high[axis] = x;
    }
  }
  return { low, high };
}

/** The sum of the normals of the triangles around each vertex, weighted by area, of length 1. */
function smoothNormals(p: Float32Array, triangles: Uint32Array): Float32Array {
  const normals = new Float32Array(p.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) {
      normals[corner] += x;
      normals[corner + 1] += y;
      normals[corner + 2] += z;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let axis = 0; axis < 3; ++axis) normals[i + axis] /= length;
  }
  return normals;
}

export function makeSurface(positions: Reals, corners: Uint32Array, offsets: Uint32Array | null): Surface {
  const { low, high } = boundingBox(positions);
  const isEmpty = positions.length === 0;
  const center = low.map((x, axis) => (isEmpty ? 0 : x / 2 + high[axis] / 2));
  const extent = isEmpty ? 1 : Math.hypot(...high.map((x, axis) => x - low[axis])) / 2 || 1;
  const unit = 2 ** Math.floor(Math.log2(extent));
  const relative = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; ++i) relative[i] = (positions[i] - center[i % 3]) / unit;
  const triangles = triangulate(corners, offsets);
  return { positions: relative, normals: smoothNormals(relative, triangles), triangles, unit, extent: extent / unit };
}
