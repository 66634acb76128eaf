// SPDX-License-Identifier: MIT
// Implements the range search of sec. 4.3 by a scan of all vertices.
#include <cmath>

#include "meshhood/reference.h"

#include "base/ranges.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// Calls `f(w)` for every vertex of the ball, in ascending order.
template <class F>
void scan(const PositionsView& positions, VertexId v, double radius, F&& f) {
  check_query(v, positions.size(), radius);
  positions.visit([&](const auto& xyz) {
    const SearchBall ball(point(xyz, v), radius);
    const auto scan_all = [&](const auto& all) {
      for (std::size_t w = 0; w < positions.size(); ++w) {
        if (ball.contains(point(all, w))) f(static_cast<VertexId>(w));
      }
    };
    xyz.is_packed() ? scan_all(xyz.packed()) : scan_all(xyz);
  });
}

std::size_t size_of(std::span<const VertexRange> ranges) {
  std::size_t size = 0;
  for (const VertexRange& range : ranges) size += range.size();
  return size;
}

}  // namespace

// What is replaced has not changed if memory runs out: the answer is found first, and has room before it is written.

void BallSearcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out) {
  out.reserve(size_of(ranges(v, radius)));
  out.clear();
  for (const VertexRange& range : ranges_) {
    for (VertexId w = range.begin; w < range.end; ++w) out.push_back(w);
  }
}

void BallSearcher::neighborhood(Vertex v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  distances.reserve(size_of(ranges(v, radius)));
  out.reserve(size_of(ranges_));
  out.clear();
  distances.clear();
  positions_.visit([&](const auto& xyz) {
    for (const VertexRange& range : ranges_) {
      for (VertexId w = range.begin; w < range.end; ++w) {
        out.push_back(w);
        distances.push_back(std::sqrt(squared_distance(point(xyz, w), point(xyz, v))));
      }
    }
  });
}

std::span<const VertexRange> BallSearcher::ranges(Vertex v, double radius) & {
  ranges_.clear();
  scan(positions_, v, radius, [&](VertexId w) { append_to(ranges_, w); });
  return ranges_;
}

std::size_t BallSearcher::count(Vertex v, double radius) {
  std::size_t result = 0;
  scan(positions_, v, radius, [&](VertexId) { ++result; });
  return result;
}

}  // namespace meshhood::inline v0_1
