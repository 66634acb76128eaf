// SPDX-License-Identifier: MIT
// What the page says of answers and times, the numbers of its links, and its steps along edges.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './modules.mjs';

const { differences, comparison } = await load('verdict');
const { toEdges } = await load('link');
const { nextVertex } = await load('walking');
const { Painting, mapOf } = await load('paint');

const text = (sentence) => sentence.map((part) => (typeof part === 'string' ? part : `*${part.emphasized}*`)).join('');

test('the differences name wrong vertices first, in the number that grammar wants', () => {
  const say = (sizes) => text(differences(new Map(Object.entries(sizes))));
  assert.equal(say({ exact: 2651, ball: 21809, paper: 10718 }),
    'The plain ball has *19,158 wrong vertices*, the approximate method *8,067*.');
  assert.equal(say({ exact: 5, ball: 6, paper: 5 }), 'The plain ball has *1 wrong vertex*.');
  assert.equal(say({ exact: 5, paper: 7 }), 'The approximate method has *2 wrong vertices*.');
  assert.equal(say({ exact: 1234, ball: 1234, paper: 1234 }), 'All methods find the same 1,234 vertices.');
  assert.equal(say({ exact: 1 }), '1 vertex.');
  assert.equal(say({ ball: 3 }), '');
});

test('times that differ by less than the noise of a browser are about the same', () => {
  const say = (exact, bfs) => text(comparison(new Map([['exact', exact], ['bfs', bfs]])));
  for (const bfs of [7.01, 10, 13.9]) assert.equal(say(10, bfs), 'The index is *about as fast* as breadth-first search.');
  assert.equal(say(10, 14.2), 'The index is *1.4 times as fast* as breadth-first search.');
  assert.equal(say(4, 1115), 'The index is *280 times as fast* as breadth-first search.');
  assert.equal(say(30, 10), 'Breadth-first search is *3 times as fast* as the index here.');
  assert.equal(text(comparison(new Map([['exact', 3]]))), '');
});

test('a radius in a link has few digits, and gives the same radius again up to one rounding', () => {
  const lengths = [1.1379481601184658, 0.1, 1 / 3, 0.9776843, 7.3e-20, 4.1e15];
  for (const meanEdge of lengths) {
    for (const edges of [0, 0.5, 14, 24, 30, 11.2, 1e6]) {
      assert.equal(toEdges(edges * meanEdge, meanEdge), edges);
      assert.ok(String(edges).length <= 7);
    }
    for (const radius of [12, 3.5, 0.1, 27.31]) {
      assert.ok(Math.abs(toEdges(radius, meanEdge) * meanEdge - radius) <= 2 ** -52 * radius);
    }
  }
});

test('where values have both signs, 0 is white, whatever they are; the legend has the same colors', () => {
  const [blue, white, red, violet] = [[1, 8, 30], [237, 236, 236], [34, 0, 3], [15, 0, 23]]; // in linear light
  for (const [values, range, colors, options] of [
    [[-8, 0, 4], [-8, 8], [blue, white, [200, 58, 35]]],
    [[-1, ...Array(98).fill(0), 1], [-1, 1], [blue, white, white]],
    [[0, 2, 4], [0, 4], [violet]],
    [[-4, -2, 0], [-4, 0], [violet]],
    [[0, 2, 4], [-4, 4], [white], { isSigned: true }],
    [[0, 0, 0], [-1, 1], [white, white, white], { isSigned: true }],
    [[0, 1, NaN], [-1, 1], [white, red], { range: [-1, 1] }],
  ]) {
    const painting = new Painting(values.length);
    const shown = painting.setScalar({ title: 'heat', values, ...options });
    assert.deepEqual(shown, range, `${values.slice(0, 3)}`);
    colors.forEach((rgb, v) => {
      const painted = [...painting.colors.subarray(4 * v, 4 * v + 3)];
      assert.ok(painted.every((part, i) => Math.abs(part - rgb[i]) <= 3), `${painted}, expected ${rgb} for ${values[v]}`);
    });
    assert.equal(mapOf(shown).gradient.startsWith('linear-gradient(to right, rgb(5, 48, 97)'), range[0] < 0 && range[1] > 0);
  }
});

test('a step goes to the neighbor that lies in its direction', () => {
  const places = { 5: [50, 50], 1: [40, 50], 2: [60, 53], 3: [52, 40], 4: [70, 90], 6: [50, 50] };
  const placeOf = (vertex) => ({ x: places[vertex][0], y: places[vertex][1] });
  const step = (x, y, neighbors = [1, 2, 3, 4, 6]) => nextVertex(5, neighbors, { x, y }, placeOf);
  assert.deepEqual([step(-1, 0), step(1, 0), step(0, -1), step(0, 1)], [1, 2, 3, 4]);
  assert.equal(step(0, 1, [3]), null);
  assert.equal(step(0, 1, [6]), null);
  assert.equal(step(0, 1, []), null);
});
