// SPDX-License-Identifier: MIT
// Colors: those of the methods, which color-blind people can distinguish (Okabe and Ito, 2008), and two maps for
// scalars, which they can read as well: viridis of Matplotlib, by a polynomial fit, for amounts; and RdBu of ColorBrewer
// (Harrower and Brewer, 2003) for numbers of both signs, blue below 0 and red above.
import type { Method } from 'meshhood';
import { Color } from 'three';

export const METHOD_COLORS: Record<Exclude<Method, 'bfs'>, string> = {
  exact: '#009e73',
  paper: '#f0e442',
  ball: '#0072b2',
};
export const VERTEX_COLOR = '#d55e00';
export const SURFACE_COLOR = '#d9dbe0';
/** Of a vertex without a value. */
export const MISSING_COLOR = '#85888f';

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
function viridis(t: number): Rgb {
  return [0, 1, 2].map((channel) => {
    const value = VIRIDIS.reduceRight((sum, coefficients) => sum * t + coefficients[channel], 0);
    return Math.min(1, Math.max(0, value));
  }) as unknown as Rgb;
}

/** From blue to red, at equal distances. */
const BLUE_TO_RED = [
  '#053061', '#2166ac', '#4393c3', '#92c5de', '#d1e5f0', '#f7f7f7', '#fddbc7', '#f4a582', '#d6604d', '#b2182b', '#67001f',
].map((color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16) / 255));

function blueToRed(t: number): Rgb {
  const place = t * (BLUE_TO_RED.length - 1);
  const step = Math.min(Math.floor(place), BLUE_TO_RED.length - 2);
  const [from, to] = [BLUE_TO_RED[step], BLUE_TO_RED[step + 1]];
  return from.map((part, channel) => part + (place - step) * (to[channel] - part)) as unknown as Rgb;
}

function toCss([r, g, b]: Rgb): string {
  return `rgb(${[r, g, b].map((part) => Math.round(255 * part)).join(', ')})`;
}

/** Colors for the numbers of a range. */
export interface ColorMap {
  /** 256 colors as bytes of linear light. */
  readonly table: readonly Rgb[];
  /** The same from left to right, for a style sheet. */
  readonly gradient: string;
}

function makeMap(color: (t: number) => Rgb): ColorMap {
  const colors = (count: number) => Array.from({ length: count }, (_, i) => toCss(color(i / (count - 1))));
  return { table: colors(256).map(linearBytes), gradient: `linear-gradient(to right, ${colors(21).join(', ')})` };
}

export const AMOUNTS = makeMap(viridis);
export const SIGNED = makeMap(blueToRed);
