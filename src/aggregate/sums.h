// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "aggregate/signal_block.h"
#include "simd/aggregate.h"

namespace meshhood::inline v0_1 {

/// A sum as `high + low`; see `RowSums`.
struct CompensatedSum {
  double high = 0;
  double low = 0;

  void add(double addend) {
    const double sum = high + addend;
    const double rounded = sum - high;
    low += (high - (sum - rounded)) + (addend - rounded);
    high = sum;
  }

  /// Returns the rounded sum. Where it is infinite, `low` is NaN.
  [[nodiscard]] double value() const { return std::isfinite(low) ? high + low : high; }
};

/// Holds the columns that are added up for a sum, a mean or a count, and computes the result from their sums.
class SumColumns {
 public:
  /// `reduce` is one of these three. A count adds no values; a mean and a count add the weights, too.
  SumColumns(SignalBlock block, Reduce reduce);

  [[nodiscard]] std::size_t size() const { return columns_.size(); }
  [[nodiscard]] const Column& column(std::size_t i) const { return columns_[i]; }

  /// Adds the values of a leaf to the rows of its words, times the weights. An infinite one of weight 0 adds nothing.
  void add_weighted(const AggregateKernels& kernels, const VertexRange& vertices, const QueryWord* queries,
                    const RowWeights& weights, std::span<RowSums> sums) const;

  /// Writes the results of a row from the sums of all columns, a number for each channel.
  void write(std::span<const RowSums> sums, std::size_t row, std::span<double> channels) const;

 private:
  struct Values {
    std::size_t column;
    int exponent;  // of two, by which the result is multiplied
  };
  struct Channel {
    Values values;
    Values large;         // of rows whose result would not be finite: see `SignalBlock::large`
    std::size_t weights;  // the column
  };

  [[nodiscard]] double result(const Channel& channel, std::span<const RowSums> sums, std::size_t row) const;

  Reduce reduce_;
  std::vector<Column> columns_;
  std::vector<bool> has_infinite_;  // by column
  std::vector<Channel> channels_;
};

}  // namespace meshhood::inline v0_1
