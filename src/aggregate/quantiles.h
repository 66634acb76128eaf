// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/signal_block.h"

namespace meshhood {

/// A quantile. A vertex has a rank by its value, so that the vertices of a packet are read in order without sorting
/// them, once for all of its rows.
class QuantileReduction final : public Reduction {
 public:
  /// The block is not scaled, and its values were not omitted.
  QuantileReduction(const NodeTree& tree, SignalBlock block, double quantile, MissingValues missing);

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  struct Channel {
    std::vector<std::uint32_t> ranks;  // by place; those of NaN are the last
    std::vector<double> values;        // by rank; no NaN
  };

  [[nodiscard]] const NodeTree& tree() const { return *tree_; }
  [[nodiscard]] std::span<const Channel> channels() const { return channels_; }
  [[nodiscard]] double quantile() const { return quantile_; }
  [[nodiscard]] bool propagates() const { return missing_ == MissingValues::Propagate; }

 private:
  const NodeTree* tree_;
  double quantile_;
  MissingValues missing_;
  std::vector<Channel> channels_;
};

}  // namespace meshhood
