// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meshhood/joint.h"

#include "aggregate/node_tree.h"
#include "aggregate/packet_reducer.h"
#include "simd/joint.h"

namespace meshhood {

/// Cuts the neighborhoods of a packet into the largest nodes of the tree whose vertices a row has, and the leaves of
/// which it has some. So the parts of a row, and their order, depend on its neighborhood alone: not on the other rows
/// of the packet, nor on how the search found it. One object a thread.
class MaximalNodes {
 public:
  explicit MaximalNodes(const NodeTree& tree) : tree_(&tree), family_of_(tree.families(), kNone) {}

  /// Passes the neighborhoods of a packet to a reducer, level by level, each in index order.
  void reduce(const PacketAnswer& packet, PacketReducer& reducer);

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// The nodes of one parent, of which some row has vertices.
  struct Family {
    std::array<QueryWord, kFanOut> queries{};         // by node: the rows that have all of its vertices
    std::array<const PartialLeaf*, kFanOut> parts{};  // of leaves, by node: null if no row has a part of it
  };

  Family& family_with(NodeTree::Node node, std::vector<std::uint32_t>& numbers);
  void add_run(const LeafRun& run, QueryWord queries);
  void pass_on(std::uint32_t number, PacketReducer& reducer);
  void pass_on_part(const PartialLeaf& leaf, QueryWord& whole, PacketReducer& reducer);

  const NodeTree* tree_;
  std::vector<std::uint32_t> family_of_;  // by number: its place in `families_`, or kNone
  std::vector<Family> families_;
  std::vector<std::uint32_t> numbers_;  // of those that the packet names
  std::vector<std::uint32_t> parents_;  // of those that follow from their children, ascending
};

}  // namespace meshhood
