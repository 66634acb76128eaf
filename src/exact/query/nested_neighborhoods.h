// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/searcher_state.h"
#include "exact/search/vertex_set.h"

namespace meshhood {

/// The neighborhoods of one vertex for ascending radii, as rings. `Searcher` finds each as runs and leaf subsets, of
/// which only those vertices are listed that the one before does not have. This takes less time than a flood, because
/// the searcher looks mostly at the boundary of a ball.
class NestedNeighborhoods {
 public:
  NestedNeighborhoods(const std::shared_ptr<const IndexView>& index, Isa isa);

  /// Refills `out` with the ids, ring by ring, and `sizes` with their number at the end of each ring. If it throws,
  /// `out` is unchanged.
  void run(VertexId v, std::span<const double> radii, std::vector<VertexId>& out, std::vector<std::size_t>& sizes);

 private:
  [[nodiscard]] LeafId leaf_at(VertexId first) const;
  void find_ring();
  void add_whole(LeafId leaf);
  void add(const LeafSubset& subset);
  void forget();

  static constexpr LaneMask kAll = ~LaneMask{0};

  const IndexView* index_;
  SearcherAccess::State search_;
  std::vector<LeafId> leaf_before_;  // by 32 vertices in index order: the last leaf that begins before them
  std::vector<LaneMask> found_;      // by leaf: the vertices of the rings so far; kAll for all of its vertices
  std::vector<LeafId> leaves_;       // that have some
  VertexSet ring_;
  std::vector<VertexId> ids_;
};

}  // namespace meshhood
