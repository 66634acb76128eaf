// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/prefetch.h"
#include "exact/layout.h"

namespace meshhood {

/// The part of the graph that a search along the edges has met, with the length of each edge. The vertices of a leaf
/// get rows of edges together, when the search first needs one of them. So a row is found without a search among the
/// links of its leaf, and lies near those of its neighbors in memory.
///
/// A *local slot* is a slot in which the leaf is numbered by the order in which the search met it.
class LocalGraph {
 public:
  explicit LocalGraph(const IndexView& index);

  /// Forgets all leaves.
  void clear();

  /// The local slot of `slot`. Its leaf is now met.
  [[nodiscard]] std::uint32_t local(std::uint32_t slot) { return kLeafCapacity * meet(leaf_of(slot)) + lane_of(slot); }

  /// The leaves met, by their numbers, as they are named in the index.
  [[nodiscard]] std::size_t leaf_count() const { return leaves_.size(); }
  [[nodiscard]] LeafId leaf(std::size_t number) const { return leaves_[number].leaf; }

  /// The vertex at a local slot, in index order.
  [[nodiscard]] std::uint32_t vertex(std::uint32_t slot) const { return leaves_[leaf_of(slot)].first + lane_of(slot); }

  struct Edge {
    double length;
    std::uint32_t neighbor;  // its local slot
  };

  /// The edges of a vertex. The leaves of its neighbors are now met. Valid until the next call.
  [[nodiscard]] std::span<const Edge> edges(std::uint32_t slot) {
    if (!leaves_[leaf_of(slot)].has_rows) add_rows(leaf_of(slot));
    const std::uint32_t* const row = row_begin(slot);
    return {edges_.data() + leaves_[leaf_of(slot)].first_edge + row[0], row[1] - row[0]};
  }

  /// Prefetches the edges of a vertex, which need not have a row yet.
  void prefetch_edges(std::uint32_t slot) const {
    fetch_lines(edges_.data() + leaves_[leaf_of(slot)].first_edge + *row_begin(slot), 2);
  }

  /// The mean length of the edges in all rows; 0 if there are none.
  [[nodiscard]] double mean_length() const;

 private:
  struct MetLeaf {
    std::size_t first_edge;  // in edges_
    LeafId leaf;
    std::uint32_t first;  // its first vertex in index order
    bool has_rows;
  };

  /// The number of a leaf among those met, if it is of this search.
  struct Number {
    std::uint32_t search = 0;
    std::uint32_t number = 0;
  };

  // By lane: where rows begin, or where they end while they are filled. And one more.
  using Rows = std::span<std::uint32_t, kLeafCapacity + 1>;

  [[nodiscard]] const std::uint32_t* row_begin(std::uint32_t slot) const { return &rows_[slot + leaf_of(slot)]; }
  std::uint32_t meet(LeafId leaf);
  void add_rows(std::uint32_t number);
  void count_edges(const Leaf& leaf, std::span<const Link> links, Rows counts) const;
  void add_own_edges(std::uint32_t number, std::span<const Point> points, Edge* edges, Rows ends) const;
  template <class Real>
  void add_cross_edges(std::span<const Real> xyz, std::span<const Link> links, std::span<const Point> points,
                       Edge* edges, Rows ends);

  const IndexView* index_;
  std::vector<Number> numbers_;  // by leaf of the index
  std::uint32_t search_ = 0;
  std::vector<MetLeaf> leaves_;
  std::vector<std::uint32_t> rows_;  // 33 for each leaf: where the rows of its vertices begin, and where the last ends
  std::vector<Edge> edges_;          // the first `edge_count_` are those of the rows
  std::size_t edge_count_ = 0;
};

}  // namespace meshhood
