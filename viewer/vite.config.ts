// SPDX-License-Identifier: MIT
// One HTML file that needs neither server nor network: scripts, style, worker and WebAssembly are inside.
import { fileURLToPath } from 'node:url';

import { defineConfig } from 'vite';
import { viteSingleFile } from 'vite-plugin-singlefile';

const path = (relative: string) => fileURLToPath(new URL(relative, import.meta.url));

export default defineConfig({
  base: './',
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  resolve: { alias: { meshhood: path('../build/wasm/npm/meshhood.js') } },
  worker: { format: 'iife' }, // browsers refuse modules in workers of a page from file://,
  build: {
    outDir: path('../build/viewer'),
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: 4096,
    rollupOptions: { input: path('viewer.html') },
  },
});
