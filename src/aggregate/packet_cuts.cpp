// SPDX-License-Identifier: MIT
#include "aggregate/packet_cuts.h"

#include <algorithm>

#include "base/frame.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

void MaximalNodes::reduce(const PacketAnswer& packet, PacketReducer& reducer) {
  reducer.begin(packet);
  if (!reducer.takes_nodes()) return pass_on_leaves(packet, reducer);
  rows_.clear();
  named_.clear();
  parents_.clear();
  for (const Piece& piece : packet.pieces) {
    if (piece.is_run()) {
      add_run(piece.leaves, piece.queries);
    } else {
      group_with(piece.leaves.begin, named_).parts[piece.leaves.begin % kFanOut] = piece.reached;
    }
  }
  std::sort(named_.begin(), named_.end());
  // The groups of children have smaller numbers than those of their parents, and the same order.
  for (std::size_t i = 0, j = 0; i < named_.size() || j < parents_.size();) {
    const bool is_parent = i == named_.size() || (j < parents_.size() && parents_[j] < named_[i]);
    const std::uint32_t group = is_parent ? parents_[j++] : named_[i++];
    pass_on(group, reducer);
  }
  for (const std::uint32_t group : named_) place_of_[group] = kNone;
  for (const std::uint32_t group : parents_) place_of_[group] = kNone;
}

void MaximalNodes::pass_on_leaves(const PacketAnswer& packet, PacketReducer& reducer) const {
  PerLane<QueryWord> words;
  for (const Piece& piece : packet.pieces) {
    words.fill(piece.queries);
    for (NodeTree::Node leaf = piece.leaves.begin; leaf < piece.leaves.end; ++leaf) {
      reducer.add_leaf(tree_->vertices(leaf), piece.is_run() ? words.data() : piece.reached);
    }
  }
}

/// Returns the rows of the group of a node. A new one is noted in `groups`.
MaximalNodes::GroupRows& MaximalNodes::group_with(NodeTree::Node node, std::vector<std::uint32_t>& groups) {
  const std::uint32_t group = NodeTree::group(node);
  if (place_of_[group] == kNone) {
    place_of_[group] = static_cast<std::uint32_t>(rows_.size());
    rows_.emplace_back();
    groups.push_back(group);
  }
  return rows_[place_of_[group]];
}

void MaximalNodes::add_run(const LeafRun& run, QueryWord queries) {
  tree_->for_each_node(run, [&](NodeTree::Node node) { group_with(node, named_).queries[node % kFanOut] |= queries; });
}

/// Passes on the parts of leaves and the nodes of a group, without the rows that have the parent: it gets these.
void MaximalNodes::pass_on(std::uint32_t group, PacketReducer& reducer) {
  GroupRows rows = rows_[place_of_[group]];
  const NodeTree::Children nodes = tree_->members(group);
  QueryWord of_all = ~QueryWord{0};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (rows.parts[k] != nullptr)
      pass_on_part(tree_->vertices(nodes.begin + static_cast<NodeTree::Node>(k)), rows.parts[k], rows.queries[k],
                   reducer);
    of_all &= rows.queries[k];
  }
  const NodeTree::Node parent = tree_->parent(group);
  if (parent == kNoNode) of_all = 0;
  if (of_all != 0) group_with(parent, parents_).queries[parent % kFanOut] |= of_all;
  QueryWord any = 0;
  for (QueryWord& word : rows.queries) {
    word &= ~of_all;
    any |= word;
  }
  if (any != 0) reducer.add_nodes(nodes, rows.queries.data());
}

/// Passes on the vertices of a leaf, without the rows that have all of them: these are added to `whole`.
void MaximalNodes::pass_on_part(const VertexRange& vertices, const QueryWord* reached, QueryWord& whole,
                                PacketReducer& reducer) {
  QueryWord of_all = ~QueryWord{0};
  for (std::size_t k = 0; k < vertices.size(); ++k) of_all &= reached[k];
  whole |= of_all;
  PerLane<QueryWord> words;
  QueryWord any = 0;
  for (std::size_t k = 0; k < words.size(); ++k) {
    words[k] = reached[k] & ~of_all;
    any |= words[k];
  }
  if (any != 0) reducer.add_leaf(vertices, words.data());
}

