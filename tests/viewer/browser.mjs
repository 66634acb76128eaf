// SPDX-License-Identifier: MIT
// Chromium without a window, with WebGL in software, and the page in it.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

// The packages of the page are installed there.
const require = createRequire(join(process.env.MESHHOOD_VIEWER_SOURCES, 'package.json'));
const { chromium } = require('playwright-core');

const TIMEOUT = 120_000; // milliseconds; long, because the machine may be busy

export function launch() {
  return chromium.launch({
    executablePath: ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync),
    args: [
      '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
      '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    ],
  });
}

/** Opens a page file and waits until its mesh is shown. Errors of the page fail the test. */
export async function openPage(browser, file, { hash = '', ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, acceptDownloads: true, ...options });
  page.setDefaultTimeout(TIMEOUT);
  page.on('pageerror', (error) => { throw error; });
  await page.goto(`${pathToFileURL(file)}${hash}`);
  await waitForMesh(page);
  return page;
}

export async function waitForMesh(page, name) {
  const isOpen = (expected) => {
    const mesh = document.body.dataset.mesh;
    return mesh !== undefined && (expected === undefined || mesh === expected);
  };
  await page.waitForFunction(isOpen, name);
  await waitForAnswers(page);
}

/** The most memory, in bytes, that the process of any open page has held since it began: its peak resident set. */
export async function memoryOfPages(browser) {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  const peaks = processInfo.filter(({ type }) => type === 'renderer').map(({ id }) => {
    const [, kilobytes] = /^VmHWM:\s+(\d+) kB$/m.exec(readFileSync(`/proc/${id}/status`, 'utf8'));
    return 1024 * Number(kilobytes);
  });
  return Math.max(...peaks);
}

/** Until the methods of the table have answered the query that is shown, and the view has followed the panel. */
export async function waitForAnswers(page) {
  await page.waitForFunction(() => window.meshhoodPage.isAnswered);
  // The panel may grow by an answer. The page observes its size after the layout, before the second frame from now.
  await page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); }));
}

/** Drops a file onto the page, as from a folder. */
export async function drop(page, name, content) {
  await page.evaluate(({ name, base64 }) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const transfer = new DataTransfer();
    transfer.items.add(new File([bytes], name));
    window.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, { name, base64: content.toString('base64') });
}

/** Drops a mesh, and waits until it is shown. */
export async function show(page, name, content) {
  await drop(page, name, content);
  await waitForMesh(page, name);
}

/** Opens an example, and calls `act` in the page while the worker builds the index of it. */
export const openExample = (page, name, act) => page.evaluate(({ name, act }) => new Promise((resolve) => {
  const stage = document.querySelector('#status span');
  const observer = new MutationObserver(() => {
    if (stage.textContent !== 'Building the index') return;
    observer.disconnect();
    resolve(new Function(`(${act})()`)());
  });
  observer.observe(stage, { childList: true });
  const select = document.getElementById('example');
  select.value = name;
  select.dispatchEvent(new Event('change'));
}), { name, act: act.toString() });

/** The last answer of a method on the page, ascending. */
export async function idsOf(page, method) {
  return page.evaluate((method) => [...window.meshhoodPage.ids(method)], method);
}

export async function setRadius(page, units) {
  await page.fill('#radius-units', String(units));
  await page.press('#radius-units', 'Enter');
  await waitForAnswers(page);
}

export async function setVertex(page, vertex) {
  await page.fill('#vertex', String(vertex));
  await page.press('#vertex', 'Enter');
  await waitForAnswers(page);
}

/** Where a vertex is on the canvas, in pixels. */
export function placeOf(page, vertex) {
  return page.evaluate((vertex) => window.meshhoodPage.view.toCanvas(vertex), vertex);
}

/** Calls `use` in the page with the pixels of a screenshot, which the browser can read, and with `argument`. */
async function withPixels(page, use, argument) {
  const picture = (await page.screenshot()).toString('base64');
  return page.evaluate(async ({ picture, use, argument }) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = context.getImageData(0, 0, image.width, image.height);
    return new Function(`return (${use})(...arguments)`)(pixels, argument);
  }, { picture, use: use.toString(), argument });
}

/** How many pixels of a screenshot have about the color `rgb`. */
export const countPixels = (page, rgb, reach = 60) => withPixels(page, ({ data }, { rgb, reach }) => {
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (Math.hypot(data[i] - rgb[0], data[i + 1] - rgb[1], data[i + 2] - rgb[2]) < reach) ++count;
  }
  return count;
}, { rgb, reach });

/** Until a screenshot has more than `least` pixels of about the color `rgb`: on a busy machine the browser draws late. */
export async function waitForPixels(page, rgb, least) {
  const end = Date.now() + TIMEOUT;
  let pixels;
  do pixels = await countPixels(page, rgb); while (pixels <= least && Date.now() < end);
  assert.ok(pixels > least, `${pixels} pixels of ${rgb}, expected more than ${least}`);
}

/** The colors of a screenshot at some places. */
export const colorsAt = (page, places) => withPixels(page, ({ data, width }, places) => places.map(({ x, y }) => {
  const at = 4 * (Math.round(y) * width + Math.round(x));
  return [...data.slice(at, at + 3)];
}), places);
