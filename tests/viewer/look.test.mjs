// SPDX-License-Identifier: MIT
// What a stranger sees of the page: what it is, what the colors mean, a picture that is framed, on every screen, in light
// and in the dark. The variables of the environment are those of viewer.test.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { colorsAt, countPixels, drop, idsOf, openPage, placeOf, setVertex, show } from './browser.mjs';
import { commandLine, launchWithFolder } from './fixture.mjs';

const { browser, folder } = await launchWithFolder();
const pictures = process.env.MESHHOOD_PICTURES;
mkdirSync(pictures, { recursive: true });
const meshhood = commandLine(folder);
const open = (hash, options) => openPage(browser, process.env.MESHHOOD_PAGE, { hash, ...options });
const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** The rows of the key that are seen: their words and numbers. */
const keyOf = (page) => page.locator('#color-key li:visible').evaluateAll((rows) =>
  rows.map((row) => [...row.querySelectorAll('span:not(.swatch), b')].map((part) => part.textContent)));

test('the page says what it is, and over the mesh what the colors mean', async () => {
  const page = await open('#example=scroll');
  assert.equal(await page.textContent('h1'), 'meshhood: what is connected with a vertex inside a ball around it');
  const count = async (method) => (await idsOf(page, method)).length;
  const [exact, ball, paper] = [await count('exact'), await count('ball'), await count('paper')];
  const format = (number) => number.toLocaleString('en');
  assert.deepEqual(await keyOf(page), [
    ['connected within the ball: the answer', format(exact)],
    ['near, but not connected', format(ball - exact)],
    ['of these, extra of the approximate method', format(paper - exact)],
  ]);
  await page.uncheck('tr[data-method=ball] input');
  await page.waitForFunction(() => window.meshhoodPage.isAnswered);
  assert.deepEqual((await keyOf(page))[1], ['extra of the approximate method', format(paper - exact)]);
  assert.equal((await keyOf(page)).length, 2);
  await page.click('#display summary');
  await page.selectOption('#color', 'count');
  assert.deepEqual(await keyOf(page), []);
});

test('the first sentence below the table is about wrong vertices, and screen readers say it', async () => {
  const page = await open('#example=scroll');
  assert.equal(await page.getAttribute('#result', 'aria-live'), 'polite');
  const differenceOf = async () => (await idsOf(page, 'ball')).length - (await idsOf(page, 'exact')).length;
  const expectResult = async () => assert.ok((await page.textContent('#result')).startsWith(
    `The plain ball has ${(await differenceOf()).toLocaleString('en')} wrong vertices`));
  await expectResult();
  await setVertex(page, 50_000);
  await expectResult();
  await page.waitForFunction(() => /as fast/.test(document.getElementById('verdict').textContent));
  assert.match(await page.textContent('#verdict'),
    /^(The index is (about as fast|[\d.]+ times as fast) as breadth-first search|Breadth-first search is [\d.]+ times as fast as the index here)\.$/);
});

test('an answer that was passed has words of its own', async () => {
  meshhood('generate', 'plates', '--vertices', '800', '-o', 'plates.ply');
  execFileSync('sh', ['-c', 'printf "1\\n3\\n5\\n" > few.txt'], { cwd: folder });
  meshhood('view', 'plates.ply', '--ids', 'few.txt', '-o', 'few.html');
  const page = await openPage(browser, join(folder, 'few.html'));
  assert.deepEqual(await keyOf(page), [['the vertices that were passed to the page', '3']]);
});

/** A flat grid with edges of length 1, around the origin. */
function grid(side) {
  const lines = [];
  for (let v = 0; v < side * side; ++v) lines.push(`v ${Math.floor(v / side) - (side - 1) / 2} ${(v % side) - (side - 1) / 2} 0`);
  for (let v = 1; v < side * (side - 1); ++v) {
    if (v % side !== 0) lines.push(`f ${v} ${v + side} ${v + side + 1} ${v + 1}`);
  }
  return Buffer.from(`${lines.join('\n')}\n`);
}

