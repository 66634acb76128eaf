// SPDX-License-Identifier: MIT
#include "exact/arrays.h"

#include <utility>

namespace meshhood {
namespace {

template <class T>
void borrow(std::span<const T>& span, const std::vector<T>& array) {
  span = array;
}

void borrow(PositionsInOrder& span, const PositionsData& array) {
  std::visit([&](const auto& xyz) { span = std::span(xyz); }, array);
}

}  // namespace

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

std::unique_ptr<const IndexView> make_view(IndexData data) {
  const auto owner = std::make_shared<const IndexData>(std::move(data));
  auto view = std::make_unique<IndexView>();
  view->frame = owner->frame;
  for_each_array([](ArrayInfo, auto& span, const auto& array) { borrow(span, array); }, *view, *owner);
  view->tree = make_levels(view->leaf_count(), view->groups, view->mean_radii);
  view->owner = owner;
  return view;
}

}  // namespace meshhood
