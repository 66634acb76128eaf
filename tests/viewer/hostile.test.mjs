// SPDX-License-Identifier: MIT
// The page under files, names and links made to mislead it: no script of theirs runs, nothing hangs, and what is shown is
// right or an error. The variables of the environment are those of viewer.test.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, renameSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { drop, idsOf, openPage, show, waitForAnswers, waitForPixels } from './browser.mjs';
import { launchWithFolder } from './fixture.mjs';

const { browser, folder } = await launchWithFolder();

/** Opens the built page; what a script of a file would do fails the test. */
async function openBuilt(hash = '#example=terrain&vertex=5&radius=3') {
  const page = await openPage(browser, process.env.MESHHOOD_PAGE, { hash });
  return watch(page);
}

async function watch(page) {
  page.on('dialog', (dialog) => { throw new Error(`a script has run: ${dialog.message()}`); });
  page.on('request', (request) => {
    if (!/^(blob|data|file):/.test(request.url())) throw new Error(`a request for ${request.url()}`);
  });
  return page;
}

/** No element of the page comes from a text. */
async function expectNoMarkup(page) {
  assert.equal(await page.locator('img, iframe, b:not(#verdict b, #result b, #color-key b), body script[src]').count(), 0);
}

const MARKUP = '<img src=x onerror=alert(1)><b>&amp;"\'`${alert(1)}';
const lines = (lineEnd, ...all) => Buffer.from(all.join(lineEnd) + lineEnd, 'latin1');
const COLUMNS = ['property float x', 'property float y', 'property float z'];
const FACE = ['element face 1', 'property list uchar int vertex_indices', 'end_header'];
const TRIANGLE = Buffer.from([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);

/** A triangle whose vertices have a further property; the first byte of the data is a line feed. */
function binaryPly({ comment = 'plain', lineEnd = '\n', property = 'float heat' }) {
  const rows = Buffer.from(Float32Array.of(0, 0, 0, 10, 1, 0, 0, 20, 0, 1, 0, 30).buffer);
  rows[0] = '\n'.charCodeAt(0); // x becomes 1.4e-44
  const header = lines(lineEnd, 'ply', 'format binary_little_endian 1.0', `comment ${comment}`, 'element vertex 3',
    ...COLUMNS, `property ${property}`, ...FACE);
  return Buffer.concat([header, rows, TRIANGLE]);
}

const textPly = (heats, property = 'double heat') => lines('\n', 'ply', 'format ascii 1.0', 'element vertex 3', ...COLUMNS,
  `property ${property}`, ...FACE, `0 0 0 ${heats[0]}`, `1 0 0 ${heats[1]}`, `0 1 0 ${heats[2]}`, '3 0 1 2');

/** Drops a file, and returns what the page shows as the colors of its own property. */
async function valuesOf(page, name, content) {
  await show(page, name, content);
  const option = page.locator('#own-colors option');
  assert.equal(await option.count(), 1, `${name} has a property`);
  await page.selectOption('#color', await option.getAttribute('value'));
  return page.evaluate(() => Array.from(window.meshhoodPage.values));
}

test('the properties of a file are read as the library reads its header', async () => {
  const page = await openBuilt();
  await page.click('#display summary');
  const cases = {
    plain: {}, comment: { comment: 'this is not the end_header' }, word: { comment: 'end_header' },
    element: { comment: 'element vertex 1' }, cr: { lineEnd: '\r' }, crlf: { lineEnd: '\r\n' },
    markup: { property: 'float <script>alert(1)</script>' }, proto: { property: 'float __proto__' },
    blank: { property: 'float no\xa0break' }, long: { comment: 'long '.repeat(20_000) },
  };
  for (const [name, options] of Object.entries(cases)) {
    assert.deepEqual(await valuesOf(page, `${name}.ply`, binaryPly(options)), [10, 20, 30], name);
  }
  await expectNoMarkup(page);
});

test('the properties of a file in text are read from the lines that the library reads, under their names', async () => {
  const page = await openBuilt();
  await page.click('#display summary');
  const triangle = ['0 0 0', '1 0 0', '0 1 0'].map((place, v) => `${place} ${10 * v}`);
  const [element, list, end] = FACE;
  const file = ({ name = 'heat', before = [], more = [], after = [element, list], rows }) => Buffer.from(['ply',
    'format ascii 1.0', ...before, 'element vertex 3', ...COLUMNS, `property float ${name}`, ...more, ...after, end, ...rows,
  ].join('\n'));
  const cases = {
    further: { rows: [...triangle.map((row) => `${row} 99`), '3 0 1 2'] },
    furtherLater: { rows: [triangle[0], '', `${triangle[1]} `, triangle[2], '3 0 1 2 99'] },
    running: { rows: ['0 0', '0 0 1 0', '0 10 0 1 0 20', '3 0 1 2'] },
    shared: { rows: [`${triangle.join(' ')} 3 0 1 2`] },
    facesFirst: { before: [element, list], after: [], rows: ['3 0 1 2 99', ...triangle] },
    facesBeside: { before: [element, 'property uchar flag', list], after: [], rows: ['7', '3 0 1 2', ...triangle] },
    lists: { more: ['property list uchar int owners'], rows: [`${triangle[0]} 2 7 8`, `${triangle[1]} 0`, triangle[2], '3 0 1 2'] },
    accents: { name: 'temp\u00e9rature\u00c0', rows: [...triangle, '3 0 1 2'] },
  };
  for (const [name, options] of Object.entries(cases)) {
    assert.deepEqual(await valuesOf(page, `${name}.ply`, file(options)), [0, 10, 20], name);
  }
  assert.equal((await page.locator('#legend span').allTextContents())[1], 'temp\u00e9rature\u00c0');
});

test('values that are huge, denormal or not numbers have the right colors, or none', async () => {
  const page = await openBuilt();
  await page.click('#display summary');
  const legend = () => page.locator('#legend span').allTextContents();
  for (const [name, texts, range] of [
    ['huge', ['1e300', '-1e300', '0'], ['-1e+300', '1e+300']],
    ['most', ['1.7e308', '-1.7e308', '0'], ['-1.7e+308', '1.7e+308']],
    ['denormal', ['5e-324', '0', '1e-310'], ['0', '1e-310']],
    ['signs', ['-1', '0', '4'], ['-4', '4']],
    ['none', ['nan', 'inf', '-inf'], ['0', '1']],
  ]) {
    const values = await valuesOf(page, `${name}.ply`, textPly(texts));
    assert.deepEqual(values, texts.map((text) => ({ nan: NaN, inf: NaN, '-inf': NaN })[text] ?? Number(text)), name);
    const [low, , high] = await legend();
    assert.deepEqual([low, high], range, name);
  }
});

/** A bumpy grid whose edges have about the length `size`. */
function bumpyGrid(size) {
  const side = 12;
  const file = ['ply', 'format ascii 1.0', `element vertex ${side * side}`, ...COLUMNS.map((c) => c.replace('float', 'double')),
    `element face ${(side - 1) ** 2}`, 'property list uchar int vertex_indices', 'end_header'];
  for (let v = 0; v < side * side; ++v) {
    const [row, column] = [Math.floor(v / side), v % side];
    file.push([row, column, (row * column) % 3].map((x) => x * size).join(' '));
  }
  for (let v = 0; v < side * (side - 1); ++v) {
    if (v % side < side - 1) file.push(`4 ${v} ${v + 1} ${v + side + 1} ${v + side}`);
  }
  return lines('\n', ...file);
}

for (const size of [1e-300, 1e-40, 1e-20, 1, 1e20, 1e38, 1e149]) {
  test(`a mesh with edges of ${size} is seen`, async () => {
    const page = await openBuilt();
    const name = `size${size}.ply`;
    await show(page, name, bumpyGrid(size));
    await page.locator('#canvas').press('a');
    assert.equal((await idsOf(page, 'exact')).length, 144);
    await waitForPixels(page, [0, 150, 110], 10_000);
    const camera = await page.evaluate(() => window.meshhoodPage.view.cameraState);
    assert.ok(camera.every(Number.isFinite) && Math.hypot(...camera) > size, `${camera}`);
  });
}

const NAMES = [
  `${MARKUP}.obj`, '"><script>alert(1)</script>.obj', 'javascript:alert(1).obj', '__proto__.obj', '.obj',
  '\x01\x07\x1b[2J\n\u202e.obj', `${'n'.repeat(5000)}.obj`,
];

for (const name of NAMES) {
  test(`the name ${JSON.stringify(name.slice(0, 40))} is shown as it is, and takes no more than its place`, async () => {
    const page = await openBuilt();
    await show(page, name, Buffer.from('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'));
    assert.equal(await page.textContent('#name'), name);
    await expectNoMarkup(page);
    const isSeen = async (selector) => {
      const { y, height } = await page.locator(selector).boundingBox();
      return y >= 0 && y + height <= 800;
    };
    assert.ok(await isSeen('#open'), 'the panel is still seen');
    await drop(page, name, Buffer.from('v 0\n'));
    await page.waitForSelector('#error:not([hidden])');
    assert.match(await page.textContent('#error p'), /:1:4: vertex 1 has no y, expected x y z$/);
    assert.ok(await isSeen('#error'), 'the error is seen');
    await expectNoMarkup(page);
    const [saved] = await Promise.all([page.waitForEvent('download'), page.click('#save-ids')]);
    assert.doesNotMatch(saved.suggestedFilename(), /[/\\<>]/);
  });
}

test('the file that was dropped last is shown, whatever takes longer to load', async () => {
  const page = await openBuilt();
  const shown = await page.evaluate(async (text) => {
    const files = [new File([text, new Uint8Array(48 << 20).fill(10)], 'first.obj'), new File([text], 'second.obj')];
    for (const file of files) {
      const transfer = new DataTransfer();
      transfer.items.add(file);
      window.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }
    await new Promise((resolve) => setTimeout(resolve, 5000));
    return document.getElementById('name').textContent;
  }, 'v 0 0 0\nv 1 0 0\nf 1 2\n');
  assert.equal(shown, 'second.obj');
});

test('a link that says anything shows something', async () => {
  const links = [
    `#example=${encodeURIComponent(MARKUP)}&color=${encodeURIComponent(MARKUP)}&without=${encodeURIComponent(MARKUP)}`,
    '#example=terrain&vertex=1e300&radius=1e300&camera=1e308,1e308,1e308,-1e308,0,0',
    '#example=__proto__&vertex=-1&radius=-5&camera=0,0,0,0,0,0&cut=w',
    '#example=terrain&vertex=NaN&radius=Infinity&camera=1,2,3&color=ply:x',
    `#${'&'.repeat(10_000)}%00%ff`,
  ];
  for (const hash of links) {
    const page = await openBuilt(hash);
    await waitForAnswers(page);
    assert.ok((await idsOf(page, 'exact')).length > 0, hash.slice(0, 60));
    await expectNoMarkup(page);
    await page.close();
  }
});

test('a page of the command line holds hostile names, comments and values as they are', async () => {
  const environment = { ...process.env, MESHHOOD_VIEWER: process.env.MESHHOOD_PAGE };
  const name = `</script><script>alert(1)</script><!-- meshhood:page -->.ply`.replaceAll('/', '\u2215');
  writeFileSync(join(folder, 'mesh.ply'), binaryPly({ comment: '</script><script>alert(1)</script>' }));
  renameSync(join(folder, 'mesh.ply'), join(folder, name));
  const values = `<b>'"&.txt`;
  writeFileSync(join(folder, values), 'nan\n-inf\n3e38\n');
  execFileSync(process.env.MESHHOOD_CLI, ['view', name, '-v', '1', '-r', '1e300', '--values', values, '-o', 'page.html'],
    { cwd: folder, env: environment, stdio: 'pipe' });
  assert.equal(readFileSync(join(folder, 'page.html'), 'utf8').split('alert(1)</script>').length, 1);
  const page = await watch(await openPage(browser, join(folder, 'page.html')));
  assert.equal(await page.textContent('#name'), name);
  assert.deepEqual(await idsOf(page, 'exact'), [0, 1, 2]);
  assert.equal((await page.locator('#legend span').allTextContents())[1], `<b>'"&`);
  await expectNoMarkup(page);
});
