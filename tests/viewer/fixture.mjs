// SPDX-License-Identifier: MIT
// What files of tests share: a browser, a folder for their files, and the command line.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach } from 'node:test';

import { launch } from './browser.mjs';

/** A browser, and a folder. Both are gone after the last test of the file, pages after the test that opened them. */
export async function launchWithFolder() {
  const folder = mkdtempSync(join(tmpdir(), 'meshhood-'));
  const browser = await launch();
  afterEach(() => Promise.all(browser.contexts().map((context) => context.close())));
  after(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
  });
  return { browser, folder };
}

/** The command line, run in a folder. It finds the built page, and returns what it prints. */
export function commandLine(folder) {
  const env = { ...process.env, MESHHOOD_VIEWER: process.env.MESHHOOD_PAGE };
  return (...options) =>
    execFileSync(process.env.MESHHOOD_CLI, options, { cwd: folder, encoding: 'utf8', env, stdio: 'pipe' });
}
