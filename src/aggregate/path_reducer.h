// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/aggregate.h"

#include "aggregate/maximal_nodes.h"
#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/sums.h"
#include "exact/joint/packet_answer.h"
#include "exact/joint/path_packet.h"
#include "simd/aggregate.h"

namespace meshhood {

/// Reduces the vertices that the queries of a packet reach along the edges. What a query gets does not depend on the
/// others. One object a thread.
class PathReducer {
 public:
  PathReducer() = default;
  PathReducer(const PathReducer&) = delete;
  PathReducer& operator=(const PathReducer&) = delete;
  virtual ~PathReducer() = default;

  /// Reduces the vertices within the radii, one for each query and at most that of its search.
  virtual void reduce(PathPacket& packet, std::span<const double> radii) = 0;

  /// Writes the result of a query, a number for each channel.
  virtual void write(std::size_t query, std::span<double> channels) = 0;
};

/// Reduces them as the neighborhoods of a packet.
class PathSetReducer final : public PathReducer {
 public:
  /// Borrows `tree`, and what `reducer` borrows.
  PathSetReducer(const NodeTree& tree, std::unique_ptr<PacketReducer> reducer)
      : nodes_(tree), reducer_(std::move(reducer)) {}

  void reduce(PathPacket& packet, std::span<const double> radii) override;
  void write(std::size_t query, std::span<double> channels) override { reducer_->write(query, channels); }

 private:
  MaximalNodes nodes_;
  std::unique_ptr<PacketReducer> reducer_;
};

/// Sum and mean with weights that fall with the length of the path.
class PathKernelReducer final : public PathReducer {
 public:
  /// With a kernel that is not the box. Borrows `columns`.
  PathKernelReducer(const SumColumns& columns, SmoothingKernel kernel);

  void reduce(PathPacket& packet, std::span<const double> radii) override;
  void write(std::size_t query, std::span<double> channels) override;

 private:
  const AggregateKernels* kernels_;
  const SumColumns* columns_;
  SmoothingKernel kernel_;
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
};

}  // namespace meshhood
