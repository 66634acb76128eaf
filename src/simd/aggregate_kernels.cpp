// SPDX-License-Identifier: MIT
// `AggregateKernels` is compiled once for each target; see lanes-inl.h. The operations and their order are the same for
// each target, and none is fused, so the results have the same bits.
#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/aggregate.h"
#include "simd/leaf.h"

#define HWY_TARGET_INCLUDE "simd/aggregate_kernels.cpp"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

/// Returns the rows from `first` on that are in the word.
HWY_INLINE hn::Mask<Doubles> rows_in(QueryWord word, std::size_t first) {
  return hn::RebindMask(Doubles(), hn::TestBit(splat(std::uint64_t{word}), lane_bits(Doubles(), first)));
}

// The rows of a packet are processed a block at a time, a few vectors that stay in registers.
constexpr std::size_t kParts = 4;
constexpr std::size_t kBlock = kParts * kLanes<Doubles>;
using Block = Numbers[kParts];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment

/// Computes the rounded sum and its error by the branch-free TwoSum: D. E. Knuth, The Art of Computer Programming, vol.
/// 2, sec. 4.2.2, theorem B.
struct ExactSum {
  HWY_INLINE ExactSum(Numbers a, Numbers b) : sum(hn::Add(a, b)) {
    const auto rounded = hn::Sub(sum, a);
    rest = hn::Add(hn::Sub(a, hn::Sub(sum, rounded)), hn::Sub(b, rounded));
  }

  Numbers sum;
  Numbers rest;
};

/// Adds to each row the sum of the terms whose word has it. `term(k, i)` gives those of word k for the rows from i on.
template <class Term>
HWY_INLINE void add_terms(std::span<const QueryWord> words, RowSums& sums, const Term& term) {
  const Doubles d;
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Block sum;
    for (Numbers& part : sum) part = hn::Zero(d);
    for (std::size_t k = 0; k < words.size(); ++k) {
      for (std::size_t part = 0; part < kParts; ++part) {
        const std::size_t i = block + part * kLanes<Doubles>;
        sum[part] = hn::Add(sum[part], only(d, rows_in(words[k], i), term(k, i)));
      }
    }
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::size_t i = block + part * kLanes<Doubles>;
      const ExactSum exact(load(sums.high[i]), sum[part]);
      store(exact.sum, sums.high[i]);
      add_to(sums.low[i], exact.rest);
    }
  }
}

void add_values(std::span<const double> values, const QueryWord* words, RowSums& sums) {
  add_terms({words, values.size()}, sums, [&](std::size_t k, std::size_t /*i*/) HWY_ATTR { return splat(values[k]); });
}

void add_weighted(std::span<const double> values, const QueryWord* words, const RowWeights& weights, RowSums& sums) {
  add_terms({words, values.size()}, sums,
            [&](std::size_t k, std::size_t i) HWY_ATTR { return hn::Mul(load(weights[k][i]), splat(values[k])); });
}

void lower_minima(std::span<const double> values, const QueryWord* words, PerLane<double>& minima) {
  const Doubles d;
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Block least;
    for (std::size_t part = 0; part < kParts; ++part) least[part] = load(minima[block + part * kLanes<Doubles>]);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto value = splat(values[k]);
      for (std::size_t part = 0; part < kParts; ++part) {
        const auto rows = rows_in(words[k], block + part * kLanes<Doubles>);
        least[part] = either(d, hn::And(rows, hn::Lt(value, least[part])), value, least[part]);
      }
    }
    for (std::size_t part = 0; part < kParts; ++part) store(least[part], minima[block + part * kLanes<Doubles>]);
  }
}

