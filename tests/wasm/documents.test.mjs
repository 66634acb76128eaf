// SPDX-License-Identifier: MIT
// The JavaScript of all documents, and the example of the declarations, run unchanged in a project with the package. The
// pieces of a page are one program. Those for bundlers run in bundlers.test.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { codeBlocks, makeProject } from './project.mjs';

const { project } = makeProject();
execFileSync(process.env.MESHHOOD_CLI, ['generate', 'sphere', '--vertices', '500', '-o', 'hand.ply'], { cwd: project });

const declarations = readFileSync(new URL('../../bindings/wasm/meshhood.d.ts', import.meta.url), 'utf8');
const example = declarations.match(/^ \* {5}.*\n( \*( {5}.*)?\n)*/m)[0].replace(/^ \* {0,5}/gm, '');
const pages = new Map([['meshhood.d.ts', [example]]]);
for (const { page, code } of codeBlocks('js')) pages.set(page, [...(pages.get(page) ?? []), code]);

// The file that somebody has chosen in a browser.
const FILE = `
  import { File } from 'node:buffer';
  import { readFileSync } from 'node:fs';
  const file = new File([readFileSync('hand.ply')], 'hand.ply');
`;

for (const [page, pieces] of pages) {
  test(`the code of ${page} runs`, () => {
    writeFileSync(join(project, 'use.js'), `${FILE}${pieces.join('')}\nconsole.log(near.length);`);
    const count = Number(execFileSync('node', ['use.js'], { cwd: project, encoding: 'utf8' }));
    console.log(`${page}: ${pieces.length} pieces of code, ${count} vertices`);
    assert.ok(count > 1);
  });
}

test('there are such pages', () => {
  assert.ok(pages.size >= 3);
});
