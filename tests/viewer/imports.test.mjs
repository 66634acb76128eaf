// SPDX-License-Identifier: MIT
// The check that no modules of the page import each other in a circle. MESHHOOD_VIEWER_SOURCES is the folder of the
// page's sources.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

const folder = mkdtempSync(join(tmpdir(), 'meshhood-'));
after(() => rmSync(folder, { recursive: true }));

function check(...folders) {
  const checker = join(process.env.MESHHOOD_VIEWER_SOURCES, 'check_imports.mjs');
  const { status, stderr } = spawnSync(process.execPath, [checker, ...folders], { encoding: 'utf8' });
  return { status, stderr };
}

const write = (modules) => {
  for (const [name, text] of Object.entries(modules)) writeFileSync(join(folder, name), text);
};

test('the modules of the page have no circle', () => {
  assert.deepEqual(check(), { status: 0, stderr: '' });
});

test('a circle is found, also one of types, and one through a worker', () => {
  write({ 'main.ts': "import './a';", 'a.ts': "import { b } from './b';", 'b.ts': "import type { C } from './c';", 'c.ts': '' });
  assert.equal(check(folder).status, 0);
  for (const back of ["import type { A } from './a';", "import Engine from './a?worker&inline';", "export * from './a';"]) {
    write({ 'c.ts': back });
    const { status, stderr } = check(folder);
    assert.equal(status, 1, back);
    assert.equal(stderr, 'modules import each other in a circle: a.ts -> b.ts -> c.ts -> a.ts\n');
  }
});
