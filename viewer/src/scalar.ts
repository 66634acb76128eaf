// SPDX-License-Identifier: MIT
// A value for each vertex, which colors show.

/** A value for each vertex; one that is not finite is missing. */
export interface Scalar {
  title: string;
  values: ArrayLike<number>;
  /** 0 is in the middle of the colors, also where all values have the same sign. */
  isSigned?: boolean;
  /** Of the colors; by default it follows from the values. */
  range?: Range;
}

export type Range = [number, number];

/** The finite values of at most 200,000 vertices, ascending. */
function sampleOf(values: ArrayLike<number>): Float64Array {
  const step = Math.max(1, Math.floor(values.length / 100_000));
  const sample = Float64Array.from({ length: Math.ceil(values.length / step) }, (_, i) => values[i * step]);
  return sample.filter(Number.isFinite).sort();
}

/**
 * The range of a color map: from the 2nd to the 98th hundredth, so that a few extreme values do not hide the others.
 * Where 0 is between these, from -m to m, where m is the 96th hundredth of the magnitudes.
 */
export function scalarRange({ values, isSigned = false, range }: Scalar): Range {
  if (range !== undefined) return range;
  const sample = sampleOf(values);
  if (sample.length === 0) return [0, 1];
  const at = (fraction: number, sorted = sample) => sorted[Math.round(fraction * (sorted.length - 1))];
  const [low, high] = at(0.02) < at(0.98) ? [at(0.02), at(0.98)] : [at(0), at(1)];
  if (!isSigned && (low >= 0 || high <= 0)) return [low, high];
  const magnitudes = sample.map(Math.abs).sort();
  const most = at(0.96, magnitudes) || at(1, magnitudes) || 1;
  return [-most, most];
}