test('the border of a region is that of the ball, not of the triangles', async () => {
  const page = await open('#example=terrain&vertex=5&radius=3');
  const [side, radius] = [13, 3.3];
  const center = (side * side - 1) / 2;
  await show(page, 'grid.obj', grid(side));
  await page.locator('#canvas').press('b');
  await setVertex(page, center);
  await page.fill('#radius-units', String(radius));
  await page.press('#radius-units', 'Enter');
  await page.evaluate(() => { window.meshhoodPage.view.cameraState = [0, 0, 16, 0, 0, 0]; });
  await page.waitForTimeout(500);
  // Seen from above, places of the plane are an affine map of the vertices.
  const [at, x, y] = [await placeOf(page, center), await placeOf(page, center + side), await placeOf(page, center + 1)];
  const around = (factor) => Array.from({ length: 72 }, (_, i) => {
    const [a, b] = [Math.cos, Math.sin].map((f) => factor * radius * f((2 * Math.PI * (i + 0.5)) / 72));
    return { x: at.x + a * (x.x - at.x) + b * (y.x - at.x), y: at.y + a * (x.y - at.y) + b * (y.y - at.y) };
  });
  const isGreen = ([r, g, b]) => g > 1.5 * r && g > 1.1 * b;
  const [inner, outer] = [await colorsAt(page, around(0.97)), await colorsAt(page, around(1.03))];
  // In a corner that no vertex of the ball has, the pixel belongs to no answer.
  const green = inner.filter(isGreen).length;
  console.log(`${green} of 72 places within the border are green, ${outer.filter(isGreen).length} beyond it`);
  assert.ok(green >= 64);
  assert.equal(outer.filter(isGreen).length, 0);
  await page.screenshot({ path: join(pictures, 'border.png') });
});

test('the marker is dim where the mesh hides its vertex', async () => {
  meshhood('generate', 'plates', '--vertices', '800', '-o', 'plates.ply');
  const page = await open('#example=terrain&vertex=5&radius=3');
  await show(page, 'plates.ply', readFileSync(join(folder, 'plates.ply')));
  await page.locator('#canvas').press('b');
  const orange = async (vertex, height) => {
    await setVertex(page, vertex);
    await page.evaluate((height) => { window.meshhoodPage.view.cameraState = [0, 1, height, 0, 0, 0]; }, height);
    await page.waitForTimeout(300);
    return { pixels: await countPixels(page, [213, 94, 0], 40), isHidden: await page.evaluate(() => window.meshhoodPage.view.isVertexHidden) };
  };
  const seen = await orange(610, 60); // of the upper plate, from above
  const hidden = await orange(610, -60);
  console.log(`${seen.pixels} orange pixels, ${hidden.pixels} of the hidden one`);
  assert.ok(!seen.isHidden && seen.pixels > 100);
  assert.ok(hidden.isHidden && hidden.pixels < seen.pixels / 4);
});

/** Where the ball of the query is on the canvas, in pixels. */
const ballOf = (page) => page.evaluate(() => {
  const { view } = window.meshhoodPage;
  const vertex = Number(document.getElementById('vertex').value);
  const distance = view.camera.position.distanceTo(view.position(vertex));
  const radius = Number(document.getElementById('radius-units').value) / view.unit;
  const height = document.getElementById('canvas').clientHeight;
  const slope = Math.tan((view.camera.fov * Math.PI) / 360);
  return { ...view.toCanvas(vertex), radius: ((radius / distance) * height) / 2 / slope };
});

