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

/// The median. A vertex has a rank by its value, so that the vertices of a packet are read in order without sorting
/// them: once for all of its rows.
class MedianReduction final : public Reduction {
 public:
  /// The block is not scaled, and its values were not omitted.
  MedianReduction(const NodeTree& tree, SignalBlock block, MissingValues missing);

  [[nodiscard]] std::unique_ptr<PacketReducer> make_reducer() const override;

  struct Channel {
    std::vector<std::uint32_t> ranks;  // by place; those of NaN are the last
    std::vector<double> values;        // by rank; no NaN
  };

  [[nodiscard]] const NodeTree& tree() const { return *tree_; }
  [[nodiscard]] std::span<const Channel> channels() const { return channels_; }
  [[nodiscard]] bool propagates() const { return missing_ == MissingValues::Propagate; }

 private:
  const NodeTree* tree_;
  MissingValues missing_;
  std::vector<Channel> channels_;
};

}  // namespace meshhood
