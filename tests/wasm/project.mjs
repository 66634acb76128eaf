// SPDX-License-Identifier: MIT
// A project of its own with the package installed, as `npm install` does it. MESHHOOD_PACKAGE is the folder of the
// package.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after } from 'node:test';
import { fileURLToPath } from 'node:url';

/** The blocks of the documents in a language: { page, code }. See tools/code_blocks.py. */
export function codeBlocks(language, mark = '') {
  const program = fileURLToPath(new URL('../../tools/code_blocks.py', import.meta.url));
  return JSON.parse(execFileSync('python3', ['-B', program, language, mark], { encoding: 'utf8' }));
}

/** Makes the project, and removes it after the tests. `others` are packages that tests/wasm/package.json names. */
export function makeProject(...others) {
  const project = mkdtempSync(join(tmpdir(), 'meshhood-'));
  after(() => rmSync(project, { recursive: true }));
  const npm = (...options) => execFileSync('npm', options, { cwd: project, encoding: 'utf8', stdio: 'pipe' });
  npm('pack', '--silent', process.env.MESHHOOD_PACKAGE);
  const [archive] = readdirSync(project);
  writeFileSync(join(project, 'package.json'), '{"type": "module"}');
  npm('install', '--silent', '--offline', `./${archive}`);
  for (const name of others) {
    const place = join(project, 'node_modules', name);
    mkdirSync(dirname(place), { recursive: true });
    symlinkSync(fileURLToPath(new URL(`node_modules/${name}`, import.meta.url)), place);
  }
  return { project, archive };
}