for (const name of ['scroll', 'folds', 'knot', 'terrain']) {
  for (const [screen, options] of [['wide', {}], ['phone', PHONE]]) {
    test(`the example ${name} shows a difference between the methods, well framed on a ${screen} screen`, async () => {
      const page = await open(`#example=${name}`, options);
      const [exact, ball] = [await idsOf(page, 'exact'), await idsOf(page, 'ball')];
      assert.ok(ball.length > 1.2 * exact.length && exact.length > 100, `${exact.length} of ${ball.length}`);
      assert.equal(await page.evaluate(() => window.meshhoodPage.view.isVertexHidden), false);
      assert.equal(await page.evaluate(() => document.getElementById('nearer').checked), false);
      const { x, y, radius } = await ballOf(page);
      const [panel, about] = [await page.locator('#panel').boundingBox(), await page.locator('#about').boundingBox()];
      const { width, height } = page.viewportSize();
      const area = screen === 'phone'
        ? { left: 0, right: width, top: about.y + about.height, bottom: panel.y }
        : { left: 0, right: panel.x, top: 0, bottom: height };
      assert.ok(x - radius >= area.left && x + radius <= area.right, `${x}, ${radius}`);
      assert.ok(y - radius >= area.top && y + radius <= area.bottom, `${y}, ${radius}`);
      assert.ok(2 * radius > 0.5 * Math.min(area.right - area.left, area.bottom - area.top), 'the ball is large');
      const green = await countPixels(page, [0, 150, 110]);
      const others = await countPixels(page, [15, 100, 155]) + await countPixels(page, [215, 205, 65]);
      console.log(`${name}: ${green} green pixels, ${others} of other answers`);
      assert.ok(green > 500 && others > 500);
      await page.screenshot({ path: join(pictures, `${name}_${screen}.png`) });
    });
  }
}

test('a vertex that was passed is seen although nothing is hidden', async () => {
  meshhood('generate', 'plates', '--vertices', '800', '-o', 'plates.ply');
  for (const vertex of [210, 610]) {
    meshhood('view', 'plates.ply', '-v', String(vertex), '-r', '3', '-o', 'passed.html');
    const page = await openPage(browser, join(folder, 'passed.html'));
    assert.equal(await page.evaluate(() => document.getElementById('nearer').checked), false);
    assert.equal(await page.evaluate(() => window.meshhoodPage.view.isVertexHidden), false);
    await page.close();
  }
});

test('without WebGL there is a message and nothing else', async () => {
  const page = await browser.newPage();
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function context(kind, ...options) {
      return /webgl/.test(kind) ? null : getContext.call(this, kind, ...options);
    };
  });
  await page.goto(pathToFileURL(process.env.MESHHOOD_PAGE).href);
  await page.waitForSelector('#error:not([hidden])');
  assert.match(await page.textContent('#error p'), /^This browser has no WebGL 2, by which the page draws the mesh\. .*another browser/);
  for (const id of ['panel', 'canvas', 'about', 'hint']) assert.ok(await page.isHidden(`#${id}`), id);
  assert.deepEqual(errors, []);
});

