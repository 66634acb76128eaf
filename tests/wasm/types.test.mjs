// SPDX-License-Identifier: MIT
// The declarations of the package hold under `tsc --strict`, without `skipLibCheck`. MESHHOOD_PACKAGE is its folder.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { makeProject } from './project.mjs';

const { project } = makeProject();
const compiler = fileURLToPath(new URL('node_modules/typescript/bin/tsc', import.meta.url));

function compile(text, ...options) {
  writeFileSync(join(project, 'use.ts'), text);
  const { status, stdout } = spawnSync(process.execPath, [
    compiler, '--strict', '--noEmit', '--skipLibCheck', 'false', '--module', 'nodenext', ...options, 'use.ts'], { cwd: project, encoding: 'utf8' });
  return { status, stdout };
}

const USE = `
  import { Curvature, MeshIndex, MeshhoodError, initialize, readMesh } from 'meshhood';
  import type { Faces, Mesh, Rows, SurfacePoint } from 'meshhood';

  await initialize();
  const mesh: Mesh = readMesh(new Uint8Array(9), 'hand.ply', { precision: 'double' });
  const faces: Faces = { corners: Uint16Array.of(0, 1, 2) };
  const index: MeshIndex = new MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets });
  const near: Uint32Array = index.neighborhood(42, 1.5, { unit: 'edge' });
  const rows: Rows = index.neighborhoods(1.5);
  const scales = Float64Array.of(1, 2);
  const walls = new Uint8Array(index.vertexCount);
  const curvature: Curvature = index.curvature(null, { faces, scales, walls });
  const counts: Uint32Array = index.counts(null, { scales, metric: 'rings' });
  const far: Rows & { distances: Float64Array } = index.neighborhoods(2, { vertices: near, sort: 'distance', walls, distances: true });
  const holes: Uint8Array | null = mesh.walls;
  const besides: number = index.nearest([0, 0, 1], { walls: holes }).vertex + index.count(42, 2, { metric: 'surface', faces });
  const other: { vertex: Uint32Array; distance: Float64Array } = index.nearestUnconnected(scales, { vertices: near, walls });
  const lengths: Float64Array = index.kNearest(9, { vertices: near, metric: 'path', walls }).distances;
  const discs: Rows = index.discs(2, { faces });
  const creases: Float64Array = index.features(null, { faces, scales, kinds: ['crease', 'area'] });
  const { vertices, point, face } = index.closestPoint([0, 0, 1], { faces });
  const volume: Float64Array = index.invariants(null, { faces, scales, walls }).volume;
  const between: Float64Array = index.gaps(scales, { faces, vertices: near, unit: 'edge' }).distance;
  const patch: Uint32Array = index.patch(point, 2, { faces, face });
  const clipped: Float64Array = index.clip(point, 2, { faces, face, tolerance: 1e-4 }).positions;
  const measured: number = index.measure(42, 2, { faces, walls }).volume + (index.gap(point, 2, { faces, face })?.distance ?? 0);
  index.neighborhood(point, 2, { seeds: vertices, sort: 'id' });
  const hit: SurfacePoint | null = index.firstHit(point, [0, 0, -1], { faces });
  const across: Float64Array = index.thickness({ faces, vertices, method: 'sphere' });
  const around: number = index.count(point, 2, { seeds: vertices, walls });
  const lists: Uint32Array[] = [index.viewNeighborhood(42, 2), index.nested(42, scales, { metric: 'rings' }).counts];
  index.smooth(index.aggregate(between, scales, { metric: 'surface', faces, reduce: ['mean'] }), 3, { metric: 'path', walls });
  index.refitInPlace(mesh.positions, { changed: near });
  const distances: boolean = near.length > 9;
  const either = [index.neighborhood(42, 2, { distances }), index.neighborhoods(2, { distances })];
  const points = Float32Array.of(0, 0, 1);
  const gaps = index.gaps(Uint8Array.of(2), { faces, points, face: vertices });
  const blurred: Float64Array = index.smooth(walls, 3, { weights: near });
  const part = index.submesh(near, { faces, corners: 'any' });
  const codes: string[] = [new MeshhoodError('InvalidOption', 'no such unit', { cause: near }).code];
  export const used = [besides, hit?.face, across, around, lists, lengths, discs, creases, counts, far.distances, other.vertex, rows.offsets, curvature.mean, part.vertices, index.rim(near, 42, 2), codes, either, gaps, blurred, volume, between, patch, clipped, measured];
`;

const FILES = `
  import { MeshIndex, readMesh } from 'meshhood';

  const mesh = readMesh(new ArrayBuffer(9), 'hand.ply');
  const index = new MeshIndex(mesh.positions, mesh.corners);
  export async function keep(file: FileSystemFileHandle) {
    const stream = await file.createWritable();
    await stream.write(index.save());
    await stream.write(index.neighborhoods(2).ids);
    await stream.write(index.curvature(2).k1);
    return new Blob([index.save(), mesh.positions, index.neighborhood(42, 2), index.viewNeighborhood(42, 2)]);
  }
`;

test('the file of the module has a type', () => {
  const use = "import { initialize } from 'meshhood';\nimport wasm from 'meshhood/meshhood.wasm';\nawait initialize(wasm);";
  for (const way of ['nodenext', 'esnext']) {
    const options = ['--target', 'es2022', '--module', way, '--moduleResolution', way === 'nodenext' ? way : 'bundler'];
    assert.deepEqual(compile(use, ...options), { status: 0, stdout: '' }, way);
  }
});

test('a browser takes results for a file', () => {
  assert.deepEqual(compile(FILES, '--target', 'es2022'), { status: 0, stdout: '' });
});

for (const [name, options] of Object.entries({
  'es2022 with the DOM': ['--target', 'es2022'],
  'es2022 alone': ['--target', 'es2022', '--lib', 'es2022'],
  'the latest version': ['--target', 'esnext'],
})) {
  test(`the declarations pass for ${name}`, () => assert.deepEqual(compile(USE, ...options), { status: 0, stdout: '' }));
}

test('an error without a code is one of the compiler', () => {
  assert.match(compile("import { MeshhoodError } from 'meshhood';\nthrow new MeshhoodError();").stdout, /^use\.ts\(2,/);
});

test('unknown options and wrong types are errors of the compiler', () => {
  for (const wrong of ["{ units: 'edge' }", "{ unit: 'foot' }", "{ sort: 1 }", "{ metric: 'edges' }", "{ walls: [1] }"]) {
    const { status, stdout } = compile(`
      import type { MeshIndex } from 'meshhood';
      export const near = (index: MeshIndex) => index.neighborhood(5, 3, ${wrong});`, '--target', 'es2022');
    assert.notEqual(status, 0, wrong);
    assert.match(stdout, /^use\.ts\(3,/, wrong);
  }
});
