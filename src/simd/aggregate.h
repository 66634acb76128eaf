// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "meshhood/aggregate.h"

#include "shared/distance.h"
#include "simd/joint.h"
#include "simd/kernels.h"

/// The inner loops of aggregates compute what up to 32 rows of a packet get from a few values, where a word for each
/// value says which rows have it. As in `Kernels`, each function gives the same result on every processor, bit for bit.
namespace meshhood::inline v0_1 {

/// A sum for each row, as two doubles `high + low`: the rounding of each addition to `high` is added to `low` (Knuth's
/// TwoSum), so that the error does not grow with the number of additions.
struct RowSums {
  PerLane<double> high;
  PerLane<double> low;
};

/// A spread for each row: see `Spread` in aggregate/variances.cpp.
struct RowSpreads {
  PerLane<double> weight;
  PerLane<double> mean;
  PerLane<double> low;
  PerLane<double> squares;
};

/// The query vertices of a packet, and the units in which distances from them are computed: powers of two, or for
/// `AggregateKernels::set_gaussians` the radii.
struct PacketCenters : PointPerLane<double> {
  PerLane<double> unit;  // by which differences of coordinates are multiplied. 0: every weight is 1
};

/// The square of the radius of each query, in its unit.
struct KernelRadii {
  PerLane<double> square;   // rounded
  PerLane<double> low;      // what is missing
  PerLane<double> inverse;  // of `square`
};

/// The position of a point relative to each query vertex of a packet, in the unit of the query.
struct Offsets : PointPerLane<double> {
  PerLane<double> square;  // of the distance
};

/// Sums of s q^i over the vertices of a node, where s is the value of a vertex and q its offset from a fixed point c.
struct Moments {
  double zeroth;                // sum of s
  std::array<double, 3> first;  // s q
  double trace;                 // s |q|^2
  // Only the biweight needs these.
  std::array<double, 6> second;  // s q q^T: xx, xy, xz, yy, yz, zz
  std::array<double, 3> third;   // s |q|^2 q
  double fourth;                 // s |q|^4
};

/// A weight for each row, for each of up to 32 vertices.
using RowWeights = std::array<PerLane<double>, kLeafCapacity>;

/// The Gaussian falls from 1 to 1/1000: it is `1000^-s` for the share s of the squared radius, 0 to 1. It is computed
/// by a polynomial for `1000^(-s/32)`, which is 1 at 0, and squared `kGaussianSquarings` times. Its relative error with
/// all roundings is at most 1e-14. No function of a C library takes part, so it has the same bits everywhere.
constexpr std::array kGaussian{1.0,
                               -0.2158673524681917,
                               0.023299356930803216,
                               -0.001676523498077354,
                               9.047667053802229e-05,
                               -3.906185266943825e-06,
                               1.4052225189689913e-07,
                               -4.316853840930143e-09,
                               1.0627860032275078e-10};
constexpr int kGaussianSquarings = 5;

inline double gaussian(double share) {
  double result = kGaussian.back();
  for (std::size_t i = kGaussian.size() - 1; i-- > 0;) result = result * share + kGaussian[i];
  for (int i = 0; i < kGaussianSquarings; ++i) result *= result;
  return result;
}

struct AggregateKernels {
  /// Adds to each row the values whose word has it. `values` and `words` have the same length, up to 32.
  void (*add_values)(std::span<const double> values, const QueryWord* words, RowSums& sums);

  /// Lowers each row of `minima` to the values whose word has it. No value is NaN.
  void (*lower_minima)(std::span<const double> values, const QueryWord* words, PerLane<double>& minima);

  /// Sets for each row the sums of `weights * (values - mean)` and of `weights * (values - mean)^2` over the values
  /// whose word has it, by the mean of the row.
  void (*sum_deviations)(std::span<const double> values, const double* weights, const QueryWord* words,
                         const PerLane<double>& means, PerLane<double>& deviations, PerLane<double>& squares);

  /// Merges a spread into that of each row, as `Spread::merge` does; one of weight 0 changes nothing.
  void (*merge_spreads)(const RowSpreads& added, RowSpreads& spreads);

  /// Sets the offsets of `point` from the query vertices.
  void (*set_offsets)(const Point& point, const PacketCenters& centers, Offsets& offsets);

  /// Sets the weights of a vertex with these offsets, `1 - d^2/r^2` or, if `squared`, the square of that. None is
  /// negative, and where d^2 is r^2 the weight is 0.
  void (*set_weights)(const Offsets& offsets, const KernelRadii& radii, bool squared, PerLane<double>& weights);

  /// Sets the weights of up to 32 vertices by the Gaussian (see `gaussian`), for the rows of the word of each; those of
  /// other rows have no meaning. Beyond the radius they are that of the radius.
  void (*set_gaussians)(std::span<const Point> points, const QueryWord* words, const PacketCenters& centers,
                        RowWeights& weights);

  /// Sets the weights of a vertex by the lengths of paths to it, for each kernel but the box. An infinite radius makes
  /// the weights 1; where there is no path within the radius they have no meaning.
  void (*set_path_weights)(const PathLengths& lengths, const PathLengths& radii, SmoothingKernel kernel,
                           PerLane<double>& weights);

  /// Adds as `add_values`, but multiplies each value by its weight for the row.
  void (*add_weighted)(std::span<const double> values, const QueryWord* words, const RowWeights& weights,
                       RowSums& sums);

  /// Adds to the rows of `word` the weighted sum over a node, `sum of s (1 - d^2/r^2)`, or with the square of the
  /// parenthesis if `squared`. `offsets` are those of the point that the moments are about; in the rows of `word` they
  /// have the unit of the moments.
  void (*add_moments)(const Moments& moments, const Offsets& offsets, const KernelRadii& radii, bool squared,
                      QueryWord word, RowSums& sums);
};

/// Returns the kernels for `isa`, which the processor must have.
[[nodiscard]] const AggregateKernels& aggregate_kernels(Isa isa);

}  // namespace meshhood::inline v0_1