PatchCutter::PatchCutter(const IndexView& index, const NodeTree& tree, double radius)
    : index_(&index),
      tree_(&tree),
      bounds_(index.frame, radius),
      squared_radius_(squared_radius(radius)),
      kernels_(&path_kernels(best_isa())),
      ball_({0, 0, 0}, bounds_) {
  radii_.fill(radius);
}

void PatchCutter::begin(const PacketAnswer& packet) {
  const std::uint32_t first = index_->slot[packet.vertices.front()];
  const FrameSphere& leaf = index_->leaves[leaf_of(first)].bounds;
  const auto radius = static_cast<double>(leaf.radius);
  TreeBounds bounds = bounds_;
  bounds.outer = next_above(static_cast<double>(bounds.outer) + radius);
  bounds.inner = -next_above(radius - static_cast<double>(bounds.inner));
  ball_ = TreeBall({leaf.x, leaf.y, leaf.z}, bounds);
  for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
    centers_[row] = index_->position_of(packet.vertices[row]);
  }
}

const PacketAnswer& PatchCutter::cut(const PacketAnswer& packet) {
  pieces_.clear();
  words_.clear();
  if (packet.lengths == nullptr) begin(packet);
  for (const Piece& piece : packet.pieces) {
    if (packet.lengths != nullptr) {
      cut_by_length(piece, *packet.lengths);
    } else if (piece.is_run()) {
      cut_run(piece.leaves, piece.queries);
    } else {
      cut_leaf(piece.leaves.begin, piece.reached);
    }
  }
  const PerLane<QueryWord>* words = words_.data();
  for (Piece& piece : pieces_) {
    if (piece.queries == 0) piece.reached = (words++)->data();
  }
  rest_ = packet;
  rest_.radii = std::span(radii_).first(packet.radii.size());
  rest_.pieces = pieces_;
  return rest_;
}

/// A piece of a packet with lengths always has words.
void PatchCutter::cut_by_length(const Piece& piece, PacketLengths& lengths) {
  PerLane<QueryWord> words{};
  lengths.select(piece.leaves.begin);
  for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
    if (piece.reached[lane] == 0) continue;
    words[lane] = piece.reached[lane] & kernels_->within_limits(lengths.at(lane), radii_);
  }
  add_leaf(piece.leaves.begin, words);
}

/// Adds a leaf unless no query has a vertex of it.
void PatchCutter::add_leaf(LeafId leaf, const PerLane<QueryWord>& words) {
  if (std::ranges::all_of(words, [](QueryWord word) { return word == 0; })) return;
  pieces_.push_back({{leaf, leaf + 1}, 0, nullptr});
  words_.push_back(words);
}

void PatchCutter::cut_run(const LeafRun& run, QueryWord queries) {
  tree_->for_each_node(run, [&](NodeTree::Node node) { cut_node(node, queries); });
}

void PatchCutter::cut_node(NodeTree::Node node, QueryWord queries) {
  const Containment containment = classify(tree_->sphere(node), ball_);
  if (containment == Containment::Outside) return;
  if (containment == Containment::Inside) {
    pieces_.push_back({tree_->run(node), queries, nullptr});
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
  for (std::size_t k = 0; k < vertices.size(); ++k) words[k] = inside(vertices.begin + k, queries[k]);
  add_leaf(leaf, words);
}

/// Returns the queries whose ball holds a vertex, by the predicate.
QueryWord PatchCutter::inside(std::size_t vertex, QueryWord queries) const {
  const Point p = index_->position(vertex);
  QueryWord result = 0;
  for_each_query(queries, [&](std::size_t row) {
    const bool is_inside = squared_distance(p, centers_[row]) <= squared_radius_;
    result |= QueryWord{is_inside} << row;
  });
  return result;
}

}  // namespace meshhood::inline v0_1
