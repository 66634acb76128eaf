// SPDX-License-Identifier: MIT
// The page: what happens in one part is passed on to the others.
import { ColorKey } from './color_key';
import { Coloring } from './coloring';
import { connectDrop } from './drop';
import { Engine } from './engine';
import type { FirstQuery } from './examples';
import { connectKeyboard } from './keyboard';
import { fromHash, toEdges, toHash } from './link';
import type { State } from './link';
import type { Method, Opened } from './messages';
import { MethodTable } from './method_table';
import { connectNotices, say, showError, showProgress } from './notices';
import { Opening } from './opening';
import type { Asked } from './opening';
import { Panel } from './panel';
import { connectPointer } from './pointer';
import { Querying } from './querying';
import { saveIds, saveIndex, savePicture } from './saving';
import { startOf } from './start';
import { View } from './view';
import type { Look } from './view';
import { nextVertex } from './walking';
import type { Direction } from './walking';

/** Of a mesh that is no example. */
const FIRST_QUERY: FirstQuery = { at: 0.5, radius: 20 };

/** The frame of a notebook has no address, and so no link. */
const HAS_ADDRESS = location.protocol !== 'about:';

class Page {
  readonly view: View;
  readonly #panel: Panel;
  readonly #table: MethodTable;
  readonly #engine: Engine;
  readonly #opening: Opening;
  readonly #querying: Querying;
  readonly #coloring: Coloring;
  #walking: Direction | null = null; // while the neighbors are looked up

