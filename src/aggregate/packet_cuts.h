// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aggregate/node_tree.h"
#include "aggregate/reducers.h"
#include "exact/joint/packet_answer.h"
#include "simd/ball.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Cuts the neighborhoods of a packet into the largest nodes of the tree whose vertices a row has, and the leaves of
/// which it has some. So the parts of a row, and their order, depend on its neighborhood alone: not on the other rows
/// of the packet, nor on how the search found it. Each thread needs its own.
class MaximalNodes {
 public:
  explicit MaximalNodes(const NodeTree& tree) : tree_(&tree), place_of_(tree.group_count(), kNone) {}

  /// Passes the neighborhoods of a packet to a reducer, level by level, each in index order. A reducer that takes no
  /// nodes gets leaves alone.
  void reduce(const PacketAnswer& packet, PacketReducer& reducer);

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// The rows that have vertices of a group of nodes.
  struct GroupRows {
    std::array<QueryWord, kFanOut> queries{};       // by node: the rows that have all of its vertices
    std::array<const QueryWord*, kFanOut> parts{};  // by node, of leaves with words: these; else null
  };

  GroupRows& group_with(NodeTree::Node node, std::vector<std::uint32_t>& groups);
  void pass_on_leaves(const PacketAnswer& packet, PacketReducer& reducer) const;
  void add_run(const LeafRun& run, QueryWord queries);
  void pass_on(std::uint32_t group, PacketReducer& reducer);
  void pass_on_part(const VertexRange& vertices, const QueryWord* reached, QueryWord& whole, PacketReducer& reducer);

  const NodeTree* tree_;
  std::vector<std::uint32_t> place_of_;  // by group: its place in `rows_`, or kNone
  std::vector<GroupRows> rows_;
  std::vector<std::uint32_t> named_;    // the groups whose nodes the packet names
  std::vector<std::uint32_t> parents_;  // those of which a node follows from its children; ascending
};

/// Cuts the neighborhoods of a packet by a smaller radius: by balls around their vertices (`Nesting::Patch`), or by the
/// lengths of the packet, which leaves the neighborhoods of that radius.
class PatchCutter {
 public:
  PatchCutter(const IndexView& index, const NodeTree& tree, double radius);

  /// Returns what is left, valid until the next call. The radii of `packet` are at least that of the cutter.
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
