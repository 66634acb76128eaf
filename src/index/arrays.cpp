// SPDX-License-Identifier: MIT
#include "index/arrays.h"

#include <utility>

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

std::unique_ptr<const IndexStorage> make_storage(IndexArrays arrays) {
  const auto owner = std::make_shared<const IndexArrays>(std::move(arrays));
  auto storage = std::make_unique<IndexStorage>();
  storage->frame = owner->frame;
  std::visit([&](const auto& xyz) { storage->positions = std::span(xyz); }, owner->positions);
  storage->permutation = owner->permutation;
  storage->place = owner->place;
  storage->leaf_begin = owner->leaf_begin;
  storage->leaves = owner->leaves;
  storage->links = owner->links;
  storage->crossings = owner->crossings;
  storage->adjacency = owner->adjacency;
  storage->groups = owner->groups;
  storage->mean_radii = owner->mean_radii;
  storage->tree = make_levels(storage->leaf_count(), storage->groups, storage->mean_radii);
  storage->owner = owner;
  return storage;
}

}  // namespace meshhood