  constructor() {
    const canvas = document.getElementById('canvas') as HTMLCanvasElement;
    this.view = new View(canvas);
    this.#panel = this.#makePanel();
    this.#table = new MethodTable((method, isShown) => this.#querying.showMethod(method, isShown));
    this.#engine = this.#makeEngine();
    this.#opening = new Opening(this.#engine, this.#panel, (opened, asked) => this.#show(opened, asked));
    this.#querying = new Querying(this.#engine, this.#panel, this.#table, {
      asked: (isFinal) => this.#passQueryOn(isFinal),
      answered: () => this.#coloring.setAnswers(this.#querying.answers, this.#querying.given),
    });
    this.#coloring = new Coloring(this.view, this.#engine, this.#panel, new ColorKey(), () => this.#updateLink());
    connectPointer(canvas, this.view, (vertex, isFinal) => this.#querying.select(vertex, isFinal));
    connectDrop((file) => this.#opening.openFile(file));
    connectNotices();
    this.#connectKeys();
    this.#keepClear();
    window.addEventListener('hashchange', ({ newURL }) => this.#follow(fromHash(new URL(newURL).hash)));
    document.getElementById('copy-link')!.hidden = !HAS_ADDRESS;
    this.#opening.openFirst(fromHash(location.hash));
  }

  #makePanel(): Panel {
    return new Panel({
      open: (file) => this.#opening.openFile(file),
      example: (name) => this.#opening.openExample(name),
      vertex: (vertex) => this.#querying.select(vertex),
      radius: (radius, unit, isFinal) =>
        this.#querying.setRadius(radius * (unit === 'edge' ? this.meanEdge : 1), isFinal),
      color: (choice) => this.#coloring.choose(choice),
      look: (look) => this.#setLook(look),
      random: () => this.#querying.selectRandom(),
      focus: () => this.view.showQuery(this.#querying.radius),
      savePicture: () => void savePicture(this.view, this.#opening.name),
      saveIds: () => this.isAnswered
        ? saveIds(this.ids('exact'), this.#querying.vertex, this.#opening.name) : say('There is no answer yet.'),
      saveIndex: () => this.#engine.request({ kind: 'save-index' }),
      copyLink: () => void this.#copyLink(),
    });
  }

  #makeEngine(): Engine {
    return new Engine({
      progress: (stage, fraction) => showProgress(stage, fraction),
      opened: (opened) => this.#opening.receive(opened),
      failed: (during, message) => {
        showProgress(null);
        showError(message);
        this.#walking = null; // the neighbors may be what failed
        if (during === 'open') this.#opening.fail();
      },
      answer: (method, ids) => this.#querying.receive(method, ids),
      times: (times) => this.#table.setTimes(times),
      neighbors: (vertex, ids) => this.#walkTo(vertex, ids),
      computed: (quantity, radius, values) => this.#coloring.receive(quantity, radius, values),
      index: (bytes) => saveIndex(bytes, this.#opening.name),
    });
  }

  #connectKeys(): void {
    const change = (part: Partial<Look>) => {
      this.#panel.look = { ...this.#panel.look, ...part };
      this.#setLook(this.#panel.look);
    };
    const cuts = ['none', 'x', 'y', 'z'] as const;
    const larger = () => this.#querying.multiplyRadius(1.12);
    connectKeyboard({
      '+': larger, '=': larger, '-': () => this.#querying.multiplyRadius(1 / 1.12),
      ArrowLeft: () => this.view.turn(-0.12, 0), ArrowRight: () => this.view.turn(0.12, 0),
      ArrowUp: () => this.view.turn(0, -0.12), ArrowDown: () => this.view.turn(0, 0.12),
      'Shift+ArrowLeft': () => this.#walk({ x: -1, y: 0 }), 'Shift+ArrowRight': () => this.#walk({ x: 1, y: 0 }),
      'Shift+ArrowUp': () => this.#walk({ x: 0, y: -1 }), 'Shift+ArrowDown': () => this.#walk({ x: 0, y: 1 }),
      z: () => this.view.zoom(1.15), x: () => this.view.zoom(1 / 1.15),
      f: () => this.view.showQuery(this.#querying.radius), a: () => this.view.showAll(),
      r: () => this.#querying.selectRandom(),
      h: () => change({ hideNearer: !this.#panel.look.hideNearer }),
      c: () => change({ cut: cuts[(cuts.indexOf(this.#panel.look.cut) + 1) % cuts.length] }),
      w: () => change({ wireframe: !this.#panel.look.wireframe }),
      b: () => change({ ball: !this.#panel.look.ball }),
      o: () => document.getElementById('file')!.click(),
      s: () => void savePicture(this.view, this.#opening.name),
      '?': () => (document.getElementById('keys') as HTMLDialogElement).showModal(),
    });
  }

  /** Walks along an edge, in a direction on the canvas. */
  #walk(direction: Direction): void {
    if (this.#querying.vertex < 0 || this.#walking !== null) return;
    this.#walking = direction;
    this.#engine.request({ kind: 'neighbors', vertex: this.#querying.vertex });
  }

  #walkTo(vertex: number, neighbors: Uint32Array): void {
    const direction = this.#walking;
    this.#walking = null;
    if (direction === null || vertex !== this.#querying.vertex) return;
    const next = nextVertex(vertex, neighbors, direction, (v) => this.view.toCanvas(v));
    if (next !== null) this.#querying.select(next);
  }

  /** The panel covers the canvas at the right, or on a phone at the bottom, below what the page says at the top. */
  #keepClear(): void {
    const [panel, about] = ['panel', 'about'].map((id) => document.getElementById(id)!);
    const update = () => {
      const [below, above] = [panel.getBoundingClientRect(), about.getBoundingClientRect()];
      const isBeside = below.width < innerWidth / 2;
      const bottom = isBeside ? 0 : innerHeight - below.top;
      document.body.style.setProperty('--covered', `${bottom}px`);
      this.view.covered = { top: isBeside ? 0 : above.bottom, right: isBeside ? innerWidth - below.left : 0, bottom };
    };
    const observer = new ResizeObserver(update);
    for (const element of [panel, about, document.body]) observer.observe(element);
    update();
  }

  #show(opened: Opened, asked: Asked): void {
    this.#querying.open(opened);
    this.#walking = null;
    const painting = this.#coloring.open(opened, asked.pageData?.scalar ?? null);
    this.view.setMesh(opened.surface, opened.tree, painting);
    this.#start(opened, asked, this.#opening.example?.query ?? FIRST_QUERY);
  }

  #start(opened: Opened, asked: Asked, query: FirstQuery): void {
    if (opened.vertices === 0) return;
    const start = startOf(opened, asked, query);
    this.#panel.look = start.look;
    this.#querying.start(start.vertex, start.radius, start.hidden, start.ids);
    this.view.setLook(start.look);
    if (start.camera !== null) this.view.cameraState = start.camera;
    else if (start.looksAtQuery) this.view.showQuery(start.radius, start.from);
    this.#coloring.start(asked.link.color);
  }

  #passQueryOn(isFinal: boolean): void {
    const { vertex, radius } = this.#querying;
    this.view.setQuery(vertex, radius);
    this.#coloring.setQuery(vertex, radius);
    if (isFinal) this.#updateLink();
  }

  #setLook(look: Look): void {
    this.view.setLook(look);
    this.#updateLink();
  }

  // The link to what is shown.

  #follow(link: State): void {
    const isShown = !this.#opening.isBusy && link.example === this.#opening.example?.name;
    if (link.example !== null && !isShown) {
      this.#opening.openExample(link.example, link);
    } else if (this.#opening.shown !== null) {
      const { opened, asked } = this.#opening.shown;
      const radius = this.#querying.radius / this.meanEdge;
      this.#start(opened, { ...asked, link }, { ...FIRST_QUERY, radius });
    }
  }

  #updateLink(camera: number[] | null = null): void {
    if (!HAS_ADDRESS || this.#opening.shown === null) return;
    const { vertex, radius, hidden } = this.#querying;
    history.replaceState(null, '', toHash({
      example: this.#opening.example?.name ?? null,
      vertex: vertex < 0 ? null : vertex,
      radius: toEdges(radius, this.meanEdge),
      hidden,
      look: this.#panel.look,
      color: this.#coloring.choice,
      camera,
    }));
  }

  async #copyLink(): Promise<void> {
    this.#updateLink(this.view.cameraState);
    try {
      await navigator.clipboard.writeText(location.href);
      say('The link is in the clipboard.');
    } catch {
      say('The link is in the address bar.');
    }
  }

  // For scripts and tests, as `meshhoodPage` in the console; also `view`.

  get isAnswered(): boolean {
    return this.#engine.isAnswered;
  }

  /** In the unit of the mesh; 1 without edges. */
  get meanEdge(): number {
    return this.#querying.meanEdge;
  }

  /** What the colors show; null for the answers of the methods. */
  get values(): ArrayLike<number> | null {
    return this.#coloring.values;
  }

  /** The last answer of a method, ascending; empty if there is none. */
  ids(method: Method): Uint32Array {
    return this.#querying.ids(method);
  }
}

declare global {
  interface Window {
    meshhoodPage: Page;
  }
}

if (document.createElement('canvas').getContext('webgl2') !== null) {
  window.meshhoodPage = new Page();
} else {
  document.body.classList.add('without-webgl');
  showError('This browser has no WebGL 2, by which the page draws the mesh. Turn on its hardware acceleration, or open ' +
    'the page in another browser. Without a picture, `meshhood query` and `meshhood compare` give the same answers.');
}
