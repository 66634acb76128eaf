// SPDX-License-Identifier: MIT
// The page: the open mesh, the query, and the display of the answers.
import { download, stem } from './download';
import { Engine } from './engine';
import { EXAMPLES, findExample } from './examples';
import type { FirstQuery } from './examples';
import { connectKeyboard } from './keyboard';
import { METHODS } from './messages';
import type { Method, Opened, Source } from './messages';
import { takePageData } from './page_data';
import type { PageData } from './page_data';
import { Painting } from './paint';
import type { Scalar } from './paint';
import { isQuantity, toScalar } from './quantities';
import type { QuantityName } from './quantities';
import { Panel, format, hideHint, shortNumber, showError, showProgress } from './panel';
import { connectPointer } from './pointer';
import { fromHash, toHash } from './state';
import { View } from './view';
import type { Look } from './view';

const FIRST_RADIUS = 20; // in mean edge lengths

/** The frame of a notebook has no address, and so no link. */
const HAS_ADDRESS = location.protocol !== 'about:';

class Page {
  readonly #canvas = document.getElementById('canvas') as HTMLCanvasElement;
  readonly #view = new View(this.#canvas);
  readonly #engine: Engine;
  readonly #panel: Panel;
  readonly #answers = new Map<Method, Uint32Array>();
  readonly #times = new Map<Method, number>();
  readonly #shown = new Set<Method>(METHODS);
  #opened: Opened | null = null;
  #painting: Painting | null = null;
  #example: string | null = null;
  #pageData: PageData | null = takePageData();
  #wanted = fromHash(location.hash); // applied once the mesh is open
  #vertex = -1;
  #radius = 0; // in the unit of the mesh
  #color = 'answers'; // or a quantity, or a key of the scalars
  #scalars = new Map<string, Scalar>();
  #scalar: Scalar | null = null; // what the colors show, unless the answers
  #given: Uint32Array | null = null; // an answer that was passed to the page, shown until the next query
  #recompute = 0;

