// SPDX-License-Identifier: MIT
#include "aggregate/patch.h"

#include <variant>

#include "base/frame.h"
#include "shared/distance.h"

namespace meshhood {

PatchCutter::PatchCutter(const IndexView& index, const NodeTree& tree, double radius)
    : index_(&index),
      tree_(&tree),
      bounds_(index.frame, radius),
      squared_radius_(squared_radius(radius)),
      ball_({0, 0, 0}, bounds_) {
  radii_.fill(radius);
}

void PatchCutter::begin(const PacketAnswer& packet) {
  whole_.clear();
  partial_.clear();
  leaves_.clear();
  words_.clear();
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

const PacketAnswer& PatchCutter::cut(const PacketAnswer& packet) {
  begin(packet);
  for (const CoreLeaves& core : packet.cores) {
    for (const LeafRun& run : core.runs) cut_run(run, core.queries);
  }
  for (const WholeLeaves& whole : packet.whole) cut_run(whole.run, whole.queries);
  for (const PartialLeaf& leaf : packet.partial) cut_leaf(leaf.leaf, leaf.queries.data());
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    partial_.push_back({leaves_[i], tree_->vertices(leaves_[i]), words_[i]});
  }
  rest_ = packet;
  rest_.radii = std::span(radii_).first(packet.radii.size());
  rest_.cores = {};
  rest_.whole = whole_;
  rest_.partial = partial_;
  return rest_;
}

void PatchCutter::cut_run(const LeafRun& run, QueryWord queries) {
  tree_->for_each_node(run, [&](NodeTree::Node node) { cut_node(node, queries); });
}

void PatchCutter::cut_node(NodeTree::Node node, QueryWord queries) {
  const Containment containment = classify(tree_->sphere(node), ball_);
  if (containment == Containment::Outside) return;
  if (containment == Containment::Inside) {
    whole_.push_back({tree_->run(node), queries});
  } else if (tree_->is_leaf(node)) {
    PerLane<QueryWord> words;
    words.fill(queries);
    cut_leaf(node, words.data());
  } else {
    const auto [begin, end] = tree_->children(node);
    for (NodeTree::Node child = begin; child < end; ++child) cut_node(child, queries);
  }
}

void PatchCutter::cut_leaf(NodeTree::Node leaf, const QueryWord* queries) {
  const VertexRange vertices = tree_->vertices(leaf);
  PerLane<QueryWord> words{};
  QueryWord any = 0;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    words[k] = inside(vertices.begin + k, queries[k]);
    any |= words[k];
  }
  if (any == 0) return;
  leaves_.push_back(leaf);
  words_.push_back(words);
}

/// The queries whose ball holds a vertex: the predicate.
QueryWord PatchCutter::inside(std::size_t vertex, QueryWord queries) const {
  const Point p = std::visit([&](auto xyz) { return point(xyz, vertex); }, index_->positions);
  QueryWord result = 0;
  for_each_query(queries, [&](std::size_t row) {
    const bool is_inside = squared_distance(p, centers_[row]) <= squared_radius_;
    result |= QueryWord{is_inside} << row;
  });
  return result;
}

}  // namespace meshhood
