// SPDX-License-Identifier: MIT
// The pages of the site in Chromium, from the folder without a server, on a wide and on a narrow screen, light and dark:
// accessibility by axe, nothing wider than the screen, the search, and the viewer that the start page loads.
import assert from 'node:assert/strict';
import { mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { launch } from '../viewer/browser.mjs';

const site = process.env.MESHHOOD_SITE;
const pictures = process.env.MESHHOOD_PICTURES;
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const WIDE = [1400, 'light'];
const NARROW = [390, 'light'];
const DARK = [1400, 'dark'];

// Pages of the site; those of Sphinx, and the viewer's page, which tests/viewer checks, are others'.
const pages = readdirSync(site, { recursive: true })
  .filter((file) => file.endsWith('.html') && !file.startsWith('_') && !/^(genindex|search|py-modindex)/.test(file))
  .sort();

// Pages of each kind, enough for the colors of a theme.
const KINDS = /^(index|gallery\/(index|brush)|reference\/(python|javascript|cpp_search)|queries|how_it_works)\.html$/;

let browser;
before(async () => {
  mkdirSync(pictures, { recursive: true });
  browser = await launch();
});
after(() => browser.close());

async function open(file, [width, colorScheme], hash = '') {
  const page = await browser.newPage({ viewport: { width, height: 1000 }, colorScheme });
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(`${pathToFileURL(join(site, file))}${hash}`);
  return { page, errors };
}

function described({ id, help, nodes }) {
  return `${id}: ${help}: ${nodes.slice(0, 3).map(({ target }) => target.join(' ')).join('; ')} (${nodes.length})`;
}

for (const [screen, shown] of [[WIDE, pages], [NARROW, pages], [DARK, pages.filter((file) => KINDS.test(file))]]) {
  test(`pages are accessible and fit at ${screen.join(' pixels, ')}`, async () => {
    const faults = [];
    for (const file of shown) {
      const { page, errors } = await open(file, screen);
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => window.axe.run());
      const excess = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      const cut = await page.evaluate(() => [...document.querySelectorAll('article :is(h1, h2, h3)')]
        .filter((heading) => heading.scrollWidth > heading.clientWidth).map((heading) => heading.textContent));
      const titles = await page.locator('article h1').count();
      faults.push(...[...errors, ...violations.map(described)].map((fault) => `${file}: ${fault}`));
      if (excess > 0) faults.push(`${file}: ${excess} pixels wider than the screen`);
      if (cut.length > 0) faults.push(`${file}: cut headings: ${cut.join(', ')}`);
      if (titles !== 1) faults.push(`${file}: ${titles} titles`);
      await page.screenshot({ path: join(pictures, `${file.replace(/\W/g, '_')}_${screen.join('_')}.png`) });
      await page.close();
    }
    console.log(`${shown.length} pages at ${screen.join(' pixels, ')}`);
    assert.deepEqual(faults, []);
    assert.ok(shown.length >= (screen === DARK ? 8 : 50));
  });
}

test('the search finds a name without a server', async () => {
  const { page } = await open('search.html', WIDE, '?q=stroke');
  await page.waitForSelector('#search-results li');
  const found = await page.locator('#search-results li').allInnerTexts();
  assert.ok(found.some((text) => text.includes('MeshIndex.stroke')), found.join('\n'));
  await page.close();
});

test('the start page loads the viewer when its button is pressed', async () => {
  const { page, errors } = await open('index.html', WIDE);
  assert.equal(await page.locator('iframe').count(), 0);
  await page.click('#live button');
  const frame = await (await page.waitForSelector('#live iframe')).contentFrame();
  await frame.waitForFunction(() => document.body.dataset.mesh === 'folds' && window.meshhoodPage.isAnswered);
  await page.locator('#live').screenshot({ path: join(pictures, 'viewer.png') });
  assert.deepEqual(errors, []);
  await page.close();
});
