// SPDX-License-Identifier: MIT
#include "aggregate/node_tree.h"

#include <algorithm>

#include "base/vector.h"

namespace meshhood {

NodeTree::NodeTree(const IndexView& index) : index_(&index), level_begin_{0} {
  for (const TreeLevel& level : index.tree) level_begin_.push_back(level_begin_.back() + level.nodes);
  if (index.tree.empty()) level_begin_.push_back(0);
}

std::size_t NodeTree::level_of(Node node) const {
  const auto after = std::upper_bound(level_begin_.begin(), level_begin_.end(), std::size_t{node});
  return static_cast<std::size_t>(after - level_begin_.begin()) - 1;
}

NodeTree::Children NodeTree::children(Node node) const {
  const std::size_t level = level_of(node);
  const std::size_t below = level_begin_[level - 1];
  const std::size_t first = below + kFanOut * (node - level_begin_[level]);
  return {static_cast<Node>(first), static_cast<Node>(std::min(first + kFanOut, level_begin_[level]))};
}

VertexRange NodeTree::vertices(Node node) const {
  const std::size_t level = level_of(node);
  std::size_t begin = node - level_begin_[level];
  std::size_t end = begin + 1;
  for (std::size_t i = 0; i < level; ++i) {
    begin *= kFanOut;
    end *= kFanOut;
  }
  return {index_->leaf_begin[begin], index_->leaf_begin[std::min(end, leaf_count())]};
}

FrameSphere NodeTree::sphere(Node node) const {
  const std::size_t level = level_of(node);
  const std::size_t i = node - level_begin_[level];
  const Group& group = index_->tree[level].groups[i / kFanOut];
  const std::size_t place = i % kFanOut;
  return {group.x[place], group.y[place], group.z[place], group.radius[place]};
}

Point NodeTree::centre(Node node) const {
  const FrameSphere bounds = sphere(node);
  const Point in_frame = centre_of(Sphere<float>{bounds.x, bounds.y, bounds.z, 0});
  return index_->frame.origin + (1 / index_->frame.scale) * in_frame;
}

}  // namespace meshhood
