// SPDX-License-Identifier: MIT
// Measures the package in Chromium and writes docs/benchmarks/web.md. After `tools/build_viewer`:
//
//     node bench/web/run.mjs MESH.ply...
import { readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { cpus, loadavg } from 'node:os';
import { basename, dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '..', '..');
process.env.MESHHOOD_VIEWER_SOURCES ??= join(root, 'viewer');
const { launch } = await import('../../tests/viewer/browser.mjs');

const meshes = process.argv.slice(2);
if (meshes.length === 0) throw new Error('usage: node bench/web/run.mjs MESH.ply...');

const TYPES = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.ply': 'application/octet-stream' };

function fileOf(url) {
  const [, first, second] = url.split('/');
  if (first === 'mesh') return meshes[Number(second)];
  return first === 'package' ? join(root, 'build', 'wasm', 'npm', second) : join(here, first);
}

/** Serves this folder, the package and the meshes to this machine alone. */
async function serve() {
  const server = createServer((request, response) => {
    if (request.url === '/') return response.setHeader('content-type', 'text/html').end('<!doctype html>');
    try {
      const file = fileOf(request.url);
      response.setHeader('content-type', TYPES[extname(file)] ?? 'application/octet-stream');
      response.end(readFileSync(file));
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return server;
}

const format = (value) => (value < 10 ? value.toFixed(2) : Math.round(value).toLocaleString('en'));

function table(name, { vertices, build, memory, rows }) {
  const lines = rows.map(({ radius, found, exact, bfs, js }) =>
    `| ${radius} | ${format(found)} | ${format(exact)} | ${format(bfs)} | ${format(js)} | ${(bfs / exact).toFixed(1)} | ` +
    `${(js / exact).toFixed(1)} |`);
  return [
    `## ${name}`, '',
    `${vertices.toLocaleString('en')} vertices; the index was built in ${build.toFixed(1)} s; the instance has ` +
      `${Math.round(memory / 2 ** 20)} MB after all queries.`, '',
    '| radius | found | exact | bfs | bfs in JavaScript | × bfs | × JavaScript |',
    '| ---: | ---: | ---: | ---: | ---: | ---: | ---: |', ...lines, '',
  ];
}

const server = await serve();
const browser = await launch();
const page = await browser.newPage();
await page.goto(`http://127.0.0.1:${server.address().port}/`);
const load = loadavg()[0];
const busy = load > cpus().length / 2
  ? [`**The machine was busy** (load ${load.toFixed(0)} on ${cpus().length} processors): the times are too long, and the ratios rough.`, '']
  : [];
const text = [
  '# Speed in the browser', '',
  'Written by `node bench/web/run.mjs` after `tools/build_viewer`; do not edit.', '',
  `µs a query, on one thread of Chromium ${browser.version()} without a window, ${cpus()[0].model.trim()}. 32 vertices, warm; the`,
  'median of 9 blocks of each method in turn. `exact` and `bfs` are the library in WebAssembly, with vectors of 128 bits;',
  '*bfs in JavaScript* is bench/web/bfs.js. Radii are in mean edge lengths. × is the ratio to exact.', '', ...busy,
];
for (const [i, mesh] of meshes.entries()) {
  const result = await page.evaluate(async (i) => (await import('/measure.js')).measure(`/mesh/${i}`), i);
  console.log(mesh, JSON.stringify(result));
  text.push(...table(basename(mesh, extname(mesh)), result));
}
await browser.close();
server.close();
writeFileSync(join(root, 'docs', 'benchmarks', 'web.md'), `${text.join('\n').trimEnd()}\n`);
