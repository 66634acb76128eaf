// SPDX-License-Identifier: MIT
#pragma once

#include "exact/layout.h"
#include "exact/search/query.h"
#include "simd/kernels.h"

namespace meshhood {

/// Answers within the leaf of the query vertex, as in tiny balls and in components of few vertices. The preparations of
/// the other searches would take longer than such a query.
class SingleLeaf {
 public:
  SingleLeaf(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// The vertices of the answer; none if an edge leads from them to a vertex of the ball in another leaf.
  [[nodiscard]] LaneMask find(const Query& query) const;

 private:
  [[nodiscard]] bool leads_out(const Query& query, LaneMask found) const;
  [[nodiscard]] bool has_vertex_in_ball(LeafId leaf, LaneMask lanes, const LeafBall& ball) const;

  const IndexView* index_;
  const Kernels* kernels_;
};

}  // namespace meshhood
