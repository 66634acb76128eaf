// SPDX-License-Identifier: MIT
// Modules of the page that need no browser. MESHHOOD_VIEWER_SOURCES is the folder of the page's sources.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const sources = process.env.MESHHOOD_VIEWER_SOURCES;
const require = createRequire(join(sources, 'package.json'));
const vite = await import(pathToFileURL(require.resolve('vite')));

/** What viewer/src/NAME.ts exports. */
export async function load(name) {
  const [{ output: [{ code }] }] = await vite.build({
    configFile: false, logLevel: 'error',
    build: { write: false, minify: false, lib: { entry: join(sources, 'src', `${name}.ts`), formats: ['es'], fileName: name } },
  });
  return import(`data:text/javascript,${encodeURIComponent(code)}`);
}
