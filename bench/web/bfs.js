// SPDX-License-Identifier: MIT
// Breadth-first search limited to the ball, in plain JavaScript, as fast as typed arrays make it.

/** The neighbors of v are `neighbors[offsets[v]]` to `neighbors[offsets[v + 1] - 1]`. */
export function adjacency(vertices, triangles) {
  const edges = new Float64Array(2 * triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    for (let i = 0; i < 3; ++i) {
      const [v, w] = [triangles[t + i], triangles[t + ((i + 1) % 3)]];
      edges[2 * (t + i)] = v * vertices + w;
      edges[2 * (t + i) + 1] = w * vertices + v;
    }
  }
  edges.sort();
  const offsets = new Uint32Array(vertices + 1);
  const neighbors = new Uint32Array(edges.length);
  let count = 0;
  for (let i = 0; i < edges.length; ++i) {
    if (i > 0 && edges[i] === edges[i - 1]) continue;
    const v = Math.floor(edges[i] / vertices);
    neighbors[count++] = edges[i] - v * vertices;
    offsets[v + 1] = count;
  }
  for (let v = 1; v <= vertices; ++v) offsets[v] = Math.max(offsets[v], offsets[v - 1]);
  return { offsets, neighbors: neighbors.slice(0, count) };
}

export class JsSearcher {
  #visited; // the number of the query that visited a vertex, so that nothing is cleared
  #queue;
  #query = 0;

  constructor(positions, triangles) {
    this.positions = positions;
    Object.assign(this, adjacency(positions.length / 3, triangles));
    this.#visited = new Uint32Array(positions.length / 3);
    this.#queue = new Uint32Array(positions.length / 3);
  }

  /** A view of the vertices found, valid until the next call. */
  neighborhood(v, radius) {
    const { positions, offsets, neighbors } = this;
    const visited = this.#visited;
    const queue = this.#queue;
    const query = ++this.#query;
    const [x, y, z] = [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
    visited[v] = query;
    queue[0] = v;
    let end = 1;
    for (let at = 0; at < end; ++at) {
      const from = queue[at];
      for (let i = offsets[from]; i < offsets[from + 1]; ++i) {
        const w = neighbors[i];
        if (visited[w] === query) continue;
        visited[w] = query;
        const dx = positions[3 * w] - x;
        const dy = positions[3 * w + 1] - y;
        const dz = positions[3 * w + 2] - z;
        if (Math.sqrt(dx * dx + dy * dy + dz * dz) <= radius) queue[end++] = w;
      }
    }
    return queue.subarray(0, end);
  }
}
