// SPDX-License-Identifier: MIT
// What the checkers of npm packages say of the packed package: publint of its files, and attw of its types, for projects
// that use ES modules, alone and with a bundler. MESHHOOD_PACKAGE is the folder of the package.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { checkPackage, createPackageFromTarballData } from '@arethetypeswrong/core';
import { publint } from 'publint';
import { formatMessage } from 'publint/utils';

import { makeProject } from './project.mjs';

const { project, archive } = makeProject();

test('publint has no message', async () => {
  const folder = join(project, 'node_modules', 'meshhood');
  const { messages, pkg } = await publint({ pkgDir: folder, strict: true });
  assert.deepEqual(messages.map((message) => formatMessage(message, pkg, { color: false })), []);
});

test('the types are found by every way of resolution for ES modules', async () => {
  const checked = await checkPackage(createPackageFromTarballData(readFileSync(join(project, archive))));
  const { resolutions } = checked.entrypoints['.'];
  for (const way of ['node16-esm', 'bundler']) {
    assert.ok(resolutions[way].resolution.isTypeScript, way);
  }
  // CommonJS may import an ES module, but not require it before Node 20.19.
  assert.deepEqual(checked.problems.filter(({ kind }) => kind !== 'CJSResolvesToESM'), []);
});
