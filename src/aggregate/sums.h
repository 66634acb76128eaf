// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/signal_block.h"
#include "simd/aggregate.h"

namespace meshhood {

/// The columns that are added up for a sum, a mean or a count, and how the result follows from their sums.
class SumColumns {
 public:
  /// `reduce` is one of these three. A count has no values to add; of a mean and a count, the weights are added, too.
  SumColumns(SignalBlock block, Reduce reduce);

  [[nodiscard]] std::size_t size() const { return columns_.size(); }
  [[nodiscard]] std::size_t channels() const { return channels_.size(); }
  [[nodiscard]] const Column& column(std::size_t i) const { return columns_[i]; }

  /// Adds the values of a leaf to the rows of its words, times the weights.
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
  std::vector<Channel> channels_;
};

/// Sum, mean and count with the weight of a vertex alone.
class SumReduction final : public Reduction {
 public:
  SumReduction(const NodeTree& tree, const AggregateKernels& kernels, SumColumns columns);

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }
  [[nodiscard]] const SumColumns& columns() const { return columns_; }
  [[nodiscard]] const std::vector<double>& node_sums(std::size_t column) const { return node_sums_[column]; }

 private:
  const AggregateKernels* kernels_;
  SumColumns columns_;
  std::vector<std::vector<double>> node_sums_;  // by column, then by node
};

}  // namespace meshhood
