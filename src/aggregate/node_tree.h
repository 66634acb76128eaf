// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/joint.h"
#include "meshhood/searcher.h"

#include "exact/layout.h"

namespace meshhood {

/// The nodes of the tree of an index under one numbering: leaves first, then level by level. Everything that an
/// aggregate keeps by node has this order.
class NodeTree {
 public:
  using Node = std::uint32_t;

  explicit NodeTree(const IndexView& index);

  /// The number of nodes on all levels.
  [[nodiscard]] std::size_t size() const { return level_begin_.back(); }
  [[nodiscard]] std::size_t leaf_count() const { return level_begin_[1]; }
  [[nodiscard]] bool is_leaf(Node node) const { return node < leaf_count(); }

  /// The children of a node that is not a leaf: consecutive nodes.
  struct Children {
    Node begin;
    Node end;
  };
  [[nodiscard]] Children children(Node node) const;

  /// The vertices of a node, in index order.
  [[nodiscard]] VertexRange vertices(Node node) const;

  /// The bounding sphere, in the frame.
  [[nodiscard]] FrameSphere sphere(Node node) const;

  /// The centre of that sphere in the unit of the positions: the same double wherever it is used.
  [[nodiscard]] Point centre(Node node) const;

  /// Calls `f(node)` for few nodes whose vertices together are those of the run, in an order that the run determines.
  template <class F>
  void for_each_node(const LeafRun& run, F&& f) const {
    std::size_t begin = run.first_leaf;
    std::size_t end = run.end_leaf;
    for (std::size_t level = 0; begin < end; ++level) {
      const std::size_t first = level_begin_[level];
      const bool is_top = level + 2 == level_begin_.size();
      while (begin < end && (is_top || begin % kFanOut != 0)) f(static_cast<Node>(first + begin++));
      while (begin < end && end % kFanOut != 0) f(static_cast<Node>(first + --end));
      begin /= kFanOut;
      end /= kFanOut;
    }
  }

 private:
  [[nodiscard]] std::size_t level_of(Node node) const;

  const IndexView* index_;
  std::vector<std::size_t> level_begin_;  // by level, and the number of all nodes
};

}  // namespace meshhood
