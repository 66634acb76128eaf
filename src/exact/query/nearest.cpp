// SPDX-License-Identifier: MIT
// The vertex nearest to a point.
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "meshhood/error.h"
#include "meshhood/start.h"

#include "exact/index_access.h"
#include "exact/query/any_center.h"
#include "exact/query/arguments.h"
#include "exact/query/nearest_first.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

class NearestSearch {
 public:
  NearestSearch(const IndexView& index, const Point& p) : index_(&index), center_(index.frame, p) {}

  NearestVertex run() {
    NearestFirst(*index_, center_, *this).run();
    return {best_, distance_};
  }

  [[nodiscard]] double reach() const { return distance_; }

  [[nodiscard]] static bool wants(NodeId /*node*/) { return true; }

  void visit_leaf(LeafId leaf) {
    for (std::size_t v = index_->leaf_begin[leaf]; v < index_->leaf_begin[leaf + 1]; ++v) {
      if (index_->is_wall_at(v)) continue;
      const Point p = index_->position(v);
      const double distance = std::sqrt(squared_distance(center_.exact, p));  // different squares may have one root
      if (distance > distance_) continue;
      const VertexId id = index_->id(v);
      if (distance == distance_ && best_ < id) continue;
      distance_ = distance;
      best_ = id;
    }
  }

 private:
  const IndexView* index_;
  Center center_;
  double distance_ = std::numeric_limits<double>::infinity();
  VertexId best_ = std::numeric_limits<VertexId>::max();
};

}  // namespace

NearestVertex nearest(const Index& index, const SpacePoint& p) {
  check_point(p, "point");
  if (index.vertex_count() == 0) raise(ErrorCode::VertexOutOfRange, "nearest: the mesh has no vertices");
  const NearestVertex found = NearestSearch(IndexAccess::view(index), {p[0], p[1], p[2]}).run();
  if (found.vertex >= index.vertex_count()) {
    raise(ErrorCode::VertexOutOfRange, "nearest: all vertices of the mesh are walls");
  }
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
