// SPDX-License-Identifier: MIT
// Opening a mesh: an example, a file that is chosen or dropped, or the file that was written into the page.
import type { Engine } from './engine';
import { EXAMPLES, findExample } from './examples';
import type { Example } from './examples';
import { fromHash } from './link';
import type { State } from './link';
import type { Opened, Source } from './messages';
import { showError, showProgress, showWarning } from './notices';
import { format, shortNumber } from './numbers';
import { takePageData } from './page_data';
import type { PageData } from './page_data';
import type { Panel } from './panel';

/** A mesh that is to be opened, and what is to be shown of it. */
export interface Asked {
  source: Source;
  /** Says nothing if the mesh is not opened by a link. */
  link: State;
  /** Null unless the file was written into the page. */
  pageData: PageData | null;
}

export class Opening {
  readonly #engine: Engine;
  readonly #panel: Panel;
  readonly #show: (opened: Opened, asked: Asked) => void;
  readonly #asked = new Map<number, Asked>(); // what is being opened, by the numbers of the engine
  #shown: { opened: Opened; asked: Asked } | null = null;

  /** Calls `show` once a mesh is open. */
  constructor(engine: Engine, panel: Panel, show: (opened: Opened, asked: Asked) => void) {
    this.#engine = engine;
    this.#panel = panel;
    this.#show = show;
  }

  /** What was written into the page; else the example of the link, or the first one. */
  openFirst(link: State): void {
    const pageData = takePageData();
    if (pageData !== null) {
      const { name, weld, precision } = pageData.settings;
      this.#open({ source: { kind: 'file', name, content: pageData.file, weld, precision }, link, pageData });
    } else {
      this.openExample(link.example ?? EXAMPLES[0].name, link);
    }
  }

  openExample(name: string, link: State = fromHash()): void {
    const example = findExample(name) ?? EXAMPLES[0];
    this.#open({ source: { kind: 'example', name: example.name }, link, pageData: null });
  }

  openFile(file: File): void {
    this.#open({ source: { kind: 'file', name: file.name, content: file }, link: fromHash(), pageData: null });
  }

  #open(asked: Asked): void {
    this.#panel.setExample(exampleOf(asked)?.name ?? null);
    delete document.body.dataset.mesh;
    showError(null);
    showProgress('Reading');
    this.#asked.set(this.#engine.open(asked.source), asked);
  }

  /** The worker has opened a mesh, perhaps not the one that was requested last. */
  receive(opened: Opened): void {
    const asked = this.#asked.get(opened.opening)!;
    for (const opening of this.#asked.keys()) if (opening <= opened.opening) this.#asked.delete(opening);
    this.#shown = { opened, asked };
    const title = this.example?.title ?? opened.name;
    this.#panel.setMesh(title, facts(opened), opened.vertices, opened.faces, opened.meanEdge, mostEdges(opened));
    showProgress(null);
    const warning = `${opened.name}: accepted with a warning: ${opened.warnings.join('; ')}`;
    showWarning(opened.warnings.length > 0 ? warning : null);
    this.#show(opened, asked);
    document.body.dataset.mesh = opened.name; // for tests: the mesh is open
  }

  /** The mesh that was requested last could not be opened. The one before stays. */
  fail(): void {
    this.#asked.clear();
    if (this.#shown === null) return;
    this.#panel.setExample(this.example?.name ?? null);
    document.body.dataset.mesh = this.name;
  }

  /** Whether a mesh is being opened. */
  get isBusy(): boolean {
    return this.#asked.size > 0;
  }

  /** The mesh that is shown, with what was asked for it; null before the first. */
  get shown(): { opened: Opened; asked: Asked } | null {
    return this.#shown;
  }

  get name(): string {
    return this.#shown?.opened.name ?? 'mesh';
  }

  /** The example that is shown; null for a file. */
  get example(): Example | null {
    return this.#shown === null ? null : exampleOf(this.#shown.asked);
  }
}

function exampleOf({ source }: Asked): Example | null {
  return source.kind === 'example' ? findExample(source.name) ?? null : null;
}

function facts(opened: Opened): string {
  const faces = opened.faces > 0 ? `${format(opened.faces)} faces, ` : '';
  const megabytes = shortNumber(Number((opened.indexBytes / 2 ** 20).toPrecision(2)));
  const seconds = shortNumber(Number(opened.buildSeconds.toPrecision(2)));
  return `${format(opened.vertices)} vertices, ${faces}index ${megabytes} MB in ${seconds} s`;
}

/** The diagonal of the bounding box, in mean edge lengths. */
function mostEdges({ surface, meanEdge }: Opened): number {
  return meanEdge > 0 ? (2 * surface.extent * surface.unit) / meanEdge : 1;
}
