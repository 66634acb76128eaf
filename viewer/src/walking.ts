// SPDX-License-Identifier: MIT
// Walking over the mesh: from a vertex to a neighbor.

export interface Place {
  x: number;
  y: number;
}

/** To the right, and downwards, as on the canvas. */
export type Direction = Place;

/**
 * The neighbor that lies most nearly in a direction, seen on the canvas; null if none lies within 90 degrees of it.
 * `placeOf` says where a vertex is.
 */
export function nextVertex(
  from: number, neighbors: Iterable<number>, direction: Direction, placeOf: (vertex: number) => Place,
): number | null {
  const start = placeOf(from);
  let best: number | null = null;
  let most = 0; // the cosine of the angle
  for (const vertex of neighbors) {
    const { x, y } = placeOf(vertex);
    const [dx, dy] = [x - start.x, y - start.y];
    const cosine = (dx * direction.x + dy * direction.y) / (Math.hypot(dx, dy) || 1);
    if (cosine <= most) continue;
    most = cosine;
    best = vertex;
  }
  return best;
}
