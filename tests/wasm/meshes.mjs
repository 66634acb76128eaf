// SPDX-License-Identifier: MIT
// Meshes by formula. Shares no code with the library.

/** Random numbers in [0, 1), the same on every machine (xorshift). */
export function random(seed) {
  let state = seed >>> 0 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}

/** A grid of triangles; `place(row, column)` gives the position of a vertex. */
export function grid(rows, columns, place, Reals = Float32Array) {
  const positions = new Reals(3 * rows * columns);
  const corners = [];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      const v = row * columns + column;
      positions.set(place(row, column), 3 * v);
      if (row === 0 || column === 0) continue;
      corners.push(v - columns - 1, v - columns, v - 1, v - 1, v - columns, v);
    }
  }
  return { positions, corners: Uint32Array.from(corners), offsets: null };
}

/** A rolled sheet whose layers are nearer to each other than its edges are long. */
export function roll(rows, columns, Reals) {
  let angle = 0;
  const spiral = Array.from({ length: rows }, () => {
    const radius = 3 + 0.12 * angle;
    angle += 1 / radius;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
  return grid(rows, columns, (row, column) => [...spiral[row], column], Reals);
}

/** Two separate plates, the upper one bumpy. */
export function plates(side) {
  const next = random(7);
  return grid(2 * side, side, (row, column) => [row % side, column, row < side ? 0 : 0.4 + 0.3 * next()], Float64Array);
}

/** Polygons of 3 to 7 corners among random points; not manifold, with isolated vertices. */
export function polygons(vertices, faces) {
  const next = random(11);
  const positions = Float64Array.from({ length: 3 * vertices }, () => 10 * next());
  const corners = [];
  const offsets = [0];
  for (let face = 0; face < faces; ++face) {
    const size = 3 + Math.floor(5 * next());
    for (let i = 0; i < size; ++i) corners.push(Math.floor(vertices * next()));
    offsets.push(corners.length);
  }
  return { positions, corners: Uint32Array.from(corners), offsets: Uint32Array.from(offsets) };
}

export function distance(positions, v, w) {
  const [x, y, z] = [0, 1, 2].map((axis) => positions[3 * v + axis] - positions[3 * w + axis]);
  return Math.sqrt(x * x + y * y + z * z);
}

/** An ASCII PLY file. */
export function toPly({ positions, corners, offsets }) {
  const faces = offsets === null ? corners.length / 3 : offsets.length - 1;
  const lines = ['ply', 'format ascii 1.0', `element vertex ${positions.length / 3}`];
  for (const axis of 'xyz') lines.push(`property ${positions instanceof Float64Array ? 'double' : 'float'} ${axis}`);
  lines.push(`element face ${faces}`, 'property list uchar int vertex_indices', 'end_header');
  for (let v = 0; v < positions.length; v += 3) lines.push(positions.subarray(v, v + 3).join(' '));
  for (let face = 0; face < faces; ++face) {
    const [begin, end] = offsets === null ? [3 * face, 3 * face + 3] : [offsets[face], offsets[face + 1]];
    lines.push([end - begin, ...corners.subarray(begin, end)].join(' '));
  }
  return new TextEncoder().encode(`${lines.join('\n')}\n`);
}
