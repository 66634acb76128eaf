// SPDX-License-Identifier: MIT
// The table of the methods: which are shown, the sizes of their answers, and their times.
import { METHOD_COLORS } from './colors';
import { METHODS } from './messages';
import type { Method } from './messages';
import { format } from './numbers';
import { comparison, differences } from './verdict';
import type { Sentence } from './verdict';

const ROWS: readonly Method[] = ['exact', 'paper', 'ball', 'bfs'];

const MEANINGS: Record<Method, string> = {
  exact: 'The exact neighborhood, by the index',
  paper: 'The approximate neighborhood of the paper: contains the exact one',
  ball: 'Every vertex within the radius in space',
  bfs: 'The exact neighborhood by breadth-first search, for comparison',
};

interface Row {
  element: HTMLTableRowElement;
  box: HTMLInputElement;
  count: Node;
  extra: Node;
  time: Node;
}

export class MethodTable {
  readonly #rows = new Map<Method, Row>();

  /** Calls `show` when a method is to be shown or not. */
  constructor(show: (method: Method, isShown: boolean) => void) {
    const body = document.querySelector<HTMLTableSectionElement>('#methods tbody')!;
    for (const method of ROWS) this.#rows.set(method, makeRow(body, method, show));
  }

  /** A method that cannot answer on this mesh cannot be chosen; its row says why. */
  setPossible(method: Method, isPossible: boolean): void {
    const { element, box } = this.#rows.get(method)!;
    box.disabled = !isPossible;
    element.title = isPossible ? MEANINGS[method] : 'Gives no answer: knows no walls, and vertices without a position are walls';
  }

  setShown(method: Method, isShown: boolean): void {
    const { element, box, count, extra, time } = this.#rows.get(method)!;
    box.checked = isShown;
    element.classList.toggle('off', !isShown);
    if (!isShown) for (const node of [count, extra, time]) node.textContent = '';
  }

  /** `extra` vertices are not in the exact answer. */
  setCount(method: Method, count: number, extra: number | null): void {
    const row = this.#rows.get(method)!;
    row.count.textContent = format(count);
    row.extra.textContent = extra === null ? '' : format(extra);
  }

  /** `sizes` of the answers, once all methods have answered. Screen readers say it. */
  setSizes(sizes: Map<Method, number>): void {
    write('result', differences(sizes));
  }

  clearTimes(): void {
    for (const method of METHODS) this.#rows.get(method)!.time.textContent = '';
    write('verdict', []);
  }

  /** In microseconds. */
  setTimes(times: Map<Method, number>): void {
    for (const [method, microseconds] of times) {
      this.#rows.get(method)!.time.textContent = format(Number(microseconds.toFixed(microseconds < 10 ? 1 : 0)));
    }
    write('verdict', comparison(times));
  }
}

/** Below the table. */
function write(id: 'result' | 'verdict', sentence: Sentence): void {
  const parts = sentence.map((part) => {
    if (typeof part === 'string') return part;
    const emphasis = document.createElement('b');
    emphasis.textContent = part.emphasized;
    return emphasis;
  });
  document.getElementById(id)!.replaceChildren(...(parts.length > 0 ? parts : ['\u00a0']));
}

function makeRow(body: HTMLTableSectionElement, method: Method, show: (method: Method, isShown: boolean) => void): Row {
  const element = body.insertRow();
  element.dataset.method = method;
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.checked = true;
  box.addEventListener('change', () => show(method, box.checked));
  const swatch = document.createElement('span');
  swatch.className = 'swatch';
  swatch.style.background = method === 'bfs' ? 'transparent' : METHOD_COLORS[method];
  const label = document.createElement('label');
  label.append(box, swatch, method);
  element.insertCell().append(label);
  const [count, extra, time] = [0, 1, 2].map(() => element.insertCell().appendChild(document.createTextNode('')));
  return { element, box, count, extra, time };
}
