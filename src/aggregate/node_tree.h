// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Numbers the nodes of the tree of an index. Everything that an aggregate keeps by node has this order, with places
/// for nodes that do not exist, which have no vertices and no children.
class NodeTree {
 public:
  using Node = std::uint32_t;

  explicit NodeTree(const IndexView& index) : index_(&index) {}

  /// Returns the number of places for nodes on all levels.
  [[nodiscard]] std::size_t size() const { return index_->records.size() * kFanOut; }
  [[nodiscard]] std::size_t leaf_count() const { return index_->leaf_count(); }
  [[nodiscard]] bool is_leaf(Node node) const { return node < leaf_count(); }

  /// The children of a node that is not a leaf are consecutive nodes.
  struct Children {
    Node begin;
    Node end;

    [[nodiscard]] std::size_t size() const { return end - begin; }
  };
  [[nodiscard]] Children children(Node node) const;

  /// A group holds the nodes of one parent, or neighbors without a parent.
  [[nodiscard]] std::size_t group_count() const { return index_->records.size(); }
  [[nodiscard]] static std::uint32_t group(Node node) { return node / kFanOut; }
  [[nodiscard]] Children members(std::uint32_t group) const {
    return {group * kFanOut, group * kFanOut + index_->records[group].nodes};
  }
  /// Returns the parent of the nodes of a group, or `kNoNode`.
  [[nodiscard]] Node parent(std::uint32_t group) const { return index_->parents[group]; }

  /// Returns the vertices of a node, in index order.
  [[nodiscard]] VertexRange vertices(Node node) const;

  /// Returns the leaves of a node.
  [[nodiscard]] LeafRun run(Node node) const;

  /// Returns the bounding sphere, in the frame.
  [[nodiscard]] FrameSphere sphere(Node node) const;

  /// Returns the center of that sphere in the unit of the positions: the same double wherever it is used.
  [[nodiscard]] Point center(Node node) const;

  /// Calls `f(node)` for few nodes whose vertices together are those of the run, in an order that the run determines.
  template <class F>
  void for_each_node(const LeafRun& run, F&& f) const {
    for (std::size_t leaf = run.begin; leaf < run.end;) {
      const Node node = largest_from(leaf, run.end);
      f(node);
      leaf = end_leaf(node);
      while (leaf < run.end && index_->leaves[leaf].size == 0) ++leaf;
    }
  }

 private:
  /// Returns the largest node that begins with `leaf` and ends before the leaf `end`.
  [[nodiscard]] Node largest_from(std::size_t leaf, std::size_t end) const;
  /// Returns the place after the last leaf of a node.
  [[nodiscard]] std::size_t end_leaf(Node node) const;

  const IndexView* index_;
};

/// Applies `reduce` to the values of the vertices of each leaf, and to the results of the children of each other node.
template <class F>
[[nodiscard]] std::vector<double> reduced_by_node(const NodeTree& tree, std::span<const double> values, F&& reduce) {
  std::vector<double> result(tree.size());
  for (NodeTree::Node node = 0; node < tree.size(); ++node) {
    if (tree.is_leaf(node)) {
      const VertexRange vertices = tree.vertices(node);
      result[node] = reduce(values.subspan(vertices.begin, vertices.size()));
    } else {
      const auto [begin, end] = tree.children(node);
      result[node] = reduce(std::span(result).subspan(begin, end - begin));
    }
  }
  return result;
}

}  // namespace meshhood::inline v0_1
