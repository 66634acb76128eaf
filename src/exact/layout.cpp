// SPDX-License-Identifier: MIT
#include "exact/layout.h"

namespace meshhood {

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
}

}  // namespace meshhood
