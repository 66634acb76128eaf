// SPDX-License-Identifier: MIT
// Runs in the browser: three methods in turn on the same vertices.
import { JsSearcher } from './bfs.js';
import { initialize, MeshIndex, readMesh } from './package/meshhood.js';

const RADII = [2, 5, 10, 20, 65]; // in mean edge lengths
const ROUNDS = 9;
const LEAST = 4; // milliseconds in a block, as the clock of a browser is coarse

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Microseconds a query over the vertices, repeated until a block is long enough. */
function block(query, vertices) {
  let runs = 0;
  const begin = performance.now();
  do {
    for (const v of vertices) query(v);
    ++runs;
  } while (performance.now() - begin < LEAST);
  return (1000 * (performance.now() - begin)) / (runs * vertices.length);
}

export async function measure(address) {
  await initialize();
  const bytes = await (await fetch(address)).arrayBuffer();
  const mesh = readMesh(bytes, 'mesh.ply');
  const begin = performance.now();
  const index = new MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets });
  const build = (performance.now() - begin) / 1000;
  const edge = index.meanEdgeLength;
  const js = new JsSearcher(mesh.positions, mesh.corners);
  const vertices = Array.from({ length: 32 }, (_, i) => Math.floor(((i + 0.5) / 32) * index.vertexCount));
  const rows = RADII.map((radius) => {
    const r = radius * edge;
    const methods = {
      exact: (v) => index.viewNeighborhood(v, r),
      bfs: (v) => index.viewNeighborhood(v, r, { method: 'bfs' }),
      js: (v) => js.neighborhood(v, r),
    };
    const found = vertices.map((v) => {
      const sizes = Object.values(methods).map((query) => query(v).length);
      if (sizes.some((size) => size !== sizes[0])) throw new Error(`vertex ${v}: ${sizes}`);
      return sizes[0];
    });
    const times = { exact: [], bfs: [], js: [] };
    for (let round = 0; round < ROUNDS; ++round) {
      for (const [name, query] of Object.entries(methods)) times[name].push(block(query, vertices));
    }
    const medians = Object.fromEntries(Object.entries(times).map(([name, values]) => [name, median(values)]));
    return { radius, found: found.reduce((a, b) => a + b) / found.length, ...medians };
  });
  return { vertices: index.vertexCount, build, memory: index.memoryBytes, rows };
}
