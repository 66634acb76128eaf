// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "meshhood/joint.h"

#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "simd/ball.h"

namespace meshhood {

/// Passes the neighborhoods of a packet to a reducer.
void reduce_packet(const NodeTree& tree, const PacketAnswer& packet, PacketReducer& reducer);

/// Cuts the neighborhoods of a packet by smaller balls around their vertices: `Nesting::Patch`.
class PatchCutter {
 public:
  PatchCutter(const IndexView& index, const NodeTree& tree, double radius);

  /// Passes what is left to a reducer. The radii of the packet are at least that of the cutter.
  void reduce(const PacketAnswer& packet, PacketReducer& reducer);

 private:
  void begin(const PacketAnswer& packet);
  void cut_node(NodeTree::Node node, QueryWord queries, PacketReducer& reducer);
  void cut_leaf(const VertexRange& vertices, const QueryWord* queries, PacketReducer& reducer);
  [[nodiscard]] QueryWord inside(std::size_t vertex, QueryWord queries) const;

  const IndexView* index_;
  const NodeTree* tree_;
  TreeBounds bounds_;
  double squared_radius_;
  TreeBall ball_;  // around the leaf of the packet: `outer` around all balls, `inner` within each
  std::array<Point, kPacketCapacity> centers_{};
};

}  // namespace meshhood
