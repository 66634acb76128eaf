// SPDX-License-Identifier: MIT
// Microseconds a row of the package under Node: all vertices of a mesh in one call, and beside them one vertex after
// another. The sizes of the neighborhoods, the median of several rounds. Several builds are measured in turn. After
// `tools/build wasm`:
//
//     node bench/web/batch.mjs MESH.ply [FOLDER OF A BUILD...]
import { readFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const RADII = [2, 5, 10, 20]; // in mean edge lengths
const ROUNDS = 7;
const SINGLE = 500; // vertices, queried one after another

const [file, ...folders] = process.argv.slice(2);
if (file === undefined) throw new Error('usage: node bench/web/batch.mjs MESH.ply [FOLDER OF A BUILD...]');
if (folders.length === 0) folders.push(join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'build', 'wasm', 'npm'));

async function indexOf(folder) {
  const { MeshIndex, initialize, readMesh } = await import(resolve(folder, 'meshhood.js'));
  await initialize();
  const mesh = readMesh(readFileSync(file), file);
  return new MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets });
}

function microseconds(rows, work) {
  const begin = performance.now();
  work();
  return (1000 * (performance.now() - begin)) / rows;
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

const indexes = [];
for (const folder of folders) indexes.push(await indexOf(folder));
const [{ vertexCount, meanEdgeLength }] = indexes;
const few = Array.from({ length: SINGLE }, (_, i) => Math.floor((i * vertexCount) / SINGLE));

// The engine compiles well only what has run for some time.
for (let round = 0; round < ROUNDS; ++round) {
  for (const index of indexes) {
    index.counts(2 * meanEdgeLength);
    few.forEach((v) => index.count(v, 5 * meanEdgeLength));
  }
}

console.log('radius  batch     one  one / batch');
for (const radius of RADII) {
  const r = radius * meanEdgeLength;
  const times = folders.map(() => ({ batch: [], one: [] }));
  for (let round = 0; round < ROUNDS; ++round) {
    for (const [i, index] of indexes.entries()) {
      times[i].batch.push(microseconds(vertexCount, () => index.counts(r)));
      times[i].one.push(microseconds(SINGLE, () => few.forEach((v) => index.count(v, r))));
    }
  }
  for (const [i, folder] of folders.entries()) {
    const batch = median(times[i].batch);
    const one = median(times[i].one);
    console.log(`${radius}`.padStart(6), batch.toFixed(3).padStart(6), one.toFixed(3).padStart(7),
      (one / batch).toFixed(1).padStart(12), folders.length > 1 ? ` ${folder}` : '');
  }
}
