// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "aggregate/node_tree.h"
#include "simd/joint.h"

namespace meshhood {

/// Collects nodes, so that a kernel adds many at once.
class PendingNodes {
 public:
  /// Returns whether there is no room for another.
  bool add(NodeTree::Node node, QueryWord queries) {
    nodes_[size_] = node;
    words_[size_] = queries;
    return ++size_ == nodes_.size();
  }

  void clear() { size_ = 0; }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const QueryWord* words() const { return words_.data(); }

  /// The values of the nodes in a table by node. Valid until the next call.
  [[nodiscard]] std::span<const double> values(std::span<const double> by_node) {
    for (std::size_t i = 0; i < size_; ++i) values_[i] = by_node[nodes_[i]];
    return std::span(values_).first(size_);
  }

 private:
  std::size_t size_ = 0;
  PerLane<NodeTree::Node> nodes_{};
  PerLane<QueryWord> words_{};
  PerLane<double> values_{};
};

}  // namespace meshhood
