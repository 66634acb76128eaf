// SPDX-License-Identifier: MIT
// Numbers as the page writes them.

const grouped = new Intl.NumberFormat('en');
export const format = (value: number) => grouped.format(value);

/** Four digits, without an exponent in the usual range. */
export function shortNumber(value: number): string {
  if (!Number.isFinite(value) || value === 0) return String(value);
  return String(Number(value.toPrecision(4)));
}
