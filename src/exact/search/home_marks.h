// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/leaf_bits.h"
#include "exact/search/query.h"
#include "exact/search/reach.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Marks what is known to be connected with the query vertex within the ball: whole nodes, in `GroupState::home`, and
/// vertices of surface leaves. The marks spread over the links in a few passes. They are never wrong, but may be
/// incomplete: what has no mark then is *open*.
class HomeMarks {
 public:
  HomeMarks(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels), leaves_(index) {}

  void spread(const Query& query, Reach& reach);

  /// Marks some whole nodes of a group, or lanes of a surface leaf, that `spread` has left open.
  void add_nodes(std::uint32_t group, NodeSet nodes) { (*states_)[group].marked |= nodes; }
  void add_lanes(std::size_t place, LaneMask lanes) { lanes_[place] |= lanes; }

  /// The marked lanes of a surface leaf, by its place. `lanes(surface_leaves().size())` may be read, too.
  [[nodiscard]] LaneMask lanes(std::size_t place) const { return lanes_[place]; }

  /// Whether a whole node that `spread` has marked is, or covers, the leaf: 1 or 0.
  [[nodiscard]] unsigned has(LeafId leaf) const { return leaves_.has(leaf); }

  /// The groups with open nodes, in the order of `Reach::groups`; the places of surface leaves with open lanes,
  /// ascending.
  [[nodiscard]] std::span<const std::uint32_t> open_groups() const { return open_groups_; }
  [[nodiscard]] std::span<const std::size_t> open_places() const { return open_places_; }

 private:
  void begin(const Query& query, const Reach& reach);
  void mark_nodes(std::uint32_t group);
  [[nodiscard]] unsigned covers(NodeId node) const;
  void keep_open(std::span<const std::uint32_t> groups);
  void mark_leaf(const Query& query, const LeafSubset& leaf, std::size_t place);

  const IndexView* index_;
  const Kernels* kernels_;
  GroupStates* states_ = nullptr;
  LeafBits leaves_;              // below marked nodes
  std::vector<LaneMask> lanes_;  // by place of a surface leaf, and one more
  std::vector<std::uint32_t> open_groups_;
  std::vector<std::size_t> open_places_;
};

}  // namespace meshhood::inline v0_1
