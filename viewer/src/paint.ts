// SPDX-License-Identifier: MIT
// What is drawn of each vertex, as bytes: its color under the answers, that of the plain surface or of a scalar; and
// the answers that have it. The shader draws the answers over the colors (answer_shader.ts).
import { AMOUNTS, MISSING_COLOR, SIGNED, SURFACE_COLOR, linearBytes } from './colors';
import type { ColorMap, Rgb } from './colors';
import type { Method } from './messages';
import { scalarRange } from './scalar';
import type { Range, Scalar } from './scalar';

/** From top to bottom, as in Figure 4 of the paper. The places of their bytes. */
const LAYERS = ['exact', 'paper', 'ball'] as const;

export function mapOf([low, high]: Range): ColorMap {
  return low < 0 && high > 0 ? SIGNED : AMOUNTS;
}

export class Painting {
  /** #V by 4: red, green and blue; the last byte is not used. */
  readonly colors: Uint8Array;
  /** #V by 4: 255 for each layer that has the vertex, else 0; the last byte is not used. */
  readonly answers: Uint8Array;
  #painted: Uint32Array[] = [];

  constructor(vertices: number) {
    this.colors = new Uint8Array(4 * vertices);
    this.answers = new Uint8Array(4 * vertices);
    this.setScalar(null);
  }

  /** Replaces what is drawn under the answers. */
  setScalar(scalar: Scalar | null): Range | null {
    const range = scalar === null ? null : scalarRange(scalar);
    const color = scalar === null ? () => SURFACE : colorsOf(scalar, range!);
    for (let v = 0; 4 * v < this.colors.length; ++v) this.colors.set(color(v), 4 * v);
    return range;
  }

  /** Paints the answers of the methods that `answers` has. */
  setAnswers(answers: Map<Method, Uint32Array>): void {
    for (const ids of this.#painted) {
      for (const v of ids) this.answers.fill(0, 4 * v, 4 * v + LAYERS.length);
    }
    this.#painted = [];
    LAYERS.forEach((method, layer) => {
      const ids = answers.get(method);
      if (ids === undefined) return;
      for (const v of ids) this.answers[4 * v + layer] = 255;
      this.#painted.push(ids);
    });
  }
}

const SURFACE = linearBytes(SURFACE_COLOR);
const MISSING = linearBytes(MISSING_COLOR);

/** The color of each vertex. */
function colorsOf(scalar: Scalar, [low, high]: Range): (v: number) => Rgb {
  const { table } = mapOf([low, high]);
  return (v) => {
    const value = scalar.values[v];
    if (!Number.isFinite(value)) return MISSING;
    const t = high > low ? (value / 2 - low / 2) / (high / 2 - low / 2) : 0; // halves, whose differences are finite
    return table[Math.round(255 * Math.min(1, Math.max(0, t)))];
  };
}
