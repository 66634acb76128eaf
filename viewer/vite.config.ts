// SPDX-License-Identifier: MIT
// One HTML file that needs neither server nor network: scripts, style, worker and WebAssembly are inside.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

import { defineConfig, type Plugin } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const path = (relative: string) => fileURLToPath(new URL(relative, import.meta.url));

/** Compresses the WebAssembly module before it becomes text, which saves half of the page. */
const compressedModule = (): Plugin => ({
  name: 'compressed-module',
  enforce: 'pre',
  transform(code, id) {
    if (!id.endsWith('/instance.js')) return undefined;
    const address = "new URL('./meshhood.wasm', import.meta.url)";
    if (!code.includes(address)) this.error(`expected ${address} in ${id}`);
    const bytes = gzipSync(readFileSync(path('../build/wasm/npm/meshhood.wasm')), { level: 9 });
    return code.replace(
      address,
      `fetch('data:application/gzip;base64,${bytes.toString('base64')}').then(
        ({ body }) => new Response(body.pipeThrough(new DecompressionStream('gzip'))),
      )`,
    );
  },
});

/** Adds the licenses of all that the page contains. */
const licenses = (): Plugin => ({
  name: 'licenses',
  transformIndexHtml() {
    const children = ['../LICENSE', '../NOTICE'].map((file) => readFileSync(path(file), 'utf8')).join('\n');
    return [{ tag: 'script', attrs: { type: 'text/plain', id: 'licenses' }, children, injectTo: 'body' }];
  },
});

export default defineConfig({
  base: './',
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), licenses()],
  resolve: { alias: { meshhood: path('../build/wasm/npm/meshhood.js') } },
  // Browsers refuse modules in workers of a page from file://.
  worker: { format: 'iife', plugins: () => [compressedModule()] },
  build: {
    outDir: path('../build/viewer'),
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: 4096,
    rollupOptions: { input: path('viewer.html') },
  },
});
