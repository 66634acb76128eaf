// SPDX-License-Identifier: MIT
// The package in the page of docs/web.md that needs no bundler, in one that each bundler makes, with the code of that
// document, and the example with three.js. They answer in Chromium. MESHHOOD_PACKAGE is the folder of the package,
// MESHHOOD_EXAMPLE that of the example, and MESHHOOD_VIEWER_SOURCES that of the page, whose npm packages drive the browser.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { after, test } from 'node:test';
import { promisify } from 'node:util';

import * as esbuild from 'esbuild';
import * as vite from 'vite';
import webpack from 'webpack';

import { codeBlocks, makeProject } from './project.mjs';
import { countPixels, launch } from '../viewer/browser.mjs';

const { project } = makeProject('three');
const browser = await launch();
after(() => browser.close());
const path = (...parts) => join(project, ...parts);

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm', '.css': 'text/css' };

/** Serves a folder of the project to this machine alone, as a web server does: what is not there is 404. */
async function serve(folder) {
  const server = createServer(({ url }, response) => {
    const file = path(folder, url === '/' ? 'index.html' : url.split('?')[0]);
    if (!existsSync(file)) return response.writeHead(404).end();
    response.setHeader('content-type', TYPES[extname(file)] ?? 'application/octet-stream').end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  after(() => server.close());
  return `http://127.0.0.1:${server.address().port}/`;
}

/** Writes a page whose script initializes the package as docs/web.md says for a bundler, and asks for a neighborhood. */
function writeSources(bundler) {
  const [{ code }] = codeBlocks('js', bundler);
  const imports = code.match(/^import .*$/gm) ?? [];
  const others = code.replace(/^import .*$/gm, '');
  mkdirSync(path(bundler), { recursive: true });
  writeFileSync(path(bundler, 'index.html'), '<!doctype html><script type="module" src="./main.js"></script>');
  writeFileSync(path(bundler, 'main.js'), `
    import { MeshIndex, initialize } from 'meshhood';
    ${imports.join('\n')}
    try {
      ${others}
      const index = new MeshIndex(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 0, 0), Uint16Array.of(0, 1, 2, 1, 2, 3));
      document.title = index.neighborhood(0, 2, { sort: 'id' }).join();
    } catch (error) {
      document.title = String(error);
    }`);
}

async function expectAnswer(address) {
  const page = await browser.newPage();
  page.on('pageerror', (error) => { throw error; });
  await page.goto(address);
  await page.waitForFunction(() => document.title !== '');
  assert.equal(await page.title(), '0,1,2');
  await page.close();
}

test('no bundler', async () => {
  const [{ code }] = codeBlocks('html');
  mkdirSync(path('plain'));
  writeFileSync(path('plain', 'index.html'), code);
  symlinkSync(path('node_modules'), path('plain', 'node_modules'));
  execFileSync(process.env.MESHHOOD_CLI, ['generate', 'sphere', '--vertices', '500', '-o', path('hand.ply')]);
  const page = await browser.newPage();
  page.on('pageerror', (error) => { throw error; });
  await page.goto(await serve('plain'));
  await page.setInputFiles('input', path('hand.ply'));
  await page.waitForFunction(() => /^\d+ vertices$/.test(document.querySelector('output').textContent));
  await page.close();
});

for (const loader of ['file', 'binary']) {
  test(`esbuild with the loader ${loader}`, async () => {
    writeSources('esbuild');
    const built = `esbuild-${loader}`;
    await esbuild.build({
      entryPoints: [path('esbuild', 'main.js')], bundle: true, format: 'esm', target: 'es2022', outdir: path(built),
      loader: { '.wasm': loader }, logLevel: 'error',
    });
    cpSync(path('esbuild', 'index.html'), path(built, 'index.html'));
    await expectAnswer(await serve(built));
  });
}

const viteOptions = (root) => ({ root, configFile: false, logLevel: 'error', build: { target: 'es2022' } });

test('Vite', async () => {
  writeSources('vite');
  await vite.build(viteOptions(path('vite')));
  await expectAnswer(await serve('vite/dist'));
});

test('the server of Vite for development', async () => {
  writeSources('vite');
  const server = await vite.createServer({ ...viteOptions(path('vite')), server: { host: '127.0.0.1', port: 0 } });
  await server.listen();
  await expectAnswer(server.resolvedUrls.local[0]);
  await server.close();
});

test('webpack', async () => {
  writeSources('webpack');
  const stats = await promisify(webpack)({
    mode: 'production', context: path('webpack'), entry: './main.js', output: { path: path('webpack', 'dist') },
    performance: { hints: false },
  });
  assert.deepEqual(stats.toJson({ all: false, errors: true, warnings: true }), { errors: [], warnings: [] });
  cpSync(path('webpack', 'index.html'), path('webpack', 'dist', 'index.html'));
  await expectAnswer(await serve('webpack/dist'));
});

test('the example with three.js: a click colors the neighborhood and makes a patch, a brush paints', async () => {
  cpSync(process.env.MESHHOOD_EXAMPLE, path('example'), { recursive: true, filter: (file) => !/node_modules/.test(file) });
  await vite.build(viteOptions(path('example')));
  const page = await browser.newPage({ viewport: { width: 900, height: 700 } });
  page.on('pageerror', (error) => { throw error; });
  await page.goto(await serve('example/dist'));
  await page.waitForFunction(() => document.body.dataset.ready === 'true');
  const [green, orange, pink] = [[0, 158, 115], [213, 94, 0], [204, 121, 167]];
  const seen = async (color) => {
    const pixels = await countPixels(page, color);
    console.log(`${pixels} pixels of ${color}`);
    return pixels > 500;
  };
  assert.ok(!(await seen(green)) && !(await seen(orange)) && !(await seen(pink)));
  const [x, y] = [450, 500];
  await page.mouse.click(x, y);
  await page.waitForFunction(() => /^Vertex \d+: \d+ vertices\.$/.test(document.getElementById('result').textContent));
  assert.ok(await seen(green), 'the neighborhood');
  assert.ok(await seen(pink), 'the patch');
  const picture = (name) => process.env.MESHHOOD_PICTURES
    && page.screenshot({ path: join(process.env.MESHHOOD_PICTURES, name) });
  await picture('three_patch.png');
  await page.keyboard.down('Shift');
  await page.mouse.move(x - 40, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y + 10, { steps: 8 });
  await page.mouse.up();
  await page.keyboard.up('Shift');
  assert.ok(await seen(orange), 'the brush');
  await picture('three.png');
  await page.close();
});