void sum_deviations(std::span<const double> values, const double* weights, const QueryWord* words,
                    const PerLane<double>& means, PerLane<double>& deviations, PerLane<double>& squares) {
  const Doubles d;
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Block mean;
    Block sum;
    Block square;
    for (std::size_t part = 0; part < kParts; ++part) {
      mean[part] = load(means[block + part * kLanes<Doubles>]);
      sum[part] = square[part] = hn::Zero(d);
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto value = splat(values[k]);
      const auto weight = splat(weights[k]);
      for (std::size_t part = 0; part < kParts; ++part) {
        const auto rows = rows_in(words[k], block + part * kLanes<Doubles>);
        const auto deviation = only(d, rows, hn::Sub(value, mean[part]));
        const auto weighted = hn::Mul(deviation, weight);
        sum[part] = hn::Add(sum[part], weighted);
        square[part] = hn::Add(square[part], hn::Mul(weighted, deviation));
      }
    }
    for (std::size_t part = 0; part < kParts; ++part) {
      store(sum[part], deviations[block + part * kLanes<Doubles>]);
      store(square[part], squares[block + part * kLanes<Doubles>]);
    }
  }
}

void merge_spreads(const RowSpreads& added, RowSpreads& spreads) {
  const Doubles d;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    const auto weight = load(spreads.weight[i]);
    const auto mean = load(spreads.mean[i]);
    const auto low = load(spreads.low[i]);
    const auto squares = load(spreads.squares[i]);
    const auto added_weight = load(added.weight[i]);
    const auto added_mean = load(added.mean[i]);
    const auto added_low = load(added.low[i]);
    const auto added_squares = load(added.squares[i]);
    const auto sum = hn::Add(weight, added_weight);
    const auto step = hn::Add(hn::Sub(added_mean, mean), hn::Sub(added_low, low));
    const auto share = hn::Div(added_weight, sum);
    const ExactSum moved(mean, hn::Mul(step, share));
    const auto between = hn::Mul(hn::Mul(hn::Mul(step, step), weight), share);
    const auto merged = hn::Add(squares, hn::Add(added_squares, between));
    const auto is_first = hn::Eq(weight, hn::Zero(d));  // the difference of means would then round
    const auto stays = hn::Eq(added_weight, hn::Zero(d));
    const auto chosen = [&](Numbers old, Numbers first, Numbers both)
                            HWY_ATTR { return either(d, stays, old, either(d, is_first, first, both)); };
    store(sum, spreads.weight[i]);
    store(chosen(mean, added_mean, moved.sum), spreads.mean[i]);
    store(chosen(low, added_low, hn::Add(low, moved.rest)), spreads.low[i]);
    store(chosen(squares, added_squares, merged), spreads.squares[i]);
  }
}

void set_offsets(const Point& point, const PacketCenters& centers, Offsets& offsets) {
  const Doubles d;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    const auto offset = scaled(difference(splat_point(d, point), load_rows(d, centers, i)), load(centers.unit[i]));
    store_rows(offset, offsets, i);
    store(squared_length(offset), offsets.square[i]);
  }
}

/// Sets each weight to `weight(i)`, for the rows from i on, or to the square of that.
template <class Weight>
HWY_INLINE void set_each(PerLane<double>& weights, bool squared, const Weight& weight) {
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    auto number = weight(i);
    if (squared) number = hn::Mul(number, number);
    store(number, weights[i]);
  }
}

// The formulas are not 1 - d^2 / r^2 and 1 - t^2, whose rounding would give a vertex at the radius a weight.

void set_weights(const Offsets& offsets, const KernelRadii& radii, bool squared, PerLane<double>& weights) {
  set_each(weights, squared, [&](std::size_t i) HWY_ATTR {
    const auto rest = hn::Add(hn::Sub(load(radii.square[i]), load(offsets.square[i])), load(radii.low[i]));
    const auto weight = hn::Mul(rest, load(radii.inverse[i]));
    const Doubles d;
    return only(d, hn::Gt(weight, hn::Zero(d)), weight);  // at the radius, rounding may make it negative
  });
}

/// Returns `gaussian` of each share, and that of 1 for larger ones and NaN.
HWY_INLINE Numbers gaussians(Numbers shares) {
  shares = either(Doubles(), hn::Lt(shares, splat(1.0)), shares, splat(1.0));
  auto result = splat(kGaussian.back());
  for (std::size_t i = kGaussian.size() - 1; i-- > 0;) result = hn::Add(hn::Mul(result, shares), splat(kGaussian[i]));
  for (int i = 0; i < kGaussianSquarings; ++i) result = hn::Mul(result, result);
  return result;
}

