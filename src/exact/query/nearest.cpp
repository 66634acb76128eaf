// SPDX-License-Identifier: MIT
// The vertex nearest to a point.
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "meshhood/error.h"
#include "meshhood/start.h"

#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "exact/query/nearest_vertex.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
NearestVertex nearest(const Index& index, const SpacePoint& point) {
  check_point(point, "point");
  return NearestVertexSearch(IndexAccess::view(index)).run({point[0], point[1], point[2]});
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
