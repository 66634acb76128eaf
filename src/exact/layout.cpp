// SPDX-License-Identifier: MIT
#include "exact/layout.h"

#include <cstddef>
#include <span>
#include <vector>

namespace meshhood {

std::vector<std::size_t> tree_nodes(std::size_t leaves) {
  std::vector<std::size_t> result;
  if (leaves == 0) return result;
  result.push_back(leaves);
  while (result.back() > kFanOut) result.push_back(group_count(result.back()));
  return result;
}

std::size_t tree_groups(std::size_t leaves) {
  std::size_t groups = 0;
  for (const std::size_t nodes : tree_nodes(leaves)) groups += group_count(nodes);
  return groups;
}

Tree make_levels(std::size_t leaves, std::span<const Group> groups, std::span<const double> mean_radii) {
  Tree tree;
  for (const std::size_t nodes : tree_nodes(leaves)) {
    const std::size_t count = group_count(nodes);
    tree.push_back({groups.first(count), nodes, mean_radii[tree.size()]});
    groups = groups.subspan(count);
  }
  return tree;
}

}  // namespace meshhood
