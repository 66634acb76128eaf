// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "meshhood/error.h"
#include "meshhood/start.h"

#include "exact/layout.h"
#include "exact/query/any_center.h"
#include "exact/query/nearest_first.h"

namespace meshhood::inline v0_1 {

/// The vertex nearest to a point, of one point after the other.
class NearestVertexSearch {
 public:
  explicit NearestVertexSearch(const IndexView& index) : index_(&index), center_(index.frame, {}) {}

  /// Begins with the last answer, which is near if the points are. Throws Error{VertexOutOfRange} if there is none.
  NearestVertex run(const Point& p) {
    center_ = Center(index_->frame, p);
    distance_ = std::numeric_limits<double>::infinity();
    if (vertex_ != kNoVertex) distance_ = distance_to(index_->position_of(vertex_));
    NearestFirst(*index_, center_, *this).run();
    if (vertex_ == kNoVertex) {
      raise(ErrorCode::VertexOutOfRange, index_->vertex_count() == 0 ? "nearest: the mesh has no vertices"
                                                                     : "nearest: all vertices of the mesh are walls");
    }
    return {vertex_, distance_};
  }

  [[nodiscard]] double reach() const { return distance_; }

  [[nodiscard]] static bool wants(NodeId /*node*/) { return true; }

  void visit_leaf(LeafId leaf) {
    for (std::size_t v = index_->leaf_begin[leaf]; v < index_->leaf_begin[leaf + 1]; ++v) {
      if (index_->is_wall_at(v)) continue;
      const double distance = distance_to(index_->position(v));
      if (distance > distance_) continue;
      const VertexId id = index_->id(v);
      if (distance == distance_ && vertex_ < id) continue;
      distance_ = distance;
      vertex_ = id;
    }
  }

 private:
  /// Different squares may have one root.
  [[nodiscard]] double distance_to(const Point& p) const { return std::sqrt(squared_distance(center_.exact, p)); }

  const IndexView* index_;
  Center center_;
  VertexId vertex_ = kNoVertex;
  double distance_ = 0;
};

}  // namespace meshhood::inline v0_1
