// SPDX-License-Identifier: MIT
// Numbers that the neighborhoods of all vertices give, for colors.
import type { Curvature } from 'meshhood';

import type { Range, Scalar } from './scalar';

/** How the values of a quantity are shown. */
interface Quantity {
  title: string;
  isSigned: boolean;
  range?: Range;
}

export const QUANTITIES = {
  count: { title: 'vertices', isSigned: false },
  mean: { title: 'mean curvature', isSigned: true },
  gaussian: { title: 'Gaussian curvature', isSigned: true },
  k1: { title: 'larger curvature', isSigned: true },
  k2: { title: 'smaller curvature', isSigned: true },
  shapeIndex: { title: 'shape index', isSigned: true, range: [-1, 1] },
  curvedness: { title: 'curvedness', isSigned: false },
} satisfies Record<string, Quantity>;

export type QuantityName = keyof typeof QUANTITIES;
export type CurvatureName = Exclude<QuantityName, 'count'> & keyof Curvature;

export function isQuantity(name: string): name is QuantityName {
  return Object.hasOwn(QUANTITIES, name);
}

export function toScalar(name: QuantityName, values: ArrayLike<number>): Scalar {
  return { ...(QUANTITIES[name] as Quantity), values };
}
