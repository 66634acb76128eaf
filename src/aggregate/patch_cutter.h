// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aggregate/node_tree.h"
#include "exact/joint/packet_answer.h"
#include "simd/ball.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Cuts the neighborhoods of a packet by a smaller radius: by balls around their vertices (`Nesting::Patch`), or by the
/// lengths of the packet, which leaves the neighborhoods of that radius.
class PatchCutter {
 public:
  PatchCutter(const IndexView& index, const NodeTree& tree, double radius);

  /// Returns what is left. The radii of `packet` are at least that of the cutter. Valid
  /// until the next call.
  const PacketAnswer& cut(const PacketAnswer& packet);

 private:
  void begin(const PacketAnswer& packet);
  void cut_by_length(const Piece& piece, PacketLengths& lengths);
  void add_leaf(LeafId leaf, const PerLane<QueryWord>& words);
  void cut_run(const LeafRun& run, QueryWord queries);
  void cut_node(NodeTree::Node node, QueryWord queries);
  void cut_leaf(NodeTree::Node leaf, const QueryWord* queries);
  [[nodiscard]] QueryWord inside(std::size_t vertex, QueryWord queries) const;

  const IndexView* index_;
  const NodeTree* tree_;
  TreeBounds bounds_;
  double squared_radius_;
  const PathKernels* kernels_;
  PerLane<double> radii_;  // the radius, for each row
  TreeBall ball_;          // around the leaf of the packet: `outer` around all balls, `inner` within each
  std::array<Point, kPacketCapacity> centers_{};
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> words_;  // of the leaves among them that are cut
  PacketAnswer rest_;
};

}  // namespace meshhood::inline v0_1
