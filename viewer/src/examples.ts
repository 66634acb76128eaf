// SPDX-License-Identifier: MIT
// Meshes by formula. Edges have a length of about 1.
import type { Cut } from './view';

export interface ExampleMesh {
  positions: Float32Array;
  corners: Uint32Array;
}

export interface Example {
  name: string;
  title: string;
  /** Why a search may fail on it. */
  trap: string;
  make(vertices: number): ExampleMesh;
  vertices: number;
  query: FirstQuery;
}

/** A query that shows the trap, and how to look at it. */
export interface FirstQuery {
  /** The vertex, as a fraction of all. */
  at: number;
  /** In mean edge lengths. */
  radius: number;
  cut?: Cut;
  /** Where the camera is, seen from the vertex; along its normal if absent. */
  from?: Point;
}

export type Point = [number, number, number];

/** A sheet of triangles, row by row; `wrap` joins the last column with the first, `close` the last row with the first. */
function sheet(rows: number, columns: number, place: (row: number, column: number) => Point, wrap = false, close = false) {
  const positions = new Float32Array(3 * rows * columns);
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      positions.set(place(row, column), 3 * (row * columns + column));
    }
  }
  const [lastRow, lastColumn] = [close ? rows : rows - 1, wrap ? columns : columns - 1];
  const corners = new Uint32Array(6 * lastRow * lastColumn);
  let end = 0;
  for (let row = 0; row < lastRow; ++row) {
    for (let column = 0; column < lastColumn; ++column) {
      const at = (r: number, c: number) => ((row + r) % rows) * columns + ((column + c) % columns);
      corners.set([at(0, 0), at(1, 0), at(0, 1), at(0, 1), at(1, 0), at(1, 1)], end);
      end += 6;
    }
  }
  return { positions, corners };
}

/** A sheet rolled up nine times as long as it is wide; its layers are 2.5 apart. The scroll of the command line. */
function scroll(vertices: number): ExampleMesh {
  const columns = Math.max(2, Math.floor(Math.sqrt(vertices / 9)));
  const spiral: [number, number][] = [];
  for (let row = 0, turns = 0; row < Math.floor(vertices / columns); ++row) {
    const radius = 6 + 2.5 * turns;
    spiral.push([radius * Math.cos(2 * Math.PI * turns), radius * Math.sin(2 * Math.PI * turns)]);
    turns += 1 / Math.sqrt((2 * Math.PI * radius) ** 2 + 2.5 ** 2);
  }
  return sheet(spiral.length, columns, (row, column) => [...spiral[row], column] as Point);
}

/** An accordion: walls with narrow gaps between them, joined alternately at the top and at the bottom. */
function folds(vertices: number): ExampleMesh {
  const columns = Math.max(2, Math.floor(Math.sqrt(vertices / 4)));
  const rows = Math.floor(vertices / columns);
  const height = Math.max(2, Math.floor(Math.sqrt(rows)));
  return sheet(rows, columns, (row, column) => {
    const wall = Math.floor(row / (height + 1));
    const step = row - wall * (height + 1);
    return [1.5 * wall, column, wall % 2 === 0 ? step : height - step];
  });
}

/** A closed tube along a trefoil knot; its strands come close to each other. */
function knot(vertices: number): ExampleMesh {
  const columns = Math.max(6, Math.round(Math.sqrt(vertices / 12)));
  const rows = Math.max(12, Math.round(vertices / columns));
  const thickness = columns / (2 * Math.PI);
  const scale = 1.75 * thickness;
  const curve = (t: number): Point => [
    scale * (Math.sin(t) + 2 * Math.sin(2 * t)),
    scale * (Math.cos(t) - 2 * Math.cos(2 * t)),
    -scale * Math.sin(3 * t),
  ];
  return sheet(rows, columns, (row, column) => {
    const t = (2 * Math.PI * row) / rows;
    const [center, next] = [curve(t), curve(t + 1e-3)];
    const tangent = unit(subtract(next, center));
    const side = unit(cross(tangent, [Math.sin(t), Math.cos(t), 2]));
    const up = cross(tangent, side);
    const angle = (-2 * Math.PI * column) / columns;
    return center.map((x, axis) => x + thickness * (Math.cos(angle) * side[axis] + Math.sin(angle) * up[axis])) as Point;
  }, true, true);
}

/** Hills with a gorge between them, deeper than it is wide. */
function terrain(vertices: number): ExampleMesh {
  const columns = Math.max(2, Math.floor(Math.sqrt(vertices)));
  const [frequency, depth, width] = [(4 * Math.PI) / columns, columns / 8, columns / 40];
  const rim = columns / 2 - depth - width / 2; // the row above one wall; the rows go down it, over the floor, and up the other
  return sheet(columns, columns, (row, column) => {
    const inGorge = Math.min(Math.max(row - rim, 0), 2 * depth + width);
    const fromWall = Math.min(inGorge, 2 * depth + width - inGorge);
    const x = row - inGorge + Math.max(0, Math.min(inGorge - depth, width));
    const hills = Math.sin(frequency * x) * Math.cos(0.8 * frequency * column) + 0.4 * Math.sin(2.3 * frequency * column);
    return [x + 2 * width * Math.sin(0.75 * frequency * column), column, (columns / 18) * hills - Math.min(fromWall, depth)];
  });
}

const subtract = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a: Point): Point => {
  const length = Math.hypot(...a);
  return [a[0] / length, a[1] / length, a[2] / length];
};

export const EXAMPLES: readonly Example[] = [
  {
    name: 'scroll', title: 'Scroll', trap: 'a rolled sheet whose layers nearly touch',
    make: scroll, vertices: 100_000, query: { at: 0.300945, radius: 24, cut: 'z', from: [0.3, 0.55, 1] },
  },
  {
    name: 'folds', title: 'Folds', trap: 'an accordion whose walls nearly touch',
    make: folds, vertices: 60_000, query: { at: 0.505, radius: 14, cut: 'y', from: [0.35, 1, 0.45] },
  },
  {
    name: 'knot', title: 'Knot', trap: 'a tube whose strands come close to each other',
    make: knot, vertices: 60_000, query: { at: 0.31009, radius: 30, from: [0, 0, 1] },
  },
  {
    name: 'terrain', title: 'Terrain', trap: 'hills with a gorge, whose rims are near each other',
    make: terrain, vertices: 90_000, query: { at: 0.3483, radius: 24, from: [0.5, -0.5, 1] },
  },
];

export function findExample(name: string): Example | undefined {
  return EXAMPLES.find((example) => example.name === name);
}
