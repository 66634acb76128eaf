// SPDX-License-Identifier: MIT
// What the answers and their times mean, in words.
import type { Method } from './messages';
import { format, shortNumber } from './numbers';

const NAMES = { ball: 'plain ball', paper: 'approximate method' } as const;

/** A sentence of which some parts are emphasized. */
export type Sentence = (string | { emphasized: string })[];

const vertices = (count: number, kind = '') => `${format(count)} ${kind}${count === 1 ? 'vertex' : 'vertices'}`;

/** How the sizes of the answers of `ball` and `paper` differ from that of `exact`, the one that is right. */
export function differences(sizes: Map<Method, number>): Sentence {
  const exact = sizes.get('exact');
  if (exact === undefined) return [];
  const compared = (['ball', 'paper'] as const).filter((method) => sizes.has(method));
  const wrong = compared.filter((method) => sizes.get(method)! > exact);
  if (compared.length === 0) return [`${vertices(exact)}.`];
  if (wrong.length === 0) return [`All methods find the same ${vertices(exact)}.`];
  const parts = wrong.map((method, i): Sentence => {
    const count = sizes.get(method)! - exact;
    return i === 0
      ? [`The ${NAMES[method]} has `, { emphasized: vertices(count, 'wrong ') }]
      : [`, the ${NAMES[method]} `, { emphasized: format(count) }];
  });
  return [...parts.flat(), '.'];
}

/** Ratios between these say nothing, as the times of a browser differ from load to load. */
const ALIKE = [0.7, 1.4];

/** How the time of the index compares with that of breadth-first search. */
export function comparison(times: Map<Method, number>): Sentence {
  const [exact, bfs] = [times.get('exact'), times.get('bfs')];
  if (exact === undefined || bfs === undefined) return [];
  const ratio = bfs / exact;
  const round = (x: number) => shortNumber(Number(x.toPrecision(2)));
  if (ratio >= ALIKE[0] && ratio <= ALIKE[1]) return ['The index is ', { emphasized: 'about as fast' }, ' as breadth-first search.'];
  if (ratio > 1) return ['The index is ', { emphasized: `${round(ratio)} times as fast` }, ' as breadth-first search.'];
  return ['Breadth-first search is ', { emphasized: `${round(1 / ratio)} times as fast` }, ' as the index here.'];
}