void set_gaussians(std::span<const Point> points, const QueryWord* words, const PacketCenters& centers,
                   RowWeights& weights) {
  const Doubles d;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    const QueryWord rows = first_lanes(kLanes<Doubles>) << i;
    const auto center = load_rows(d, centers, i);
    const auto unit = load(centers.unit[i]);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if ((words[k] & rows) == 0) continue;
      const auto offset = scaled(difference(splat_point(d, points[k]), center), unit);
      store(gaussians(squared_length(offset)), weights[k][i]);
    }
  }
}

void set_path_weights(const PathLengths& lengths, const PathLengths& radii, SmoothingKernel kernel,
                      PerLane<double>& weights) {
  set_each(weights, kernel == SmoothingKernel::Biweight, [&](std::size_t i) HWY_ATTR {
    const auto t = hn::Div(load(lengths[i]), load(radii[i]));
    if (kernel == SmoothingKernel::Gaussian) return gaussians(hn::Mul(t, t));
    return hn::Mul(hn::Sub(splat(1.0), t), hn::Add(splat(1.0), t));
  });
}

// With q the offset of a vertex from c, and t that of c from the query vertex, d^2 = |q + t|^2, so
//   sum of s d^2 = sum s|q|^2 + 2 t . sum s q + |t|^2 sum s
//   sum of s d^4 = sum s|q|^4 + 4 t . sum s|q|^2 q + 4 t^T (sum s q q^T) t + 2 |t|^2 sum s|q|^2
//                  + 4 |t|^2 (t . sum s q) + |t|^4 sum s
void add_moments(const Moments& moments, const Offsets& offsets, const KernelRadii& radii, bool squared, QueryWord word,
                 RowSums& sums) {
  const Doubles d;
  const auto& [xx, xy, xz, yy, yz, zz] = moments.second;
  const auto two = splat(2.0);
  const auto four = splat(4.0);
  const auto zeroth = splat(moments.zeroth);
  const Points<Doubles> first{splat(moments.first[0]), splat(moments.first[1]), splat(moments.first[2])};
  const Points<Doubles> third{splat(moments.third[0]), splat(moments.third[1]), splat(moments.third[2])};
  const Points<Doubles> diagonal{splat(xx), splat(yy), splat(zz)};
  const Points<Doubles> mixed{splat(xy), splat(xz), splat(yz)};
  add_terms({&word, 1}, sums, [&](std::size_t /*k*/, std::size_t i) HWY_ATTR {
    const auto offset = load_rows(d, offsets, i);
    const auto& [x, y, z] = offset;
    const auto square = load(offsets.square[i]);
    const auto inverse = load(radii.inverse[i]);
    const auto along = scalar_product(offset, first);
    auto less = hn::Add(hn::Add(splat(moments.trace), hn::Mul(two, along)), hn::Mul(square, zeroth));
    if (squared) {
      const auto quadratic =
          hn::Add(scalar_product({hn::Mul(x, x), hn::Mul(y, y), hn::Mul(z, z)}, diagonal),
                  hn::Mul(two, scalar_product({hn::Mul(x, y), hn::Mul(x, z), hn::Mul(y, z)}, mixed)));
      const auto cubic = scalar_product(offset, third);
      const auto by_square =
          hn::Add(hn::Add(splat(2.0 * moments.trace), hn::Mul(four, along)), hn::Mul(square, zeroth));
      const auto fourths =
          hn::Add(hn::Add(splat(moments.fourth), hn::Mul(four, hn::Add(cubic, quadratic))), hn::Mul(square, by_square));
      less = hn::Sub(hn::Mul(two, less), hn::Mul(inverse, fourths));
    }
    return hn::Sub(zeroth, hn::Mul(inverse, less));
  });
}

constexpr AggregateKernels kAggregateKernels{add_values,  lower_minima,  sum_deviations,   merge_spreads, set_offsets,
                                             set_weights, set_gaussians, set_path_weights, add_weighted,  add_moments};

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
const meshhood::AggregateKernels& meshhood::aggregate_kernels(Isa isa) {
  return MESHHOOD_TABLE(kAggregateKernels, isa);
}
#endif
