// SPDX-License-Identifier: MIT
// The kernels of aggregates, compiled once for each instruction set: a source defines MESHHOOD_TARGET, the attribute of
// the functions, MESHHOOD_WIDTH, the doubles of a vector, and MESHHOOD_ROW_BITS, as many powers of two, and includes
// this file. The operations and their order are the same in each, and none is fused, so the results have the same bits.
// The vector types are an extension of g++ and clang.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "simd/aggregate.h"

namespace meshhood {
namespace {

constexpr std::size_t kWidth = MESHHOOD_WIDTH;
using Doubles = double __attribute__((vector_size(8 * MESHHOOD_WIDTH)));
using Bits = std::int64_t __attribute__((vector_size(8 * MESHHOOD_WIDTH)));

// The rows of a packet are processed a block at a time, four vectors that stay in registers.
constexpr int kParts = 4;
constexpr std::size_t kBlock = kParts * kWidth;

constexpr Bits kRowBits{MESHHOOD_ROW_BITS};

// Macros rather than functions: a function that returns such a vector has another calling convention for each
// instruction set.
#define MESHHOOD_LOAD(variable, from) std::memcpy(&(variable), &(from), sizeof(variable))
#define MESHHOOD_STORE(to, variable) std::memcpy(&(to), &(variable), sizeof(variable))

/// Which rows of a part of a block are in a word, whose first bit is that of the first row of the block.
#define MESHHOOD_ROWS(word, part) \
  (((Bits{} + static_cast<std::int64_t>(word)) & (kRowBits << (MESHHOOD_WIDTH * (part)))) != 0)

/// Adds a number to each row of a block. Branch-free TwoSum: D. E. Knuth, The Art of Computer Programming, vol. 2, sec.
/// 4.2.2, theorem B.
MESHHOOD_TARGET inline void add_exactly(RowSums& sums, std::size_t block, const Doubles* addends) {
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t first = block + kWidth * part;
    Doubles high;
    Doubles low;
    MESHHOOD_LOAD(high, sums.high[first]);
    MESHHOOD_LOAD(low, sums.low[first]);
    const Doubles sum = high + addends[part];
    const Doubles rounded = sum - high;
    low += (high - (sum - rounded)) + (addends[part] - rounded);
    MESHHOOD_STORE(sums.high[first], sum);
    MESHHOOD_STORE(sums.low[first], low);
  }
}

// NOLINTBEGIN(modernize-avoid-c-arrays): a template would lose the attributes of `Doubles`.

MESHHOOD_TARGET void add_values(std::span<const double> values, const QueryWord* words, RowSums& sums) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Doubles sum[kParts]{};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const QueryWord word = words[k] >> block;
      const Doubles value = Doubles{} + values[k];
      for (int part = 0; part < kParts; ++part) sum[part] += MESHHOOD_ROWS(word, part) ? value : Doubles{};
    }
    add_exactly(sums, block, sum);
  }
}

MESHHOOD_TARGET void lower_minima(std::span<const double> values, const QueryWord* words, PerLane<double>& minima) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Doubles least[kParts];
    MESHHOOD_LOAD(least, minima[block]);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const QueryWord word = words[k] >> block;
      const Doubles value = Doubles{} + values[k];
      for (int part = 0; part < kParts; ++part) {
        const Bits lower = MESHHOOD_ROWS(word, part) & (value < least[part]);
        least[part] = lower != 0 ? value : least[part];
      }
    }
    MESHHOOD_STORE(minima[block], least);
  }
}

MESHHOOD_TARGET void sum_deviations(std::span<const double> values, const double* weights, const QueryWord* words,
                                    const PerLane<double>& means, PerLane<double>& deviations,
                                    PerLane<double>& squares) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Doubles mean[kParts];
    MESHHOOD_LOAD(mean, means[block]);
    Doubles sum[kParts]{};
    Doubles square[kParts]{};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const QueryWord word = words[k] >> block;
      for (int part = 0; part < kParts; ++part) {
        const Doubles deviation = MESHHOOD_ROWS(word, part) ? values[k] - mean[part] : Doubles{};
        const Doubles weighted = deviation * weights[k];
        sum[part] += weighted;
        square[part] += weighted * deviation;
      }
    }
    MESHHOOD_STORE(deviations[block], sum);
    MESHHOOD_STORE(squares[block], square);
  }
}

MESHHOOD_TARGET void merge_spreads(const RowSpreads& added, RowSpreads& spreads) {
  for (std::size_t first = 0; first < kPacketCapacity; first += kWidth) {
    Doubles weight;
    Doubles mean;
    Doubles low;
    Doubles squares;
    MESHHOOD_LOAD(weight, spreads.weight[first]);
    MESHHOOD_LOAD(mean, spreads.mean[first]);
    MESHHOOD_LOAD(low, spreads.low[first]);
    MESHHOOD_LOAD(squares, spreads.squares[first]);
    Doubles added_weight;
    Doubles added_mean;
    Doubles added_low;
    Doubles added_squares;
    MESHHOOD_LOAD(added_weight, added.weight[first]);
    MESHHOOD_LOAD(added_mean, added.mean[first]);
    MESHHOOD_LOAD(added_low, added.low[first]);
    MESHHOOD_LOAD(added_squares, added.squares[first]);
    const Doubles sum = weight + added_weight;
    const Doubles step = (added_mean - mean) + (added_low - low);
    const Doubles share = added_weight / sum;
    const Doubles move = step * share;
    const Doubles moved = mean + move;
    const Doubles rounded = moved - mean;
    const Doubles rest = low + ((mean - (moved - rounded)) + (move - rounded));
    const Doubles merged = squares + (added_squares + ((step * step) * weight) * share);
    const Bits is_first = weight == 0.0;  // then the difference of means would round
    const Bits changes = added_weight != 0.0;
    mean = changes ? (is_first ? added_mean : moved) : mean;
    low = changes ? (is_first ? added_low : rest) : low;
    squares = changes ? (is_first ? added_squares : merged) : squares;
    MESHHOOD_STORE(spreads.weight[first], sum);
    MESHHOOD_STORE(spreads.mean[first], mean);
    MESHHOOD_STORE(spreads.low[first], low);
    MESHHOOD_STORE(spreads.squares[first], squares);
  }
}

