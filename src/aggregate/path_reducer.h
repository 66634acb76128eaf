// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "meshhood/aggregate.h"

#include "aggregate/maximal_nodes.h"
#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "aggregate/sums.h"
#include "batch/single_packet.h"
#include "exact/layout.h"
#include "exact/query/path_queue.h"
#include "exact/vertex_set.h"

namespace meshhood {

/// Reduces the vertices within a radius along the edges of one vertex. One object a thread.
class PathReducer {
 public:
  PathReducer() = default;
  PathReducer(const PathReducer&) = delete;
  PathReducer& operator=(const PathReducer&) = delete;
  virtual ~PathReducer() = default;

  /// Writes a number for each channel. `paths` are those to the vertices that are reduced, in an order that the query
  /// determines; each is at most `radius` long.
  virtual void reduce(std::span<const Path> paths, double radius, std::span<double> channels) = 0;
};

/// Reduces a set of vertices as the neighborhood of a packet of one row.
class PathSetReducer final : public PathReducer {
 public:
  /// Borrows `tree`, and what `reducer` borrows.
  PathSetReducer(const IndexView& index, const NodeTree& tree, std::unique_ptr<PacketReducer> reducer)
      : index_(&index), nodes_(tree), reducer_(std::move(reducer)), set_(index) {}

  void reduce(std::span<const Path> paths, double radius, std::span<double> channels) override;

 private:
  const IndexView* index_;
  MaximalNodes nodes_;
  std::unique_ptr<PacketReducer> reducer_;
  std::vector<LeafSubset> lanes_;
  VertexSet set_;
  SinglePacket packet_;
};

/// Sum and mean with weights that fall with the length of the path.
class PathKernelReducer final : public PathReducer {
 public:
  /// Borrows `columns`.
  PathKernelReducer(const SumColumns& columns, SmoothingKernel kernel) : columns_(&columns), kernel_(kernel) {}

  void reduce(std::span<const Path> paths, double radius, std::span<double> channels) override;

 private:
  const SumColumns* columns_;
  SmoothingKernel kernel_;
  std::vector<double> weights_;  // by path
  std::vector<double> totals_;   // by column
};

}  // namespace meshhood
