// SPDX-License-Identifier: MIT
// The package and the command line. MESHHOOD_PACKAGE is the folder of the package, MESHHOOD_CLI the command line.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';
import { pathToFileURL } from 'node:url';

import { arraysOf } from './npz.mjs';

export const library = await import(pathToFileURL(join(process.env.MESHHOOD_PACKAGE, 'meshhood.js')));

const folder = mkdtempSync(join(tmpdir(), 'meshhood-'));
after(() => rmSync(folder, { recursive: true }));

/** Runs the command line in a folder of this test. */
export const meshhood = (...options) =>
  execFileSync(process.env.MESHHOOD_CLI, options, { cwd: folder, encoding: 'utf8', stdio: 'pipe' });
export const write = (name, content) => writeFileSync(join(folder, name), content);
export const read = (name) => readFileSync(join(folder, name));

/** The message of the command line about a file, without the name of the program. */
export function wordsOfCommandLine(name, content) {
  write(name, content);
  try {
    meshhood('info', name);
  } catch (error) {
    return error.stderr.replace(/^meshhood: /, '').trimEnd();
  }
  throw new Error(`${name} was accepted`);
}

export const readArrays = (name) => arraysOf(read(name));

export const build = (mesh, options) =>
  new library.MeshIndex(mesh.positions, mesh.corners, { offsets: mesh.offsets, ...options });

/** `count` times $MESHHOOD_TEST_SCALE, as in the tests of the library. */
export const scaled = (count) => Math.round(count * Number(process.env.MESHHOOD_TEST_SCALE ?? 1));
