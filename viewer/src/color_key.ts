// SPDX-License-Identifier: MIT
// Over the mesh: what the colors of the answers mean, and how many vertices have them.
import { METHOD_COLORS } from './colors';
import type { Method } from './messages';
import { format } from './numbers';

/** From top to bottom. */
const COLORS = ['exact', 'ball', 'paper'] as const;

interface Row {
  element: HTMLElement;
  meaning: Node;
  count: Node;
}

export class ColorKey {
  readonly #rows = COLORS.map((method) => [method, makeRow(method)] as const);

  constructor() {
    document.getElementById('color-key')!.append(...this.#rows.map(([, { element }]) => element));
  }

  /** Of the answers that are drawn; `given` is one that was passed to the page. */
  show(answers: Map<Method, Uint32Array>, given: Uint32Array | null): void {
    const sizes = new Map([...answers].map(([method, ids]) => [method, ids.length]));
    const exact = sizes.get('exact') ?? 0;
    for (const [method, row] of this.#rows) {
      if (given !== null) setRow(row, method === 'exact' ? 'the vertices that were passed to the page' : null, given.length);
      else if (!sizes.has(method)) setRow(row, null, 0);
      else if (method === 'exact') setRow(row, 'connected within the ball: the answer', exact);
      else if (method === 'ball') setRow(row, 'near, but not connected', sizes.get(method)! - exact);
      else setRow(row, `${sizes.has('ball') ? 'of these, ' : ''}extra of the approximate method`, sizes.get(method)! - exact);
    }
  }
}

function makeRow(method: (typeof COLORS)[number]): Row {
  const element = document.createElement('li');
  element.dataset.method = method;
  const swatch = document.createElement('span');
  swatch.className = 'swatch';
  swatch.style.background = METHOD_COLORS[method];
  const [words, number] = [document.createElement('span'), document.createElement('b')];
  const [meaning, count] = [words, number].map((part) => part.appendChild(document.createTextNode('')));
  element.append(swatch, words, number);
  return { element, meaning, count };
}

/** Null: these vertices are not drawn. */
function setRow({ element, meaning, count }: Row, words: string | null, vertices: number): void {
  element.hidden = words === null;
  meaning.textContent = words ?? '';
  count.textContent = format(vertices);
}
