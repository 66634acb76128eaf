// SPDX-License-Identifier: MIT
// Numbers that the neighborhoods of all vertices give, for colors.
import type { Curvature } from 'meshhood';

import type { Scalar } from './scalar';

type Quantity = Omit<Scalar, 'values'>;

export const QUANTITIES = {
  count: { title: 'vertices' },
  mean: { title: 'mean curvature', isSigned: true },
  gaussian: { title: 'Gaussian curvature', isSigned: true },
  k1: { title: 'larger curvature', isSigned: true },
  k2: { title: 'smaller curvature', isSigned: true },
  shapeIndex: { title: 'shape index', range: [-1, 1] },
  curvedness: { title: 'curvedness' },
} satisfies Record<string, Quantity>;

export type QuantityName = keyof typeof QUANTITIES;
export type CurvatureName = Exclude<QuantityName, 'count'> & keyof Curvature;

export function isQuantity(name: string): name is QuantityName {
  return Object.hasOwn(QUANTITIES, name);
}

export function toScalar(name: QuantityName, values: ArrayLike<number>): Scalar {
  return { ...(QUANTITIES[name] as Quantity), values };
}
