// SPDX-License-Identifier: MIT
// The worker as the page sees it: opens meshes, and answers the latest query.
import type { Message, Method, Opened, Query, Reply, Request, Source } from './messages';
import type { QuantityName } from './quantities';
import EngineWorker from './worker?worker&inline';

export interface Handlers {
  /** `stage` is null once nothing is being done. */
  progress(stage: string | null, fraction: number | null): void;
  opened(opened: Opened): void;
  failed(during: 'open' | 'query', message: string): void;
  answer(method: Method, ids: Uint32Array): void;
  /** Microseconds of a warm query by each method. */
  times(times: Map<Method, number>): void;
  neighbors(vertex: number, ids: Uint32Array): void;
  computed(quantity: QuantityName, radius: number, values: Uint32Array | Float64Array): void;
  index(bytes: Uint8Array<ArrayBuffer>): void;
}

/** Milliseconds without a new query after which times are measured. */
const QUIET = 180;

export class Engine {
  readonly #worker = new EngineWorker();
  readonly #handlers: Handlers;
  #openings = 0; // requested so far
  #opening = 0; // that of the mesh which is shown
  #id = 0; // of the last query
  #busy = false; // the first method of the last query has no answer yet
  #waiting: Query | null = null;
  #timer = 0;
  #unanswered = 0; // methods of the last query

  constructor(handlers: Handlers) {
    this.#handlers = handlers;
    this.#worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#receive(data);
    this.#worker.onerror = (event) => handlers.failed('open', event.message || 'The worker of this page failed.');
  }

  /** About the mesh that is shown. */
  request(request: Request, opening = this.#opening): void {
    this.#worker.postMessage({ opening, request } satisfies Message);
  }

  /** Returns the number of this opening. Queries are about the mesh before until this one is open. */
  open(source: Source): number {
    this.request({ kind: 'open', source }, ++this.#openings);
    return this.#openings;
  }

  /** Answers by each method in turn, and then measures them. A query that comes before the answer replaces this one. */
  query(vertex: number, radius: number, methods: Method[], timed: Method[]): void {
    const query = { id: ++this.#id, vertex, radius, methods };
    this.#unanswered = methods.length;
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => {
      this.request({ kind: 'time', query: { ...query, methods: timed } });
    }, QUIET);
    if (this.#busy) this.#waiting = query;
    else this.#start(query);
  }

  #start(query: Query): void {
    this.#busy = query.methods.length > 0;
    this.#waiting = null;
    this.request({ kind: 'query', query });
  }

  #receive(reply: Reply): void {
    switch (reply.kind) {
      case 'progress': return this.#handlers.progress(reply.stage, reply.fraction);
      case 'opened': return this.#receiveOpened(reply.opened);
      case 'failed': return this.#receiveFailure(reply.failed, reply.reason);
      case 'answer': return this.#receiveAnswer(reply.id, reply.method, reply.ids);
      case 'times':
        if (reply.id === this.#id) this.#handlers.times(reply.times);
        return;
      case 'neighbors': return this.#handlers.neighbors(reply.vertex, reply.ids);
      case 'computed': return this.#handlers.computed(reply.quantity, reply.radius, reply.values);
      case 'index': return this.#handlers.index(reply.bytes);
    }
  }

  /** Whether all methods of the last query have answered. */
  get isAnswered(): boolean {
    return this.#unanswered === 0;
  }

  /** The worker answers nothing more about the mesh before. */
  #receiveOpened(opened: Opened): void {
    this.#opening = opened.opening;
    this.#waiting = null;
    this.#busy = false;
    this.#unanswered = 0;
    clearTimeout(this.#timer);
    this.#handlers.opened(opened);
  }

  #receiveFailure({ opening, request }: Message, reason: string): void {
    this.#busy = false;
    const isOpening = request.kind === 'open';
    // Of meshes, and of answers, only the last that was requested is awaited.
    const isLate = isOpening ? opening < this.#openings : 'query' in request && request.query.id < this.#id;
    if (!isLate) this.#handlers.failed(isOpening ? 'open' : 'query', reason);
    if (this.#waiting !== null) this.#start(this.#waiting);
  }

  #receiveAnswer(id: number, method: Method, ids: Uint32Array): void {
    this.#busy = false;
    if (id === this.#id) --this.#unanswered;
    // While the pointer moves, the answer before the last is shown too. Otherwise no answer would follow the pointer.
    if (id === this.#id || this.#waiting !== null) this.#handlers.answer(method, ids);
    if (this.#waiting !== null) this.#start(this.#waiting);
  }
}