MESHHOOD_TARGET void set_offsets(const Point& point, const PacketCenters& centers, Offsets& offsets) {
  for (std::size_t first = 0; first < kPacketCapacity; first += kWidth) {
    Doubles x;
    Doubles y;
    Doubles z;
    MESHHOOD_LOAD(x, centers.x[first]);
    MESHHOOD_LOAD(y, centers.y[first]);
    MESHHOOD_LOAD(z, centers.z[first]);
    x = (point.x - x) * centers.unit;
    y = (point.y - y) * centers.unit;
    z = (point.z - z) * centers.unit;
    const Doubles square = (x * x + y * y) + z * z;
    MESHHOOD_STORE(offsets.x[first], x);
    MESHHOOD_STORE(offsets.y[first], y);
    MESHHOOD_STORE(offsets.z[first], z);
    MESHHOOD_STORE(offsets.square[first], square);
  }
}

// Not 1 - d^2 / r^2, whose rounding would give a vertex at the rim a weight.
MESHHOOD_TARGET void set_weights(const Offsets& offsets, const KernelRadius& radius, bool squared,
                                 PerLane<double>& weights) {
  for (std::size_t first = 0; first < kPacketCapacity; first += kWidth) {
    Doubles square;
    MESHHOOD_LOAD(square, offsets.square[first]);
    Doubles weight = ((radius.square - square) + radius.low) * radius.inverse;
    weight = weight > 0.0 ? weight : Doubles{};  // a vertex at the rim may be beyond it by rounding
    if (squared) weight *= weight;
    MESHHOOD_STORE(weights[first], weight);
  }
}

MESHHOOD_TARGET void add_weighted(std::span<const double> values, const QueryWord* words, const RowWeights& weights,
                                  RowSums& sums) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Doubles sum[kParts]{};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const QueryWord word = words[k] >> block;
      Doubles weight[kParts];
      MESHHOOD_LOAD(weight, weights.of_vertex[k][block]);
      for (int part = 0; part < kParts; ++part) {
        sum[part] += MESHHOOD_ROWS(word, part) ? weight[part] * values[k] : Doubles{};
      }
    }
    add_exactly(sums, block, sum);
  }
}

// With q the offset of a vertex from c, and t that of c from the query vertex, d^2 = |q + t|^2, so
//   sum of s d^2 = sum s|q|^2 + 2 t . sum s q + |t|^2 sum s
//   sum of s d^4 = sum s|q|^4 + 4 t . sum s|q|^2 q + 4 t^T (sum s q q^T) t + 2 |t|^2 sum s|q|^2
//                  + 4 |t|^2 (t . sum s q) + |t|^4 sum s
MESHHOOD_TARGET void add_moments(const Moments& moments, const Offsets& offsets, double inverse_square, bool squared,
                                 QueryWord word, RowSums& sums) {
  const auto& [xx, xy, xz, yy, yz, zz] = moments.second;
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    Doubles sum[kParts];
    for (int part = 0; part < kParts; ++part) {
      const std::size_t first = block + kWidth * static_cast<std::size_t>(part);
      Doubles x;
      Doubles y;
      Doubles z;
      Doubles square;
      MESHHOOD_LOAD(x, offsets.x[first]);
      MESHHOOD_LOAD(y, offsets.y[first]);
      MESHHOOD_LOAD(z, offsets.z[first]);
      MESHHOOD_LOAD(square, offsets.square[first]);
      const Doubles along = (x * moments.first[0] + y * moments.first[1]) + z * moments.first[2];
      Doubles less = (moments.trace + 2.0 * along) + square * moments.zeroth;
      if (squared) {
        const Doubles quadratic = (x * x * xx + y * y * yy + z * z * zz) + 2.0 * (x * y * xy + x * z * xz + y * z * yz);
        const Doubles cubic = (x * moments.third[0] + y * moments.third[1]) + z * moments.third[2];
        const Doubles fourths = moments.fourth + 4.0 * (cubic + quadratic) +
                                square * (2.0 * moments.trace + 4.0 * along + square * moments.zeroth);
        less = 2.0 * less - inverse_square * fourths;
      }
      sum[part] = MESHHOOD_ROWS(word >> block, part) ? moments.zeroth - inverse_square * less : Doubles{};
    }
    add_exactly(sums, block, sum);
  }
}

// NOLINTEND(modernize-avoid-c-arrays)

constexpr AggregateKernels kAggregateKernels{add_values,  lower_minima, sum_deviations, merge_spreads,
                                             set_offsets, set_weights,  add_weighted,   add_moments};

}  // namespace
}  // namespace meshhood
