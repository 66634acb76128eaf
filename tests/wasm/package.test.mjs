// SPDX-License-Identifier: MIT
// What `npm pack` makes of the package installs and works in an empty project. MESHHOOD_PACKAGE is its folder.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';

import { makeProject } from './project.mjs';

test('the packed package works in an empty project', () => {
  const { project, archive } = makeProject();
  assert.match(archive, /^meshhood-[\d.]+\.tgz$/);
  assert.deepEqual(readdirSync(join(project, 'node_modules', 'meshhood')).sort(), [
    'LICENSE', 'NOTICE', 'README.md', 'arguments.js', 'curvature.js', 'instance.js', 'mesh_file.js', 'mesh_index.js',
    'meshhood.d.ts', 'meshhood.js', 'meshhood.wasm', 'meshhood.wasm.d.ts', 'package.json', 'rows.js', 'version.js',
    'weld.js', 'words.js',
  ]);
  writeFileSync(join(project, 'use.js'), `
    import { MeshIndex, initialize, version } from 'meshhood';
    await initialize();
    console.log(version);
    const index = new MeshIndex(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 0, 0), Uint32Array.of(0, 1, 2, 1, 2, 3));
    console.log(index.neighborhood(0, 2, { sort: 'id' }).join());
  `);
  const { version } = JSON.parse(readFileSync(join(project, 'node_modules', 'meshhood', 'package.json'), 'utf8'));
  assert.equal(execFileSync('node', ['use.js'], { cwd: project, encoding: 'utf8' }), `${version}\n0,1,2\n`);
});

test('docs/web.md has the sizes of the module', () => {
  const page = readFileSync(new URL('../../docs/web.md', import.meta.url), 'utf8');
  const stated = page.match(/module has ([\d.]+) MB,\s+compressed ([\d.]+) MB/).slice(1).map(Number);
  const module = readFileSync(join(process.env.MESHHOOD_PACKAGE, 'meshhood.wasm'));
  const sizes = [module, gzipSync(module, { level: 9 })].map((bytes) => bytes.length / 1e6);
  console.log(`${sizes.join(' MB, compressed ')} MB`);
  sizes.forEach((size, i) => assert.ok(Math.abs(size - stated[i]) < 0.1, `${size} MB, but the page says ${stated[i]}`));
});
