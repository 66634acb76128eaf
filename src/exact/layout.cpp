// SPDX-License-Identifier: MIT
#include "exact/layout.h"

#include <algorithm>

namespace meshhood::inline v0_1 {
namespace {

/// From the groups below to those above. Ranges that records not verified yet would place outside are empty.
std::vector<LeafGroupRange> make_leaf_groups(std::span<const std::uint32_t> levels,
                                             std::span<const GroupRecord> records) {
  if (levels.size() < 2) return {};
  const std::size_t leaf_end = levels[1];
  std::vector<LeafGroupRange> result((records.size() - std::min(leaf_end, records.size())) * kFanOut);
  const auto below = [&](std::size_t group) -> LeafGroupRange {
    if (group < leaf_end) return {static_cast<std::uint32_t>(group), static_cast<std::uint32_t>(group + 1)};
    const std::size_t first = (group - leaf_end) * kFanOut;
    const std::size_t last = first + std::clamp<std::size_t>(records[group].nodes, 1, kFanOut) - 1;
    return {result[first].begin, result[last].end};
  };
  for (std::size_t group = leaf_end; group < records.size(); ++group) {
    for (std::size_t i = 0; i < std::min<std::size_t>(records[group].nodes, kFanOut); ++i) {
      const std::size_t child = std::size_t{records[group].first_child} + i;
      if (child < group) result[(group - leaf_end) * kFanOut + i] = below(child);
    }
  }
  return result;
}

}  // namespace

Tree make_levels(std::span<const std::uint32_t> levels, std::span<const GroupRecord> records,
                 std::span<const double> mean_radii) {
  Tree tree;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    TreeLevel next{levels[level], levels[level + 1] - levels[level], 0, mean_radii[level]};
    for (const GroupRecord& record : records.subspan(next.first_group, next.groups)) next.nodes += record.nodes;
    tree.push_back(next);
  }
  return tree;
}

void derive(IndexView& index) {
  index.tree = make_levels(index.levels, index.records, index.mean_radii);
  index.roots = make_root_tree(index.groups, index.records, index.parents);
  index.leaf_groups = make_leaf_groups(index.levels, index.records);
}

}  // namespace meshhood::inline v0_1
