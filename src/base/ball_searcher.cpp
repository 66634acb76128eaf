// SPDX-License-Identifier: MIT
// Implements the range search of sec. 4.3 by a scan of all vertices.
#include <cmath>

#include "meshhood/reference.h"

#include "base/ranges.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// Calls `f(w, position, center)` for every vertex of the ball, in ascending order.
template <class F>
void scan(const PositionsView& positions, VertexId v, double radius, F&& f) {
  check_query(v, positions.size(), radius);
  positions.visit([&](const auto& xyz) {
    const SearchBall ball(point(xyz, v), radius);
    const auto scan_all = [&](const auto& all) {
      for (std::size_t w = 0; w < positions.size(); ++w) {
        const Point p = point(all, w);
        if (ball.contains(p)) f(static_cast<VertexId>(w), p, ball.center());
      }
    };
    xyz.is_packed() ? scan_all(xyz.packed()) : scan_all(xyz);
  });
}

}  // namespace

void BallSearcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out) {
  check_query(v, vertex_count(), radius);
  out.clear();
  scan(positions_, v, radius, [&](VertexId w, const Point&, const Point&) { out.push_back(w); });
}

void BallSearcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  check_query(v, vertex_count(), radius);
  out.clear();
  distances.clear();
  scan(positions_, v, radius, [&](VertexId w, const Point& p, const Point& center) {
    out.push_back(w);
    distances.push_back(std::sqrt(squared_distance(p, center)));
  });
}

std::span<const VertexRange> BallSearcher::ranges(Vertex v, double radius) & {
  ranges_.clear();
  scan(positions_, v, radius, [&](VertexId w, const Point&, const Point&) { append_to(ranges_, w); });
  return ranges_;
}

std::size_t BallSearcher::count(Vertex v, double radius) {
  std::size_t result = 0;
  scan(positions_, v, radius, [&](VertexId, const Point&, const Point&) { ++result; });
  return result;
}

}  // namespace meshhood::inline v0_1
