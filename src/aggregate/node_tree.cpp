// SPDX-License-Identifier: MIT
#include "aggregate/node_tree.h"

#include <cassert>

#include "exact/node_search.h"
#include "exact/vertex_set.h"

namespace meshhood::inline v0_1 {

NodeTree::Children NodeTree::children(Node node) const {
  assert(!is_leaf(node));
  const GroupRecord& record = index_->records[node / kFanOut];
  if (node % kFanOut >= record.nodes) return {0, 0};
  const Node first = (record.first_child + node % kFanOut) * kFanOut;
  return {first, static_cast<Node>(first + index_->records[first / kFanOut].nodes)};
}

VertexRange NodeTree::vertices(Node node) const { return run_of(*index_, node); }

LeafRun NodeTree::run(Node node) const {
  Node first = node;
  while (!is_leaf(first)) first = children(first).begin;
  return {first, static_cast<std::uint32_t>(end_leaf(node))};
}

FrameSphere NodeTree::sphere(Node node) const { return sphere_of(*index_, node); }

NodeTree::Node NodeTree::largest_from(std::size_t leaf, std::size_t end) const {
  auto node = static_cast<Node>(leaf);
  for (;;) {
    const NodeId parent = index_->parents[node / kFanOut];
    const bool is_first = node % kFanOut == 0;
    if (!is_first || parent == kNoNode || end_leaf(parent) > end) return node;
    node = parent;
  }
}

std::size_t NodeTree::end_leaf(Node node) const {
  while (!is_leaf(node)) node = children(node).end - 1;
  return std::size_t{node} + 1;
}

Point NodeTree::center(Node node) const { return index_->frame.from_frame(center_of(sphere(node))); }

}  // namespace meshhood::inline v0_1
