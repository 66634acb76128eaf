// SPDX-License-Identifier: MIT
#include "aggregate/patch.h"

#include <variant>

#include "base/distance.h"
#include "base/frame.h"

namespace meshhood {

void reduce_packet(const NodeTree& tree, const PacketAnswer& packet, PacketReducer& reducer) {
  reducer.begin(packet);
  const auto add = [&](const LeafRun& run, QueryWord queries) {
    tree.for_each_node(run, [&](NodeTree::Node node) { reducer.add_node(node, queries); });
  };
  for (const CoreLeaves& core : packet.cores) {
    for (const LeafRun& run : core.runs) add(run, core.queries);
  }
  for (const WholeLeaves& whole : packet.whole) add(whole.run, whole.queries);
  for (const PartialLeaf& leaf : packet.partial) reducer.add_leaf(leaf.vertices, leaf.queries.data());
}

PatchCutter::PatchCutter(const IndexView& index, const NodeTree& tree, double radius)
    : index_(&index),
      tree_(&tree),
      bounds_(index.frame, radius),
      squared_radius_(squared_radius(radius)),
      ball_({0, 0, 0}, bounds_) {}

void PatchCutter::begin(const PacketAnswer& packet) {
  const std::uint32_t first = index_->slot[packet.vertices.front()];
  const FrameSphere& leaf = index_->leaves[leaf_of(first)].bounds;
  const auto radius = static_cast<double>(leaf.radius);
  TreeBounds bounds = bounds_;
  bounds.outer = next_above(static_cast<double>(bounds.outer) + radius);
  bounds.inner = -next_above(radius - static_cast<double>(bounds.inner));
  ball_ = TreeBall({leaf.x, leaf.y, leaf.z}, bounds);
  for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
    const std::uint32_t slot = index_->slot[packet.vertices[row]];
    centers_[row] = index_->position(leaf_of(slot), lane_of(slot));
  }
}

void PatchCutter::reduce(const PacketAnswer& packet, PacketReducer& reducer) {
  begin(packet);
  reducer.begin(packet);
  const auto cut = [&](const LeafRun& run, QueryWord queries) {
    tree_->for_each_node(run, [&](NodeTree::Node node) { cut_node(node, queries, reducer); });
  };
  for (const CoreLeaves& core : packet.cores) {
    for (const LeafRun& run : core.runs) cut(run, core.queries);
  }
  for (const WholeLeaves& whole : packet.whole) cut(whole.run, whole.queries);
  for (const PartialLeaf& leaf : packet.partial) cut_leaf(leaf.vertices, leaf.queries.data(), reducer);
}

void PatchCutter::cut_node(NodeTree::Node node, QueryWord queries, PacketReducer& reducer) {
  const Containment containment = classify(tree_->sphere(node), ball_);
  if (containment == Containment::Outside) return;
  if (containment == Containment::Inside) return reducer.add_node(node, queries);
  if (tree_->is_leaf(node)) {
    PerLane<QueryWord> words;
    words.fill(queries);
    return cut_leaf(tree_->vertices(node), words.data(), reducer);
  }
  const auto [begin, end] = tree_->children(node);
  for (NodeTree::Node child = begin; child < end; ++child) cut_node(child, queries, reducer);
}

void PatchCutter::cut_leaf(const VertexRange& vertices, const QueryWord* queries, PacketReducer& reducer) {
  PerLane<QueryWord> words;
  QueryWord any = 0;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    words[k] = inside(vertices.begin + k, queries[k]);
    any |= words[k];
  }
  if (any != 0) reducer.add_leaf(vertices, words.data());
}

/// The queries whose ball holds a vertex: the predicate.
QueryWord PatchCutter::inside(std::size_t vertex, QueryWord queries) const {
  const Point p = std::visit([&](auto xyz) { return point(xyz, vertex); }, index_->positions);
  QueryWord result = 0;
  for_each_query(queries, [&](std::size_t row) {
    const bool is_inside = squared_distance(p, centers_[row]) <= squared_radius_;  // mutant: patch-without-boundary
    result |= QueryWord{is_inside} << row;
  });
  return result;
}

}  // namespace meshhood
