// SPDX-License-Identifier: MIT
// The page without a mouse. The variables of the environment are those of viewer.test.mjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { openPage, waitForAnswers } from './browser.mjs';
import { launchWithFolder } from './fixture.mjs';

const { browser } = await launchWithFolder();
const open = () => openPage(browser, process.env.MESHHOOD_PAGE, { hash: '#example=terrain&vertex=15100&radius=10' });
const vertexOf = async (page) => Number(await page.inputValue('#vertex'));

test('the keyboard reaches the mesh, and a ring shows it', async () => {
  const page = await open();
  await page.getByRole('application', { name: /^The mesh\. Click a vertex/ }).waitFor();
  const outline = () => page.evaluate(() => {
    const { outlineStyle, outlineWidth } = getComputedStyle(document.getElementById('canvas'));
    return outlineStyle === 'none' ? 0 : parseFloat(outlineWidth);
  });
  assert.equal(await outline(), 0);
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'canvas');
  assert.ok(await outline() >= 2);
});

test('keys zoom', async () => {
  const page = await open();
  const distance = () => page.evaluate(() => {
    const { camera, controls } = window.meshhoodPage.view;
    return camera.position.distanceTo(controls.target);
  });
  const first = await distance();
  await page.keyboard.press('z');
  const nearer = await distance();
  assert.ok(nearer < 0.95 * first);
  await page.keyboard.press('x');
  assert.ok(Math.abs(await distance() - first) < 1e-3 * first);
});

test('Shift and an arrow walk from vertex to neighbor, in the direction of the arrow', async () => {
  const page = await open();
  // Rows have 300 vertices; of the six neighbors, each arrow takes another.
  const isNeighbor = (a, b) => [1, 299, 300].includes(Math.abs(a - b));
  const place = (vertex) => page.evaluate((v) => window.meshhoodPage.view.toCanvas(v), vertex);
  const directions = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const visited = new Set();
  for (const [key, [dx, dy]] of Object.entries(directions)) {
    for (let step = 0; step < 3; ++step) {
      const before = await vertexOf(page);
      await page.keyboard.press(`Shift+${key}`);
      await page.waitForFunction((v) => Number(document.getElementById('vertex').value) !== v, before);
      await waitForAnswers(page);
      const now = await vertexOf(page);
      visited.add(now);
      assert.ok(isNeighbor(before, now), `${before} to ${now}`);
      const [from, to] = [await place(before), await place(now)];
      assert.ok((to.x - from.x) * dx + (to.y - from.y) * dy > 0, `${key}: ${before} to ${now}`);
    }
  }
  assert.ok(visited.size > 6);
});

test('a step that fails says so, and does not end the walk', async () => {
  const page = await open();
  const before = await vertexOf(page);
  await page.evaluate(() => {
    const { postMessage } = Worker.prototype;
    Worker.prototype.postMessage = function (message) {
      if (message.request.kind !== 'neighbors') return postMessage.call(this, message);
      Worker.prototype.postMessage = postMessage;
      return this.postMessage({ ...message, request: { kind: 'neighbors', vertex: 1e9 } });
    };
  });
  await page.keyboard.press('Shift+ArrowLeft');
  await page.waitForSelector('#error:not([hidden])');
  await page.keyboard.press('Shift+ArrowLeft');
  await page.waitForFunction((v) => Number(document.getElementById('vertex').value) !== v, before);
});

test('shortcuts work after a checkbox, a button or a slider was used', async () => {
  const page = await open();
  await page.click('#display summary');
  const isBall = () => page.isChecked('#ball');
  await page.click('#wireframe');
  let before = await isBall();
  await page.keyboard.press('b');
  assert.equal(await isBall(), !before);
  await page.keyboard.press(' '); // still that of the checkbox
  assert.equal(await page.isChecked('#wireframe'), false);
  for (const id of ['focus', 'radius']) {
    await page.focus(`#${id}`);
    before = await isBall();
    await page.keyboard.press('b');
    assert.equal(await isBall(), !before, id);
  }
  const camera = () => page.evaluate(() => window.meshhoodPage.view.cameraState);
  const still = await camera();
  await page.focus('#radius');
  await page.keyboard.press('ArrowRight'); // moves the slider, not the camera
  assert.deepEqual(await camera(), still);
  await page.focus('#vertex');
  before = await isBall();
  await page.keyboard.press('b');
  assert.equal(await isBall(), before, 'a field of text keeps its keys');
});
