// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "exact/layout.h"
#include "exact/query/any_center.h"
#include "exact/query/single_queries.h"
#include "exact/vertex_set.h"
#include "simd/ball.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Finds every vertex within a radius in space, connected or not, by the tree of the index: a node inside the ball is
/// taken as a whole, one outside is skipped. Leaves out walls and ignored vertices. Arguments are valid. One object a
/// thread.
class SpaceSearch {
 public:
  SpaceSearch(const IndexView& index, const Kernels& kernels);

  VertexSet answer;

  /// Refills `answer` with the vertices around a vertex; none around a wall.
  void search(VertexId v, double radius);

  /// The same around a point.
  void search(const Point& center, double radius);

 private:
  void visit_roots(std::size_t level, std::size_t first);
  void visit_group(std::size_t group);
  void visit_leaf(LeafId leaf);

  const IndexView* index_;
  const Kernels* kernels_;
  Center center_;
  LeafBall ball_;
  std::vector<VertexSet::Part> found_;  // root group by root group, ascending within each
};

/// The answers of the metric.
[[nodiscard]] std::unique_ptr<SingleQueries> make_space_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph,
                                                                Isa isa);

}  // namespace meshhood::inline v0_1
