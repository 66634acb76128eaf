// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/search.h"

#include "exact/bound_index.h"
#include "exact/query/any_center.h"
#include "exact/vertex_set.h"
#include "simd/ball.h"
#include "simd/kernels.h"

namespace meshhood {

/// Finds every vertex within `radius` of `v` in space, connected or not, by the tree of the index: a node inside the
/// ball is taken as a whole, one outside is skipped. Satisfies `NeighborhoodSearcher`; answers are in index order.
class SpaceSearcher {
 public:
  explicit SpaceSearcher(const Index& index);

  [[nodiscard]] std::size_t vertex_count() const { return index_->vertex_count(); }
  [[nodiscard]] std::span<const VertexId> permutation() const;

  [[nodiscard]] std::vector<VertexId> neighborhood(VertexId v, double radius);
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius);
  [[nodiscard]] std::size_t count(VertexId v, double radius);

 private:
  void search(VertexId v, double radius);
  void visit_roots(std::size_t level, std::size_t first);
  void visit_group(std::size_t group);
  void visit_leaf(LeafId leaf);

  BoundIndex index_;
  const Kernels* kernels_;
  Center center_;
  LeafBall ball_;
  std::vector<VertexSet::Part> found_;  // root group by root group, ascending within each
  VertexSet answer_;
};

}  // namespace meshhood
