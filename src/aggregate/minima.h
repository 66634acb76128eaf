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

/// The minimum; of negated values for the maximum. NaN marks a missing value, or propagates to the result.
class MinimumReduction final : public Reduction {
 public:
  /// The block is not scaled, and its values were not omitted.
  MinimumReduction(const NodeTree& tree, const AggregateKernels& kernels, SignalBlock block, bool maximum,
                   MissingValues missing);

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  struct Channel {
    Column values;
    bool has_nan;
    std::vector<double> node_minima;
  };

  [[nodiscard]] const AggregateKernels& kernels() const { return *kernels_; }
  [[nodiscard]] std::span<const Channel> channels() const { return channels_; }
  [[nodiscard]] bool propagates() const { return missing_ == MissingValues::Propagate; }
  [[nodiscard]] bool is_maximum() const { return maximum_; }

 private:
  [[nodiscard]] double minimum_of(std::span<const double> values) const;

  const AggregateKernels* kernels_;
  bool maximum_;
  MissingValues missing_;
  std::vector<Channel> channels_;
};

}  // namespace meshhood
