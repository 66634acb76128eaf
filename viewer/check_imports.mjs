// SPDX-License-Identifier: MIT
// Fails if modules import each other in a circle, also by `import type`, which bundlers do not see. The folder is an
// argument; by default it is that of the page.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

import ts from 'typescript';

const folder = process.argv[2] ?? fileURLToPath(new URL('src', import.meta.url));

/** The modules of the folder that a module imports, by their names. */
function importsOf(name) {
  const { importedFiles } = ts.preProcessFile(readFileSync(join(folder, name), 'utf8'));
  const imported = importedFiles.map(({ fileName }) => /^\.\/([^?]*)/.exec(fileName)?.[1]);
  return imported.filter((stem) => modules.has(`${stem}.ts`)).map((stem) => `${stem}.ts`);
}

const modules = new Set(readdirSync(folder).filter((name) => name.endsWith('.ts')));
const finished = new Set();

/** The first circle that can be reached from `name`, or null. `path` leads from the first module to `name`. */
function circleFrom(name, path = []) {
  if (path.includes(name)) return [...path.slice(path.indexOf(name)), name];
  if (finished.has(name)) return null;
  for (const next of importsOf(name)) {
    const circle = circleFrom(next, [...path, name]);
    if (circle !== null) return circle;
  }
  finished.add(name);
  return null;
}

for (const name of modules) {
  const circle = circleFrom(name);
  if (circle === null) continue;
  console.error(`modules import each other in a circle: ${circle.join(' -> ')}`);
  process.exit(1);
}
if (modules.size === 0) throw new Error(`${folder} has no modules`);
