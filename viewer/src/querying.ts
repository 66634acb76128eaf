// SPDX-License-Identifier: MIT
// The query: its vertex and radius, the methods that answer it, and their answers.
import type { Engine } from './engine';
import { METHODS } from './messages';
import type { Method, Opened } from './messages';
import type { MethodTable } from './method_table';
import { hideHint, showRefusal } from './notices';
import type { Panel } from './panel';

export interface Listeners {
  /** A query begins. `isFinal` unless the marker or the slider is being dragged. */
  asked(isFinal: boolean): void;
  /** There is another answer to show. */
  answered(): void;
}

export class Querying {
  readonly #engine: Engine;
  readonly #panel: Panel;
  readonly #table: MethodTable;
  readonly #listeners: Listeners;
  readonly #shown = new Set<Method>(METHODS);
  readonly #answers = new Map<Method, Uint32Array>();
  #given: Uint32Array | null = null; // an answer that was passed to the page, shown until the next query
  #opened: Opened | null = null;
  #vertex = -1;
  #radius = 0;

  constructor(engine: Engine, panel: Panel, table: MethodTable, listeners: Listeners) {
    this.#engine = engine;
    this.#panel = panel;
    this.#table = table;
    this.#listeners = listeners;
  }

  /** Another mesh is open; it has no query yet. */
  open(opened: Opened): void {
    this.#opened = opened;
    this.#setVertex(-1);
    this.#given = null;
    this.#answers.clear();
    for (const method of METHODS) this.#table.setPossible(method, opened.methods.includes(method));
  }

  /** `given` is shown instead of the answers, until the next query. */
  start(vertex: number, radius: number, hidden: string[], given: Uint32Array | null): void {
    for (const method of METHODS) {
      this.#setShown(method, this.#opened!.methods.includes(method) && !hidden.includes(method));
    }
    this.#radius = radius;
    this.#setVertex(vertex);
    this.#ask(true);
    this.#given = given;
    this.#listeners.answered();
  }

  select(vertex: number, isFinal = true): void {
    if (this.#opened === null) return;
    const { vertices } = this.#opened;
    if (!Number.isInteger(vertex)) return this.#refuse(`vertex ${vertex}, expected a whole number`);
    if (vertex < 0 || vertex >= vertices) return this.#refuse(`vertex ${vertex}, but the mesh has ${vertices} vertices`);
    hideHint();
    this.#setVertex(vertex);
    this.#ask(isFinal);
  }

  selectRandom(): void {
    this.select(Math.floor(Math.random() * (this.#opened?.vertices ?? 0)));
  }

  /** In the unit of the mesh. */
  setRadius(radius: number, isFinal = true): void {
    if (!Number.isFinite(radius)) return this.#refuse(`radius ${radius}, expected a finite number`);
    this.#radius = radius;
    this.#ask(isFinal);
  }

  multiplyRadius(factor: number): void {
    this.setRadius(Math.max(this.#radius, factor > 1 ? 0.5 * this.meanEdge : 0) * factor);
  }

  showMethod(method: Method, isShown: boolean): void {
    this.#setShown(method, isShown);
    this.#ask(true);
  }

  /** Says why an input is refused. The panel shows the query before, which stays. */
  #refuse(reason: string): void {
    this.#panel.setVertex(this.#vertex);
    this.#panel.setRadius(this.#radius);
    showRefusal(reason);
  }

  #setVertex(vertex: number): void {
    this.#vertex = vertex;
    this.#panel.setVertex(vertex);
  }

  #setShown(method: Method, isShown: boolean): void {
    if (isShown) this.#shown.add(method);
    else this.#shown.delete(method);
    this.#table.setShown(method, isShown);
  }

  #ask(isFinal: boolean): void {
    if (this.#vertex < 0) return;
    this.#given = null;
    showRefusal(null);
    this.#table.clearTimes();
    this.#panel.setRadius(this.#radius);
    const shown = METHODS.filter((method) => this.#shown.has(method));
    // The others are compared with the exact answer, which is that of bfs, too.
    const answering = METHODS.filter((method) => method === 'exact' || (method !== 'bfs' && this.#shown.has(method)));
    this.#engine.query(this.#vertex, this.#radius, answering, shown);
    this.#listeners.asked(isFinal);
  }

  receive(method: Method, ids: Uint32Array): void {
    if (method === 'exact') this.#answers.clear();
    this.#answers.set(method, ids);
    const exact = this.#answers.get('exact');
    for (const each of this.#shown) {
      const answer = each === 'bfs' ? exact : this.#answers.get(each);
      if (answer === undefined) continue;
      this.#table.setCount(each, answer.length, exact === undefined ? null : answer.length - exact.length);
    }
    const sizes = new Map([...this.#answers].map(([each, answer]) => [each, answer.length]));
    if (this.#engine.isAnswered) this.#table.setSizes(sizes);
    this.#listeners.answered();
  }

  /** -1 before the first query. */
  get vertex(): number {
    return this.#vertex;
  }

  /** In the unit of the mesh. */
  get radius(): number {
    return this.#radius;
  }

  /** In the unit of the mesh; 1 without edges. */
  get meanEdge(): number {
    return this.#opened?.meanEdge || 1;
  }

  /** Methods that are not shown. */
  get hidden(): Method[] {
    return METHODS.filter((method) => !this.#shown.has(method));
  }

  /** An answer that was passed to the page, until the next query. */
  get given(): Uint32Array | null {
    return this.#given;
  }

  /** The answers of the methods that are shown. */
  get answers(): Map<Method, Uint32Array> {
    return new Map([...this.#answers].filter(([method]) => this.#shown.has(method)));
  }

  /** The last answer of a method, ascending; empty if there is none. */
  ids(method: Method): Uint32Array {
    return (this.#given ?? this.#answers.get(method) ?? new Uint32Array()).slice().sort();
  }
}
