// SPDX-License-Identifier: MIT
// Colors: those of the methods, which color-blind people can distinguish (Okabe and Ito, 2008), and a
// perceptually uniform map for scalars (viridis of Matplotlib, by a polynomial fit).
import { Color } from 'three';

import type { Method } from './messages';

export const METHOD_COLORS: Record<Exclude<Method, 'bfs'>, string> = {
  exact: '#009e73',
  paper: '#f0e442',
  ball: '#0072b2',
};
export const VERTEX_COLOR = '#d55e00';
export const SURFACE_COLOR = '#d9dbe0';

export type Rgb = readonly [number, number, number];

/** Bytes of linear light, as vertex colors are. */
export function linearBytes(color: string): Rgb {
  const { r, g, b } = new Color(color);
  return [Math.round(255 * r), Math.round(255 * g), Math.round(255 * b)];
}

/** Coefficients for t^0 to t^6 of red, green and blue. */
const VIRIDIS: readonly Rgb[] = [
  [0.2777273272, 0.0054073445, 0.3340998053],
  [0.1050930431, 1.4046135299, 1.3845901626],
  [-0.3308618287, 0.2148475595, 0.0950951630],
  [-4.6342304990, -5.7991009733, -19.3324409563],
  [6.2282699363, 14.1799333668, 56.6905526007],
  [4.7763849977, -13.7451453774, -65.3530326334],
  [-5.4354558559, 4.6458526121, 26.3124352496],
];

/** The color of `t` in [0, 1], each part in [0, 1], as it is displayed. */
export function viridis(t: number): Rgb {
  return [0, 1, 2].map((channel) => {
    const value = VIRIDIS.reduceRight((sum, coefficients) => sum * t + coefficients[channel], 0);
    return Math.min(1, Math.max(0, value));
  }) as unknown as Rgb;
}

export function toCss([r, g, b]: Rgb): string {
  return `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(' ')})`;
}

/** 256 colors of the map as bytes of linear light. */
export const VIRIDIS_TABLE: readonly Rgb[] = Array.from({ length: 256 }, (_, i) => linearBytes(toCss(viridis(i / 255))));
