// SPDX-License-Identifier: MIT
// The code of docs/web.md runs in a project with the package, one piece after the other; bundlers.test.mjs has the pieces
// for bundlers.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { makeProject } from './project.mjs';

const page = readFileSync(new URL('../../docs/web.md', import.meta.url), 'utf8');

// What the second piece takes as given.
const NAMES = `
  import { RegionMesh } from 'meshhood';
  const heights = Float64Array.from({ length: index.vertexCount }, (_, v) => mesh.positions[3 * v + 2]);
  const seeds = Uint32Array.of(42);
  const walls = new Uint8Array(index.vertexCount);
  const moved = mesh.positions.map((x) => x + 1);
  const changed = Uint32Array.of(42);
`;

test('the code of the page runs', () => {
  const { project } = makeProject();
  execFileSync(process.env.MESHHOOD_CLI, ['generate', 'sphere', '--vertices', '500', '-o', 'hand.ply'], { cwd: project });
  const [first, second] = [...page.matchAll(/```js\n(.*?)```/gs)].map(([, code]) => code);
  const [before, after] = first.split('index.dispose();');
  assert.equal(after.trim(), '');
  const end = 'console.log(near.length, part.vertices.length, lines.length, k1.length);\nindex.dispose();\n';
  writeFileSync(join(project, 'use.js'), before + NAMES + second + end);
  const numbers = execFileSync('node', ['use.js'], { cwd: project, encoding: 'utf8' }).trim().split(' ').map(Number);
  console.log(`docs/web.md: ${before.split('\n').length + second.split('\n').length} lines`);
  assert.ok(numbers.every((number) => number > 0), numbers.join());
});
