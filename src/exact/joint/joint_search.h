// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "exact/joint/group.h"
#include "exact/joint/packet.h"
#include "exact/joint/spread.h"
#include "exact/layout.h"
#include "simd/joint.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Answers up to 32 queries of one leaf at once: the exact neighborhoods, as `Searcher` finds them one by one. See
/// docs/joint.md. Owns the scratch memory: 4 bytes a leaf of the mesh, and 1 kB for each leaf that the balls of a group
/// may meet. One object a thread. What is found does not depend on earlier calls.
class JointSearch {
 public:
  JointSearch(const IndexView& index, Isa isa);

  /// Begins with a group: `leaves` belong to one node above the leaves, and the radii of its queries lie between `low`
  /// and `high`.
  void begin_group(std::span<const LeafId> leaves, const TreeBounds& low, const TreeBounds& high) {
    group_.begin(leaves, low, high);
  }

  /// Finds the neighborhoods of 1 to 32 vertices of `leaf`, which is one of the group.
  void run(LeafId leaf, std::span<const JointQuery> queries);

  // Of the queries of the last `run`:

  /// How many vertices their neighborhoods have.
  [[nodiscard]] const PerLane<std::uint64_t>& counts();

  /// Those whose vertex is not a wall.
  [[nodiscard]] QueryWord queries() const { return packet_->queries(); }

  /// The neighborhoods, in index order; adjacent runs of the same queries are one. Valid until the next `run`.
  [[nodiscard]] std::span<const Piece> pieces();

 private:
  void join_runs();

  const IndexView* index_;
  const JointKernels* kernels_;
  JointGroup group_;
  JointSpread spread_;
  std::optional<Packet> packet_;
  PerLane<std::uint64_t> counts_{};
  std::vector<Piece> pieces_;
};

}  // namespace meshhood::inline v0_1
