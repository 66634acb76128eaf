// SPDX-License-Identifier: MIT
// Numbers as the page writes them.

const grouped = new Intl.NumberFormat('en');
export const format = (value: number) => grouped.format(value);

/** Four digits, without an exponent in the usual range. */
export function shortNumber(value: number): string {
  return String(Number.isFinite(value) ? Number(value.toPrecision(4)) : value);
}
