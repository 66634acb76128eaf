// SPDX-License-Identifier: MIT
#include "exact/build/dissolve_parts.h"

#include <vector>

namespace meshhood {
namespace {

/// Moves nodes of `part` to other parts until none can move. Returns whether all have moved.
bool move_all(std::uint32_t part, double limit, NodeParts& parts) {
  std::vector<std::uint32_t> left;
  do {
    left.assign(parts[part].begin(), parts[part].end());
    for (const std::uint32_t node : left) {
      const std::uint32_t other = parts.best_part_for(std::span(&node, 1), limit);
      if (other != NodeParts::kNoPart) parts.move(node, other);
    }
    // A node that has moved may link one that is left with another part.
  } while (!parts[part].empty() && parts[part].size() < left.size());  // mutant: nodes-move-once
  return parts[part].empty();
}

}  // namespace

void dissolve_small_parts(NodeParts& parts) {
  // Chosen. Seven nodes hardly ever all find room; wider parts would slow down queries.
  constexpr std::size_t kMostNodes = 6;
  constexpr double kStretch = 1.5;  // the largest radius of a part that a node moves to, divided by that of a full one
  const double limit = kStretch * parts.mean_full_radius();
  std::vector<std::uint32_t> nodes;
  for (std::size_t size = 1; size <= kMostNodes; ++size) {
    for (std::uint32_t part = 0; part < parts.size(); ++part) {
      if (parts[part].size() != size) continue;
      nodes.assign(parts[part].begin(), parts[part].end());
      if (move_all(part, limit, parts)) continue;
      for (const std::uint32_t node : nodes) parts.move(node, part);  // mutant: part-half-dissolved
    }
  }
}

}  // namespace meshhood
