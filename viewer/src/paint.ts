// SPDX-License-Identifier: MIT
// The colors of all vertices as bytes: the answers, exact over paper over ball, on the plain surface or on a scalar.
import { AMOUNTS, METHOD_COLORS, MISSING_COLOR, SIGNED, SURFACE_COLOR, linearBytes } from './colors';
import type { ColorMap, Rgb } from './colors';
import type { Method } from './messages';
import { scalarRange } from './scalar';
import type { Range, Scalar } from './scalar';

/** From bottom to top, as in Figure 4 of the paper. */
const LAYERS = ['ball', 'paper', 'exact'] as const;

export function mapOf(scalar: Scalar): ColorMap {
  return scalar.isSigned ? SIGNED : AMOUNTS;
}

export class Painting {
  /** #V by 4; the last byte is not used. */
  readonly bytes: Uint8Array;
  readonly #base: Uint8Array;
  #painted: Uint32Array[] = [];

  constructor(vertices: number) {
    this.bytes = new Uint8Array(4 * vertices);
    this.#base = new Uint8Array(4 * vertices);
    this.setScalar(null);
  }

  /** Replaces what is drawn under the answers. */
  setScalar(scalar: Scalar | null): Range | null {
    const range = scalar === null ? null : scalarRange(scalar);
    const color = scalar === null ? () => SURFACE : colorsOf(scalar, range!);
    for (let v = 0; 4 * v < this.#base.length; ++v) this.#base.set(color(v), 4 * v);
    this.bytes.set(this.#base);
    this.#painted = [];
    return range;
  }

  /** Paints the answers of the methods that `answers` has. */
  setAnswers(answers: Map<Method, Uint32Array>): void {
    for (const ids of this.#painted) this.#restore(ids);
    this.#painted = [];
    for (const method of LAYERS) {
      const ids = answers.get(method);
      if (ids === undefined) continue;
      this.#fill(ids, linearBytes(METHOD_COLORS[method]));
      this.#painted.push(ids);
    }
  }

  #fill(ids: Uint32Array, [r, g, b]: Rgb): void {
    const { bytes } = this;
    for (const v of ids) {
      bytes[4 * v] = r;
      bytes[4 * v + 1] = g;
      bytes[4 * v + 2] = b;
    }
  }

  #restore(ids: Uint32Array): void {
    for (const v of ids) {
      for (let i = 4 * v; i < 4 * v + 3; ++i) this.bytes[i] = this.#base[i];
    }
  }
}

const SURFACE = linearBytes(SURFACE_COLOR);
const MISSING = linearBytes(MISSING_COLOR);

/** The color of each vertex. */
function colorsOf(scalar: Scalar, [low, high]: Range): (v: number) => Rgb {
  const { table } = mapOf(scalar);
  return (v) => {
    const value = scalar.values[v];
    if (!Number.isFinite(value)) return MISSING;
    const t = high > low ? (value / 2 - low / 2) / (high / 2 - low / 2) : 0; // halves, whose differences are finite
    return table[Math.round(255 * Math.min(1, Math.max(0, t)))];
  };
}
