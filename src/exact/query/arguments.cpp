// SPDX-License-Identifier: MIT
#include "exact/query/arguments.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "meshhood/error.h"

#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {

void check_points(std::span<const SpacePoint> points, std::string_view name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::ranges::all_of(points[i], is_valid_coordinate)) check_point(points[i], name, i);
  }
}

void check_vertex(VertexId v, std::size_t vertices, std::string_view name) {
  if (v < vertices) return;
  raise_no_such_vertex(ErrorCode::VertexOutOfRange, std::string(name) + " ", std::to_string(v), vertices);
}

void check_start(const Start& start, std::size_t vertices, std::string_view where) {
  const std::string prefix(where);
  if (!start.center()) {
    check_vertex(start.vertex(), vertices, prefix + "vertex");
    return;
  }
  check_point(*start.center(), prefix + "center");
  for (std::size_t i = 0; i < start.seeds().size(); ++i) {
    check_vertex(start.seeds()[i], vertices, prefix + "seed " + std::to_string(i) + ": vertex");
  }
}

void check_ascending(std::span<const double> radii) {
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::string where = "radii: value " + std::to_string(i) + ": ";
    check_radius(radii[i], where);
    if (i == 0 || radii[i - 1] < radii[i]) continue;
    raise(ErrorCode::InvalidRadius,
          where + "radius " + to_text(radii[i]) + ", expected more than " + to_text(radii[i - 1]) + " before it");
  }
}

void check_k(std::size_t k) {
  if (k == 0) raise(ErrorCode::InvalidOption, "k: 0, expected at least 1");
}

void check_connects(Metric metric) {
  if (metric != Metric::Space) return;
  raise(ErrorCode::InvalidOption, "metric: expected another than space, in which nothing is connected");
}

void check_weights(std::span<const double> weights, std::size_t vertices, std::string_view name) {
  if (weights.size() != vertices) {
    raise(ErrorCode::InvalidOption, named(name, {}) + std::to_string(weights.size()) +
                                        " values, expected one for each of " + std::to_string(vertices) + " vertices");
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (weights[v] >= 0 && std::isfinite(weights[v])) [[likely]] {
      continue;
    }
    raise(ErrorCode::InvalidOption, named(name, {}) + "vertex " + std::to_string(v) + " has " + to_text(weights[v]) +
                                        ", expected a finite number >= 0");
  }
}

}  // namespace meshhood::inline v0_1
