// SPDX-License-Identifier: MIT
// The state of the page in its address, so that a link shows the same.
import type { Cut, Look } from './view';

export interface State {
  /** Absent for a mesh from a file, which a link cannot hold. */
  example: string | null;
  vertex: number | null;
  /** In mean edge lengths. */
  radius: number | null;
  hidden: string[];
  look: Look;
  /** What the colors show: the methods, a quantity, or a property of the file. */
  color: string;
  camera: number[] | null;
}

const CUTS: readonly Cut[] = ['none', 'x', 'y', 'z'];

export function toHash(state: State): string {
  const parameters = new URLSearchParams();
  if (state.example !== null) parameters.set('example', state.example);
  if (state.vertex !== null) parameters.set('vertex', String(state.vertex));
  if (state.radius !== null) parameters.set('radius', String(state.radius));
  if (state.hidden.length > 0) parameters.set('without', state.hidden.join(','));
  if (state.look.cut !== 'none') parameters.set('cut', state.look.cut);
  if (state.look.hideNearer) parameters.set('nearer', 'hidden');
  if (state.look.wireframe) parameters.set('edges', 'shown');
  if (!state.look.ball) parameters.set('ball', 'hidden');
  if (state.color !== 'answers') parameters.set('color', state.color);
  if (state.camera !== null) parameters.set('camera', state.camera.join(','));
  return `#${parameters.toString().replaceAll('%2C', ',')}`;
}

/** Values that are missing in the address, by default all, or are not numbers, are null. */
export function fromHash(hash = ''): State {
  const parameters = new URLSearchParams(hash.replace(/^#/, ''));
  const camera = (parameters.get('camera') ?? '').split(',').map(Number);
  return {
    example: parameters.get('example'),
    vertex: toNumber(parameters.get('vertex'), Number.isInteger),
    radius: toNumber(parameters.get('radius'), Number.isFinite),
    hidden: (parameters.get('without') ?? '').split(',').filter((name) => name !== ''),
    look: {
      cut: CUTS.find((cut) => cut === parameters.get('cut')) ?? 'none',
      hideNearer: parameters.get('nearer') === 'hidden',
      wireframe: parameters.get('edges') === 'shown',
      ball: parameters.get('ball') !== 'hidden',
    },
    color: parameters.get('color') ?? 'answers',
    camera: camera.length === 6 && camera.every(Number.isFinite) ? camera : null,
  };
}

/** `radius` in mean edge lengths, with the fewest digits that give the same radius again, if any do. */
export function toEdges(radius: number, meanEdge: number): number {
  const edges = radius / meanEdge;
  for (let digits = 1; digits <= 17; ++digits) {
    const rounded = Number(edges.toPrecision(digits));
    if (rounded * meanEdge === radius) return rounded;
  }
  return edges;
}

function toNumber(text: string | null, accept: (value: unknown) => boolean): number | null {
  const value = text === null || text === '' ? NaN : Number(text);
  return accept(value) && value >= 0 ? value : null;
}