/** The contrasts of texts and lines with what is behind them, by the formula of WCAG 2. */
const contrastsOf = (page) => page.evaluate(() => {
  const parse = (color) => {
    const [r, g, b, a = 1] = color.match(/[\d.]+/g).map(Number);
    return { rgb: [r, g, b], a };
  };
  const over = (top, below) => top.rgb.map((x, i) => top.a * x + (1 - top.a) * below[i]);
  const style = (selector) => getComputedStyle(document.querySelector(selector));
  const page_ = parse(style('body').getPropertyValue('--background').replace(/^#(..)(..)(..)$/, (_, ...hex) =>
    `rgb(${hex.slice(0, 3).map((x) => parseInt(x, 16)).join(' ')})`)).rgb;
  const luminance = (rgb) => {
    const [r, g, b] = rgb.map((x) => (x / 255 <= 0.04045 ? x / 255 / 12.92 : ((x / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = (a, b) => {
    const [high, low] = [luminance(a), luminance(b)].sort((x, y) => y - x);
    return (high + 0.05) / (low + 0.05);
  };
  const behind = (selector) => over(parse(style(selector).backgroundColor), page_);
  const text = (selector, card) => contrast(over(parse(style(selector).color), behind(card)), behind(card));
  return {
    hint: text('#hint', '#hint'), title: text('h1', '#about'), facts: text('#facts', '#panel'), result: text('#result', '#panel'),
    swatch: contrast(over(parse(style('#about .swatch').borderTopColor), behind('#about')), behind('#about')),
    search: contrast(over(parse(style('tr[data-method=bfs] .swatch').borderTopColor), behind('#panel')), behind('#panel')),
  };
});

for (const colorScheme of ['light', 'dark']) {
  test(`hints and swatches are readable in ${colorScheme} colors`, async () => {
    const page = await open('#example=terrain', { colorScheme });
    const contrasts = await contrastsOf(page);
    console.log(JSON.stringify(contrasts));
    for (const [name, contrast] of Object.entries(contrasts)) {
      assert.ok(contrast >= (/swatch|search/.test(name) ? 2 : 4.5), `${name}: ${contrast}`);
    }
    await page.screenshot({ path: join(pictures, `terrain_${colorScheme}.png`) });
  });
}

test('on a phone the panel is one row at first, targets are large, and the picture has no edge', async () => {
  const page = await open('#example=scroll', PHONE);
  const panel = await page.locator('#panel').boundingBox();
  assert.ok(panel.height <= 64, `${panel.height}`);
  assert.equal(await page.getAttribute('#fold', 'aria-expanded'), 'false');
  const canvas = await page.locator('#canvas').boundingBox();
  assert.deepEqual([canvas.y, canvas.height], [0, 844]);
  await page.tap('#fold');
  await page.locator('#display summary').tap();
  const targets = page.locator('#panel button:visible, #panel select:visible, #panel input:visible:not([type=checkbox]), #panel summary, #panel .check, td label');
  for (const target of await targets.all()) {
    const { width, height } = await target.boundingBox();
    assert.ok(width >= 44 && height >= 44, `${await target.evaluate((element) => element.outerHTML.slice(0, 80))}: ${width} x ${height}`);
  }
  console.log(`${await targets.count()} targets`);
  await page.screenshot({ path: join(pictures, 'phone_open.png') });
});

test('a warning is not shown as an error', async () => {
  const page = await open('#example=terrain&vertex=5&radius=3');
  const ply = ['ply', 'format ascii 1.0', 'element vertex 3', ...['x', 'y', 'z'].map((p) => `property float ${p}`),
    'element face 1', 'property list uchar int vertex_indices', 'end_header', '0 0 0', '1 0 0', '0 1 0', '3 0 1 2', '7 7 7', ''].join('\n');
  await show(page, 'more.ply', Buffer.from(ply));
  assert.match(await page.textContent('#warning p'), /^more\.ply: accepted with a warning: .*data after the last element/);
  assert.ok(await page.isVisible('#warning'));
  assert.ok(await page.isHidden('#error'));
  assert.equal(await page.getAttribute('#warning', 'role'), 'status');
  const color = (id) => page.evaluate((id) => getComputedStyle(document.querySelector(`#${id}`)).color, id);
  assert.notEqual(await color('warning'), await color('error'));
  await page.click('#warning button');
  assert.ok(await page.isHidden('#warning'));
  // It is that of the mesh which is shown.
  await show(page, 'more.ply', Buffer.from(ply));
  await drop(page, 'broken.ply', Buffer.from('no mesh'));
  await page.waitForSelector('#error:not([hidden])');
  assert.ok(await page.isVisible('#warning'));
  await show(page, 'less.ply', Buffer.from(ply.replace('7 7 7\n', '')));
  assert.ok(await page.isHidden('#warning'));
});

test('the address has no digits of rounding errors', async () => {
  for (const name of ['scroll', 'folds', 'knot', 'terrain']) {
    const page = await open(`#example=${name}`);
    await page.locator('#canvas').press('b');
    const hash = await page.evaluate(() => location.hash);
    assert.match(hash, /&radius=\d+(\.\d{1,4})?&/, hash);
    await page.close();
  }
});
