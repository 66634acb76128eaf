// SPDX-License-Identifier: MIT
#include "shared/distance.h"

#include <cmath>
#include <string>

#include "meshhood/error.h"

#include "shared/text.h"

namespace meshhood::inline v0_1 {

double squared_radius(double radius) {
  double threshold = radius * radius;
  if (threshold == kInfinity) return kInfinity;
  // Product and root are rounded once each, so the result is one or two steps away. The number of steps is bounded
  // because denormals have the root 0 if the host flushes them to zero.
  constexpr int kSteps = 4;
  for (int i = 0; i < kSteps && std::sqrt(threshold) > radius; ++i) threshold = std::nextafter(threshold, 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double next = std::nextafter(threshold, kInfinity);
    if (std::sqrt(next) > radius) break;
    threshold = next;
  }
  return threshold;
}

void check_radius(double radius, std::string_view where) {
  if (radius >= 0) [[likely]] {
    return;
  }
  raise(ErrorCode::InvalidRadius, std::string(where) + "radius " + to_text(radius) + ", expected a number >= 0");
}

void check_query(VertexId v, std::size_t vertices, double radius, std::string_view where) {
  if (v >= vertices) {
    raise_no_such_vertex(ErrorCode::VertexOutOfRange, std::string(where) + "vertex ", std::to_string(v), vertices);
  }
  check_radius(radius, where);
}

double distance(const PositionsView& positions, Vertex v, Vertex w) {
  check_query(v, positions.size(), 0);
  check_query(w, positions.size(), 0);
  return std::sqrt(squared_distance(point(positions, v), point(positions, w)));
}

}  // namespace meshhood::inline v0_1
