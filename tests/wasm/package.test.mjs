// SPDX-License-Identifier: MIT
// What `npm pack` makes of the package installs and works in an empty project. MESHHOOD_PACKAGE is its folder.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

const project = mkdtempSync(join(tmpdir(), 'meshhood-'));
after(() => rmSync(project, { recursive: true }));

const run = (command, ...options) => execFileSync(command, options, { cwd: project, encoding: 'utf8', stdio: 'pipe' });

test('the packed package works in an empty project', () => {
  run('npm', 'pack', '--silent', process.env.MESHHOOD_PACKAGE);
  const [archive] = readdirSync(project);
  assert.match(archive, /^meshhood-[\d.]+\.tgz$/);
  writeFileSync(join(project, 'package.json'), '{"type": "module"}');
  run('npm', 'install', '--silent', '--offline', `./${archive}`);
  assert.deepEqual(readdirSync(join(project, 'node_modules', 'meshhood')).sort(), [
    'LICENSE', 'README.md', 'arguments.js', 'curvature.js', 'instance.js', 'mesh_file.js', 'mesh_index.js',
    'meshhood.d.ts', 'meshhood.js', 'meshhood.wasm', 'package.json', 'region_mesh.js',
  ]);
  writeFileSync(join(project, 'use.js'), `
    import { MeshIndex, initialize } from 'meshhood';
    await initialize();
    const index = new MeshIndex(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 0, 0), Uint32Array.of(0, 1, 2, 1, 2, 3));
    console.log(index.queryBall(0, 2, { sort: true }).join());
  `);
  assert.equal(run('node', 'use.js'), '0,1,2\n');
});
