// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/descent.h"
#include "exact/search/group_states.h"
#include "exact/search/query.h"
#include "exact/search/waves.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// The outward search, from the query vertex over linked, connected nodes to the surface of the ball. What it reaches
/// is a union of whole components of the ball, and holds the component of the query vertex (see `Waves`): *whole*
/// nodes, which lie in the ball, and *surface leaves*, of which only some vertices do.
class Reach {
 public:
  Reach(const IndexView& index, const Kernels& kernels)
      : index_(&index),
        kernels_(&kernels),
        states_(index),
        waves_(index, kernels),
        descent_(index, kernels),
        first_surface_leaf_(index.leaf_count() / kFanOut) {}

  /// Returns false, and reaches nothing, if leaves are what the search would begin with.
  [[nodiscard]] bool run(const Query& query);

  /// The groups of known state: those of the level where the search began, then level by level downwards; those of a
  /// level ascend.
  [[nodiscard]] std::span<const std::uint32_t> groups() const { return descent_.groups(); }

  /// Those of the first level in the order in which the search met them, and those of the levels below.
  [[nodiscard]] std::span<const std::uint32_t> top_groups() const { return waves_.groups(); }
  [[nodiscard]] std::span<const std::uint32_t> lower_groups() const { return groups().subspan(top_groups().size()); }

  [[nodiscard]] GroupStates& states() { return states_; }
  [[nodiscard]] const GroupStates& states() const { return states_; }

  /// Ascending, with their vertices in the ball.
  [[nodiscard]] std::span<const LeafSubset> surface_leaves() const { return surface_leaves_; }

  /// The place of a leaf among the surface leaves, or `kNoPlace`.
  [[nodiscard]] std::size_t place_of(LeafId leaf) const;
  static constexpr std::size_t kNoPlace = ~std::size_t{0};

 private:
  friend struct ReachAccess;  // for tests, which begin on every level

  /// A node over the query vertex.
  struct Home {
    std::size_t level;
    NodeId node;
  };

  [[nodiscard]] Home home_of(const Query& query, double ratio) const;
  [[nodiscard]] bool reach_from(const Home& home, const Query& query, std::size_t limited_above);
  void find_surface_leaves(const Query& query);
  void settle(LeafId leaf, bool is_whole);

  const IndexView* index_;
  const Kernels* kernels_;
  GroupStates states_;
  Waves waves_;
  Descent descent_;
  std::vector<LeafSubset> surface_leaves_;
  std::vector<std::uint32_t> first_surface_leaf_;  // by group of leaves, if it has one
};

}  // namespace meshhood::inline v0_1
