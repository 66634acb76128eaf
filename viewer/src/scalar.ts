// SPDX-License-Identifier: MIT
// A value for each vertex, which colors show.

/** A value for each vertex; one that is not finite is missing. */
export interface Scalar {
  title: string;
  values: ArrayLike<number>;
  /** 0 is in the middle of the colors. */
  isSigned?: boolean;
  /** Of the colors; by default it follows from the values. */
  range?: Range;
}

export type Range = [number, number];

/** Values of at most 100,000 vertices, ascending. */
function sampleOf(values: ArrayLike<number>, of: (value: number) => number): number[] {
  const step = Math.max(1, Math.floor(values.length / 100_000));
  const sample: number[] = [];
  for (let v = 0; v < values.length; v += step) {
    if (Number.isFinite(values[v])) sample.push(of(values[v]));
  }
  return sample.sort((a, b) => a - b);
}

/**
 * The range of a color map: from the 2nd to the 98th hundredth, so that a few extreme values do not hide the others. Of
 * numbers of both signs, from -m to m, where m is the 96th hundredth of their magnitudes.
 */
export function scalarRange({ values, isSigned = false, range }: Scalar): Range {
  if (range !== undefined) return range;
  const sample = sampleOf(values, isSigned ? Math.abs : (value) => value);
  if (sample.length === 0) return [0, 1];
  const at = (fraction: number) => sample[Math.round(fraction * (sample.length - 1))];
  const [low, high] = isSigned ? [-at(0.96), at(0.96)] : [at(0.02), at(0.98)];
  return low < high ? [low, high] : [at(0), at(1)];
}
