// SPDX-License-Identifier: MIT
// Finds the vertices nearest to points: for one, and for many along a curve on which near points follow each other.
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/start.h"

#include "batch/position_sort.h"
#include "exact/index_access.h"
#include "exact/query/any_center.h"
#include "exact/query/arguments.h"
#include "exact/query/nearest_first.h"
#include "shared/large_pages.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

/// Finds the vertex nearest to a point, for one point after the other.
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
  /// Roots are compared, because different squares may have the same root.
  [[nodiscard]] double distance_to(const Point& p) const { return std::sqrt(squared_distance(center_.exact, p)); }

  const IndexView* index_;
  Center center_;
  VertexId vertex_ = kNoVertex;
  double distance_ = 0;
};

}  // namespace

NearestVertex nearest(const Index& index, const SpacePoint& point) {
  check_point(point, "point");
  return NearestVertexSearch(IndexAccess::view(index)).run({point[0], point[1], point[2]});
}

std::vector<NearestVertex> nearest(const Index& index, std::span<const SpacePoint> points, const Run& run) {
  check_points(points, "points");
  TaskContext task(run.threads, run.progress, points.size());
  const IndexView& view = IndexAccess::view(index);
  std::vector<NearestVertex> found = make_values<NearestVertex>(points.size());
  search_along_curve(
      points, view.frame, task, [&] { return NearestVertexSearch(view); },
      [&](std::size_t row, const NearestVertex& nearest) { found[row] = nearest; });
  return found;
}

Start Start::nearest(const Index& index, const SpacePoint& center) {
  Start start(meshhood::nearest(index, center).vertex);
  start.center_ = center;
  return start;
}

SpacePoint point_on_face(const Index& index, std::span<const VertexId> corners, std::span<const double> weights) {
  if (weights.size() != corners.size()) {
    raise(ErrorCode::InvalidOption, "weights: " + std::to_string(weights.size()) +
                                        " values, expected one for each of " + std::to_string(corners.size()) +
                                        " corners");
  }
  SpacePoint sum{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    check_vertex(corners[i], index.vertex_count(), "corner " + std::to_string(i) + ": vertex");
    if (!std::isfinite(weights[i])) {
      raise(ErrorCode::InvalidOption,
            "weights: value " + std::to_string(i) + " is " + to_text(weights[i]) + ", expected a finite number");
    }
    const Point corner = IndexAccess::view(index).position_of(corners[i]);
    sum = {sum[0] + weights[i] * corner.x, sum[1] + weights[i] * corner.y, sum[2] + weights[i] * corner.z};
  }
  check_point(sum, "point on the face");
  return sum;
}

}  // namespace meshhood::inline v0_1
