// SPDX-License-Identifier: MIT
// Microseconds a row of the package under Node: all vertices of a mesh in one call, and beside them one vertex after
// another. The sizes of the neighborhoods, the median of several rounds. After `tools/build wasm`:
//
//     node bench/web/batch.mjs MESH.ply [FOLDER OF ANOTHER BUILD]
import { readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const RADII = [2, 5, 10, 20]; // in mean edge lengths
const ROUNDS = 7;
const SINGLE = 500; // vertices, queried one after another

const [file, folder] = process.argv.slice(2);
if (file === undefined) throw new Error('usage: node bench/web/batch.mjs MESH.ply [FOLDER OF ANOTHER BUILD]');
const own = join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'build', 'wasm', 'npm');
const { MeshIndex, initialize, readMesh } = await import(resolve(folder ?? own, 'meshhood.js'));
await initialize();

const mesh = readMesh(readFileSync(file), file);
const index = new MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets });
const few = Array.from({ length: SINGLE }, (_, i) => Math.floor((i * index.vertexCount) / SINGLE));

function microseconds(rows, work) {
  const times = Array.from({ length: ROUNDS }, () => {
    const begin = performance.now();
    work();
    return (1000 * (performance.now() - begin)) / rows;
  });
  return times.sort((a, b) => a - b)[ROUNDS >> 1];
}

console.log('radius  batch     one  one / batch');
for (const radius of RADII) {
  const r = radius * index.meanEdgeLength;
  const batch = microseconds(index.vertexCount, () => index.count(null, r));
  const one = microseconds(SINGLE, () => few.forEach((v) => index.count(v, r)));
  console.log(`${radius}`.padStart(6), batch.toFixed(3).padStart(6), one.toFixed(3).padStart(7),
    (one / batch).toFixed(1).padStart(12));
}
