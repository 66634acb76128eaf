// SPDX-License-Identifier: MIT
// The page is part of what is installed. MESHHOOD_BUILD is the build folder, with the package for Python in python/ as pip
// installs it; MESHHOOD_PYTHON is a Python for it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { idsOf, openPage } from './browser.mjs';
import { launchWithFolder } from './fixture.mjs';

const { browser, folder } = await launchWithFolder();

const { MESHHOOD_VIEWER: _, ...environment } = process.env;
const run = (program, ...options) =>
  execFileSync(program, options, { cwd: folder, encoding: 'utf8', stdio: 'pipe', env: { ...environment, PYTHONPATH: join(process.env.MESHHOOD_BUILD, 'python') } });

async function expectAnswer(file) {
  const page = await openPage(browser, join(folder, file));
  assert.deepEqual(await idsOf(page, 'exact'), [0, 1, 2]);
  const licenses = await page.locator('#licenses').textContent();
  for (const name of ['LICENSE', 'NOTICE']) {
    assert.ok(licenses.includes(readFileSync(join(process.env.MESHHOOD_VIEWER_SOURCES, '..', name), 'utf8')), name);
  }
  await page.close();
}

test('the page of an installed release', async () => {
  run('cmake', '--install', process.env.MESHHOOD_BUILD, '--prefix', join(folder, 'prefix'));
  writeFileSync(join(folder, 'mesh.obj'), 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 0 0\nf 1 2 3\nf 2 4 3\n');
  run(join(folder, 'prefix', 'bin', 'meshhood'), 'view', 'mesh.obj', '-v', '0', '-r', '2', '-o', 'release.html');
  await expectAnswer('release.html');
});

test('the page of the package for Python', async () => {
  const program = `import meshhood, numpy as np
V, F = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [9.0, 0, 0]]), np.array([[0, 1, 2], [1, 3, 2]])
meshhood.view(V, F, v=0, r=2).save("python.html")`;
  run(process.env.MESHHOOD_PYTHON, '-c', program);
  await expectAnswer('python.html');
});