  constructor() {
    this.#engine = new Engine({
      progress: (stage, fraction) => showProgress(stage, fraction),
      opened: (opened) => this.#show(opened),
      failed: (during, message) => this.#fail(during, message),
      answer: (method, ids) => this.#receive(method, ids),
      time: (method, microseconds) => this.#receiveTime(method, microseconds),
      computed: (quantity, radius, values) => this.#receiveQuantity(quantity, radius, values),
      index: (bytes) => download(new Blob([bytes as Uint8Array<ArrayBuffer>]), `${this.#stem}.mhi`),
    });
    this.#panel = new Panel({
      open: (file) => this.#open({ kind: 'file', name: file.name, content: file }),
      example: (name) => this.#openExample(name),
      vertex: (vertex) => this.select(vertex),
      radius: (radius, unit, isFinal) => this.setRadius(radius * (unit === 'edge' ? this.meanEdge : 1), isFinal),
      method: (method, isShown) => this.#showMethod(method, isShown),
      color: (choice) => this.#setColor(choice),
      look: (look) => this.#setLook(look),
      random: () => this.#selectRandom(),
      focus: () => this.#focus(),
      savePicture: () => void this.#savePicture(),
      saveIds: () => this.#saveIds(),
      saveIndex: () => this.#engine.saveIndex(),
      copyLink: () => void this.#copyLink(),
    });
    connectPointer(this.#canvas, this.#view, (vertex, isFinal) => this.select(vertex, isFinal));
    this.#connectKeys();
    this.#connectDrop();
    this.#keepClearOfPanel();
    document.querySelector('#error button')!.addEventListener('click', () => showError(null));
    window.addEventListener('hashchange', () => this.#follow());
    document.getElementById('copy-link')!.hidden = !HAS_ADDRESS;
    this.#openFirst();
  }

  #connectKeys(): void {
    const change = (part: Partial<Look>) => {
      this.#panel.look = { ...this.#panel.look, ...part };
      this.#setLook(this.#panel.look);
    };
    const cuts = ['none', 'x', 'y', 'z'] as const;
    const step = (factor: number) => this.setRadius(Math.max(this.#radius, 0.5 * this.meanEdge) * factor);
    connectKeyboard({
      '+': () => step(1.12), '=': () => step(1.12), '-': () => step(1 / 1.12),
      ArrowLeft: () => this.#view.turn(-0.12, 0), ArrowRight: () => this.#view.turn(0.12, 0),
      ArrowUp: () => this.#view.turn(0, -0.12), ArrowDown: () => this.#view.turn(0, 0.12),
      f: () => this.#focus(), a: () => this.#view.showAll(), r: () => this.#selectRandom(),
      h: () => change({ hideNearer: !this.#panel.look.hideNearer }),
      c: () => change({ cut: cuts[(cuts.indexOf(this.#panel.look.cut) + 1) % cuts.length] }),
      w: () => change({ wireframe: !this.#panel.look.wireframe }),
      b: () => change({ ball: !this.#panel.look.ball }),
      o: () => document.getElementById('file')!.click(),
      s: () => void this.#savePicture(),
      '?': () => (document.getElementById('keys') as HTMLDialogElement).showModal(),
    });
  }

  #connectDrop(): void {
    const drop = document.getElementById('drop')!;
    window.addEventListener('dragover', (event) => {
      event.preventDefault();
      drop.hidden = false;
    });
    window.addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) drop.hidden = true;
    });
    window.addEventListener('drop', (event) => {
      event.preventDefault();
      drop.hidden = true;
      const file = event.dataTransfer?.files[0];
      if (file) this.#open({ kind: 'file', name: file.name, content: file });
    });
  }

  /** The panel covers a part of the canvas where it stands beside it, but not on a phone. */
  #keepClearOfPanel(): void {
    const panel = document.getElementById('panel')!;
    const update = () => {
      const isBeside = panel.clientWidth < innerWidth / 2;
      this.#view.covered = isBeside ? innerWidth - panel.getBoundingClientRect().left : 0;
    };
    window.addEventListener('resize', update);
    update();
  }

  // Opening.

  #openFirst(): void {
    if (this.#pageData !== null) {
      const { settings, file } = this.#pageData;
      this.#open({ kind: 'file', name: settings.name, content: file }, this.#pageData);
    } else {
      this.#openExample(this.#wanted.example ?? EXAMPLES[0].name, this.#wanted.example === null);
    }
  }

  #openExample(name: string, isFirst = false): void {
    const example = findExample(name) ?? EXAMPLES[0];
    if (!isFirst && this.#opened !== null) this.#wanted = fromHash('');
    this.#open({ kind: 'example', name: example.name });
    this.#example = example.name;
    this.#panel.setExample(example.name);
  }

  #open(source: Source, pageData: PageData | null = null): void {
    if (this.#opened !== null) this.#wanted = fromHash('');
    this.#pageData = pageData;
    this.#example = null;
    this.#panel.setExample(null);
    delete document.body.dataset.mesh;
    showError(null);
    showProgress('Reading');
    this.#engine.open(source);
  }

  #show(opened: Opened): void {
    const example = this.#example === null ? undefined : findExample(this.#example);
    this.#opened = opened;
    this.#answers.clear();
    this.#times.clear();
    this.#given = null;
    this.#vertex = -1;
    this.#painting = new Painting(opened.vertices);
    this.#view.setMesh(opened.surface, opened.tree, this.#painting.bytes);
    const meanEdge = opened.meanEdge;
    const mostEdges = meanEdge > 0 ? (2 * opened.surface.extent * opened.surface.unit) / meanEdge : 1;
    this.#panel.setMesh(
      example?.title ?? opened.name, facts(opened), opened.vertices, opened.faces, meanEdge, mostEdges);
    this.#scalars = new Map(opened.scalars.map(({ name, values }) => [`ply:${name}`, { title: name, values }]));
    showProgress(null);
    if (opened.warnings.length > 0) showError(`${opened.name}: accepted with a warning: ${opened.warnings.join('; ')}`);
    const handed = this.#pageData?.scalar ?? null;
    if (handed !== null) this.#scalars.set('handed', handed);
    this.#panel.ownColors = new Map([...this.#scalars].map(([choice, { title }]) => [choice, title]));
    this.#setColor('answers');
    if (opened.vertices > 0) this.#askFirst(example?.query ?? { at: 0.5, radius: FIRST_RADIUS });
    document.body.dataset.mesh = opened.name; // for tests: the mesh is open
  }

  /** The query of the link or of the page, or that of the example. */
  #askFirst(query: FirstQuery): void {
    const wanted = this.#wanted;
    const isLink = wanted.vertex !== null;
    const settings = this.#pageData?.settings;
    const look: Look = { ...wanted.look };
    if (!isLink) look.cut = query.cut ?? look.cut;
    if (!isLink && settings?.vertex !== undefined) look.hideNearer = true;
    const { vertices } = this.#opened!;
    for (const method of METHODS) this.#showMethod(method, !wanted.hidden.includes(method));
    this.#panel.look = look;
    const handedUnit = settings?.unit === 'edge' ? this.meanEdge : 1;
    const handed = settings?.radius === undefined ? null : settings.radius * handedUnit;
    const inLink = wanted.radius === null ? null : wanted.radius * this.meanEdge;
    this.#radius = inLink ?? handed ?? query.radius * this.meanEdge;
    const vertex = wanted.vertex ?? settings?.vertex ?? Math.floor(query.at * vertices);
    this.select(Math.min(vertex, vertices - 1));
    this.#view.setLook(look);
    if (wanted.camera !== null) this.#view.cameraState = wanted.camera;
    else if (isLink || settings?.vertex !== undefined || this.#example !== null) {
      this.#view.showQuery(this.#radius, isLink ? undefined : query.from);
    }
    this.#showHanded();
    if (this.#panel.hasColor(wanted.color) && wanted.color !== 'answers') this.#showColor(wanted.color);
  }

  /** The scalar and the answer that were passed with the mesh. */
  #showHanded(): void {
    if (this.#pageData === null) return;
    const { settings } = this.#pageData;
    if (this.#scalars.has('handed')) this.#showColor('handed');
    if (settings.ids !== undefined) {
      this.#given = Uint32Array.from(settings.ids);
      this.#paint();
    }
  }

  #fail(during: 'open' | 'query', message: string): void {
    showProgress(null);
    showError(message);
    if (during === 'open' && this.#opened !== null) document.body.dataset.mesh = this.#opened.name;
  }

  #follow(): void {
    const wanted = fromHash(location.hash);
    if (wanted.example !== null && wanted.example !== this.#example) {
      this.#wanted = wanted;
      this.#opened = null;
      this.#openExample(wanted.example, true);
    } else if (this.#opened !== null) {
      this.#wanted = wanted;
      this.#askFirst({ at: 0.5, radius: this.#radius / this.meanEdge });
    }
  }

  // Queries.

  /** Queries the neighborhood of another vertex. */
  select(vertex: number, isFinal = true): void {
    if (this.#opened === null) return;
    const isFirst = this.#vertex < 0;
    if (!Number.isInteger(vertex) || vertex < 0 || vertex >= this.#opened.vertices) {
      showError(`vertex ${vertex}, but the mesh has ${this.#opened.vertices} vertices`);
      return;
    }
    this.#vertex = vertex;
    this.#panel.setVertex(vertex);
    if (!isFirst) hideHint();
    this.#ask(isFinal);
  }

  /** In the unit of the mesh. */
  setRadius(radius: number, isFinal = true): void {
    this.#radius = radius;
    this.#ask(isFinal);
    if (isQuantity(this.#color)) this.#computeLater();
  }

  /** 1 without edges. */
  get meanEdge(): number {
    return this.#opened?.meanEdge || 1;
  }

  #ask(isFinal: boolean): void {
    if (this.#opened === null || this.#vertex < 0) return;
    this.#given = null;
    this.#panel.setRadius(this.#radius);
    this.#showValue();
    this.#view.setQuery(this.#vertex, this.#radius);
    const methods = METHODS.filter((method) => this.#shown.has(method) && method !== 'bfs');
    for (const method of METHODS) this.#panel.setTime(method, null);
    this.#times.clear();
    this.#panel.setVerdict();
    this.#engine.query(this.#vertex, this.#radius, withExact(methods), METHODS.filter((method) => this.#shown.has(method)));
    if (isFinal) this.#updateLink();
  }

  #receive(method: Method, ids: Uint32Array): void {
    if (method === 'exact') this.#answers.clear();
    this.#answers.set(method, ids);
    const exact = this.#answers.get('exact');
    for (const each of METHODS) {
      const answer = each === 'bfs' ? exact : this.#answers.get(each);
      if (answer === undefined || !this.#shown.has(each)) continue;
      this.#panel.setCount(each, answer.length, exact === undefined ? null : answer.length - exact.length);
    }
    this.#paint();
  }

  #receiveTime(method: Method, microseconds: number): void {
    this.#panel.setTime(method, microseconds);
    this.#times.set(method, microseconds);
    const [exact, bfs] = [this.#times.get('exact'), this.#times.get('bfs')];
    if (exact === undefined || bfs === undefined) return;
    const times = Number((bfs / exact).toPrecision(2));
    const ratio = document.createElement('b');
    ratio.textContent = times === 1 ? 'as long' : `${shortNumber(times)} times as long`;
    this.#panel.setVerdict('Breadth-first search takes ', ratio, ' as the index.');
  }

  #paint(): void {
    if (this.#painting === null) return;
    const isShown = (method: Method) => this.#shown.has(method) && this.#color === 'answers';
    const answers = new Map([...this.#answers].filter(([method]) => isShown(method)));
    if (this.#given !== null) {
      answers.clear();
      answers.set('exact', this.#given);
    }
    this.#painting.setAnswers(answers);
    this.#view.updateColors();
  }

  #showMethod(method: Method, isShown: boolean): void {
    if (isShown) this.#shown.add(method);
    else this.#shown.delete(method);
    this.#panel.setMethodShown(method, isShown);
    this.#ask(true);
  }

  #selectRandom(): void {
    if (this.#opened !== null) this.select(Math.floor(Math.random() * this.#opened.vertices));
  }

  #focus(): void {
    this.#view.showQuery(this.#radius);
  }

  // Colors.

  #setColor(choice: string): void {
    // The colors of a quantity stay until those of the new radius are there.
    if (!isQuantity(choice) || choice !== this.#color) this.#setScalar(this.#scalars.get(choice) ?? null);
    this.#color = choice;
    this.#panel.color = choice;
    this.#engine.cancel();
    if (isQuantity(choice)) this.#engine.compute(choice, this.#radius);
    this.#paint();
    this.#updateLink();
  }

  /** The same where the controls for it may be hidden. */
  #showColor(choice: string): void {
    this.#panel.openDisplay();
    this.#setColor(choice);
  }

  /** Once the radius has stopped changing. */
  #computeLater(): void {
    clearTimeout(this.#recompute);
    this.#recompute = window.setTimeout(() => this.#setColor(this.#color), 400);
  }

  #receiveQuantity(quantity: QuantityName, radius: number, values: Uint32Array | Float64Array): void {
    if (this.#color !== quantity || radius !== this.#radius) return;
    showProgress(null);
    this.#setScalar(toScalar(quantity, values));
  }

  #setScalar(scalar: Scalar | null): void {
    if (this.#painting === null) return;
    this.#scalar = scalar;
    this.#panel.setLegend(scalar, this.#painting.setScalar(scalar));
    this.#showValue();
    this.#paint();
  }

  #showValue(): void {
    if (this.#scalar !== null && this.#vertex >= 0) this.#panel.setValue(this.#scalar.values[this.#vertex]);
  }

  #setLook(look: Look): void {
    this.#view.setLook(look);
    this.#updateLink();
  }

  // Saving.

  get #stem(): string {
    return stem(this.#opened?.name ?? 'mesh');
  }

  async #savePicture(): Promise<void> {
    const background = getComputedStyle(document.body).getPropertyValue('--background').trim();
    download(await this.#view.picture(background), `${this.#stem}.png`);
  }

  #saveIds(): void {
    const lines = [...this.ids('exact')].map((id) => `${id}\n`);
    download(new Blob(lines, { type: 'text/plain' }), `${this.#stem}-${this.#vertex}.txt`);
  }

  #link(camera: number[] | null): string {
    return toHash({
      example: this.#example,
      vertex: this.#vertex < 0 ? null : this.#vertex,
      radius: this.#radius / this.meanEdge,
      hidden: METHODS.filter((method) => !this.#shown.has(method)),
      look: this.#panel.look,
      color: this.#color,
      camera,
    });
  }

  #updateLink(camera: number[] | null = null): void {
    if (HAS_ADDRESS) history.replaceState(null, '', this.#link(camera));
  }

  async #copyLink(): Promise<void> {
    this.#updateLink(this.#view.cameraState);
    try {
      await navigator.clipboard.writeText(location.href);
      this.#panel.setVerdict('The link is in the clipboard.');
    } catch {
      this.#panel.setVerdict('The link is in the address bar.');
    }
  }

  // For scripts and tests, as `meshhoodPage` in the console.

  get view(): View {
    return this.#view;
  }

  get isAnswered(): boolean {
    return this.#engine.isAnswered;
  }

  /** What the colors show; null for the answers of the methods. */
  get values(): ArrayLike<number> | null {
    return this.#scalar?.values ?? null;
  }

  /** The last answer of a method, ascending; empty if there is none. */
  ids(method: Method): Uint32Array {
    return (this.#given ?? this.#answers.get(method) ?? new Uint32Array()).slice().sort();
  }
}

/** The exact answer is always requested, because the others are compared with it. */
function withExact(methods: Method[]): Method[] {
  return methods.includes('exact') ? methods : ['exact', ...methods];
}

function facts(opened: Opened): string {
  const faces = opened.faces > 0 ? `${format(opened.faces)} faces, ` : '';
  const megabytes = shortNumber(Number((opened.indexBytes / 2 ** 20).toPrecision(2)));
  const seconds = shortNumber(Number(opened.seconds.build.toPrecision(2)));
  return `${format(opened.vertices)} vertices, ${faces}index ${megabytes} MB in ${seconds} s`;
}

declare global {
  interface Window {
    meshhoodPage: Page;
  }
}

window.meshhoodPage = new Page();
