// SPDX-License-Identifier: MIT
// What the colors show: the answers, a quantity that is computed for all vertices, or values that came with the mesh.
import type { ColorKey } from './color_key';
import type { Engine } from './engine';
import type { Method, Opened } from './messages';
import { showProgress } from './notices';
import { Painting } from './paint';
import type { Panel } from './panel';
import { isQuantity, toScalar } from './quantities';
import type { QuantityName } from './quantities';
import type { Scalar } from './scalar';
import type { View } from './view';

const ANSWERS = 'answers';
const PASSED = 'passed';

/** Milliseconds after which a radius has stopped changing. */
const QUIET = 400;

export class Coloring {
  readonly #view: View;
  readonly #engine: Engine;
  readonly #panel: Panel;
  readonly #key: ColorKey;
  readonly #changed: () => void;
  #painting = new Painting(0);
  #own = new Map<string, Scalar>(); // the values that came with the mesh, by their choices
  #choice = ANSWERS; // or a quantity, or a key of `own`
  #scalar: Scalar | null = null; // what the colors show, unless the answers
  #answers = new Map<Method, Uint32Array>();
  #given: Uint32Array | null = null;
  #vertex = -1;
  #radius = 0;
  #timer = 0;

  /** Calls `changed` after another choice. */
  constructor(view: View, engine: Engine, panel: Panel, key: ColorKey, changed: () => void) {
    this.#view = view;
    this.#engine = engine;
    this.#panel = panel;
    this.#key = key;
    this.#changed = changed;
  }

  /** Another mesh is open, perhaps with values that were passed to the page. Returns what is drawn of its vertices. */
  open(opened: Opened, passed: Scalar | null): Painting {
    this.#painting = new Painting(opened.vertices);
    this.#own = new Map(opened.scalars.map((scalar) => [`ply:${scalar.title}`, scalar]));
    if (passed !== null) this.#own.set(PASSED, passed);
    this.#panel.ownColors = new Map([...this.#own].map(([choice, { title }]) => [choice, title]));
    this.#answers.clear();
    this.#given = null;
    this.#vertex = -1;
    this.choose(ANSWERS);
    return this.#painting;
  }

  /** The choice of a link, if this mesh has it; else the values that were passed; else the answers. */
  start(linked: string): void {
    const own = this.#own.has(PASSED) ? PASSED : ANSWERS;
    const choice = linked !== ANSWERS && this.#panel.hasColor(linked) ? linked : own;
    if (choice !== ANSWERS) this.#panel.openDisplay();
    this.choose(choice);
  }

  choose(choice: string): void {
    clearTimeout(this.#timer);
    // The colors of a quantity stay until those of the new radius are there.
    if (!isQuantity(choice) || choice !== this.#choice) this.#setScalar(this.#own.get(choice) ?? null);
    this.#choice = choice;
    this.#panel.color = choice;
    this.#engine.request({ kind: 'cancel' });
    if (isQuantity(choice)) this.#engine.request({ kind: 'compute', quantity: choice, radius: this.#radius });
    this.#paint();
    this.#changed();
  }

  /** Quantities are computed again once the radius has stopped changing. */
  setQuery(vertex: number, radius: number): void {
    this.#vertex = vertex;
    this.#showValue();
    if (radius === this.#radius) return;
    this.#radius = radius;
    clearTimeout(this.#timer);
    if (isQuantity(this.#choice)) this.#timer = window.setTimeout(() => this.choose(this.#choice), QUIET);
  }

  /** `given`, if there is one, is shown instead of the answers, and over all colors. */
  setAnswers(answers: Map<Method, Uint32Array>, given: Uint32Array | null): void {
    this.#answers = answers;
    this.#given = given;
    this.#paint();
  }

  receive(quantity: QuantityName, radius: number, values: Uint32Array | Float64Array): void {
    showProgress(null);
    if (this.#choice !== quantity || radius !== this.#radius) return;
    this.#setScalar(toScalar(quantity, values));
    this.#paint();
  }

  #setScalar(scalar: Scalar | null): void {
    this.#scalar = scalar;
    this.#panel.setLegend(scalar, this.#painting.setScalar(scalar));
    this.#view.updateColors();
    this.#showValue();
  }

  #showValue(): void {
    if (this.#scalar !== null && this.#vertex >= 0) this.#panel.setValue(this.#scalar.values[this.#vertex]);
  }

  #paint(): void {
    const answers = this.#choice === ANSWERS ? this.#answers : new Map<Method, Uint32Array>();
    this.#painting.setAnswers(this.#given === null ? answers : new Map([['exact', this.#given]]));
    this.#view.updateAnswers(this.#given === null);
    this.#key.show(answers, this.#given);
  }

  get choice(): string {
    return this.#choice;
  }

  /** What the colors show; null for the answers of the methods. */
  get values(): ArrayLike<number> | null {
    return this.#scalar?.values ?? null;
  }
}
