// SPDX-License-Identifier: MIT
// `initialize` takes the module in each form in which a page or a bundler may have it. MESHHOOD_PACKAGE is the folder of
// the package. A process compiles the module only once, so each form has a process of its own, as has what an engine may
// lack.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { promisify } from 'node:util';

import { library } from './setup.mjs';

const { initialize, version } = library;
const OTHER = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0); // a module without anything
const file = join(process.env.MESHHOOD_PACKAGE, 'meshhood.wasm');
const package_ = pathToFileURL(join(process.env.MESHHOOD_PACKAGE, 'meshhood.js'));
const server = createServer(({ url }, response) => {
  if (url === '/meshhood.wasm') response.end(readFileSync(file)); // of no type, as some servers send it
  else if (url === '/page.wasm') response.end('<!doctype html>'); // as servers of one page answer for all addresses
  else response.writeHead(404).end();
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
after(() => server.close());
const site = `http://127.0.0.1:${server.address().port}`;

/** What a process prints that initializes the package by `source`, an expression. It runs `before` and `after` there. */
async function answerBy(source, before = '', after = '') {
  const program = `
    import { readFileSync } from 'node:fs';
    ${before}
    const { MeshIndex, initialize } = await import(${JSON.stringify(package_.href)});
    const file = ${JSON.stringify(file)};
    await initialize(${source});
    const index = new MeshIndex(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 0, 0), Uint32Array.of(0, 1, 2, 1, 2, 3));
    console.log(index.neighborhood(0, 2, { sort: 'id' }).join());
    ${after}`;
  const { stdout } = await promisify(execFile)(process.execPath, ['--input-type=module', '--eval', program]);
  return stdout.trim();
}

const SOURCES = {
  'an address': `'${site}/meshhood.wasm'`,
  'a URL': `new URL('${site}/meshhood.wasm')`,
  'the URL of a file': `new URL('${pathToFileURL(file)}')`,
  'the address of a file': `'${pathToFileURL(file)}'`,
  'a Response': `await fetch('${site}/meshhood.wasm')`,
  'the promise of a Response': `fetch('${site}/meshhood.wasm')`,
  'an array of bytes': 'readFileSync(file)',
  'an ArrayBuffer': 'new Uint8Array(readFileSync(file)).buffer',
  'a compiled module': 'await WebAssembly.compile(readFileSync(file))',
  'nothing': '',
};

for (const [name, source] of Object.entries(SOURCES)) {
  test(`${name} initializes the package`, async () => assert.equal(await answerBy(source), '0,1,2'));
}

test('what is no module is refused by name, after which initialize may be called again', async () => {
  await assert.rejects(initialize(`${site}/none.wasm`), { message: `${site}/none.wasm: 404 Not Found` });
  await assert.rejects(initialize(fetch(`${site}/none.wasm`)), { message: /none\.wasm: 404 Not Found/ });
  await assert.rejects(initialize(Uint8Array.of(1, 2, 3)), WebAssembly.CompileError);
  await assert.rejects(initialize(`${site}/page.wasm`), { message: new RegExp(`^${site}/page\\.wasm: .*magic word`) });
  await assert.rejects(initialize(fetch(`${site}/page.wasm`)), { message: /^http.*page\.wasm: .*magic word/ });
  await assert.rejects(initialize('http://127.0.0.1:1/a.wasm'), { message: /^http:\/\/127\.0\.0\.1:1\/a\.wasm: / });
  await assert.rejects(initialize(new Response('', { status: 404 })), { message: /^source: 404/ });
  for (const source of [5, null, {}, []]) {
    await assert.rejects(initialize(source), { name: 'TypeError', message: /^source: .*, expected an address, a Response/ });
  }
  await assert.rejects(initialize(OTHER), { message: `source: another module, expected the module of meshhood ${version}` });
  await assert.rejects(initialize(WebAssembly.compile(OTHER)), { message: /^source: another module/ });
  const older = readFileSync(file, 'latin1').replace(`meshhood ${version}`, `meshhood ${version.replace(/\d/g, '9')}`);
  await assert.rejects(initialize(Buffer.from(older, 'latin1')), { message: /^source: meshhood 9.*, expected the module of/ });
  await initialize();
});

test('`using` works where there is no Symbol.dispose', async () => {
  const before = `
    const whole = Symbol;
    globalThis.Symbol = new Proxy(() => {}, { get: (_, key) => (key === 'dispose' ? undefined : whole[key]) });`;
  const after = `
    index[Symbol.for('Symbol.dispose')]();
    console.log(index.memoryBytes);`;
  assert.equal(await answerBy('', before, after), '0,1,2\n0');
});
