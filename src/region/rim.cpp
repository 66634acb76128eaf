// SPDX-License-Identifier: MIT
// The rim: each face at the border of a region gives a segment between two edges that leave it, and the segments are
// joined into polylines.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/region_mesh.h"

#include "exact/query/arguments.h"
#include "region/exit_point.h"
#include "region/mesher_state.h"
#include "region/polylines.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood {
namespace {

/// An edge that leaves the region: its end inside, and its end outside.
using RimEdge = std::array<VertexId, 2>;

/// The two exits that a face joins, in the direction that has the region on its left.
struct ExitPair {
  RimEdge from;
  RimEdge to;
};

/// Adds a pair for each run of corners inside the region: the edges on which the boundary of the face leaves the region
/// after the run and enters it before the run.
template <class IsInside>
void add_exits(std::span<const VertexId> corners, IsInside&& is_inside, std::vector<ExitPair>& pairs) {
  const std::size_t size = corners.size();
  const auto corner = [&](std::size_t i) { return corners[i % size]; };
  for (std::size_t begin = 0; begin < size; ++begin) {
    const VertexId before = corner(begin + size - 1);
    if (is_inside(before) || !is_inside(corner(begin))) continue;
    std::size_t last = begin;
    while (is_inside(corner(last + 1))) ++last;
    const ExitPair pair{{corner(last), corner(last + 1)}, {corner(begin), before}};
    if (pair.from != pair.to) pairs.push_back(pair);
  }
}

std::vector<RimEdge> distinct_exits(std::span<const ExitPair> pairs) {
  std::vector<RimEdge> exits;
  for (const ExitPair& pair : pairs) exits.insert(exits.end(), {pair.from, pair.to});
  std::sort(exits.begin(), exits.end());
  exits.erase(std::unique(exits.begin(), exits.end()), exits.end());
  return exits;
}

std::vector<Segment> segments_of(std::span<const ExitPair> pairs, const std::vector<RimEdge>& exits) {
  const auto number = [&](const RimEdge& edge) {
    return static_cast<std::uint32_t>(std::lower_bound(exits.begin(), exits.end(), edge) - exits.begin());
  };
  std::vector<Segment> segments;
  for (const ExitPair& pair : pairs) segments.push_back({number(pair.from), number(pair.to)});
  return segments;
}

}  // namespace

Rim RegionMesher::rim(std::span<const VertexId> ids, const SpacePoint& center, double radius) {
  check_point(center, "center: ");
  check_radius(radius);
  const std::vector<std::size_t> faces = state_->select(ids, Corners::Any);
  const auto is_inside = [&](VertexId v) { return state_->is_marked(v); };
  std::vector<ExitPair> pairs;
  for (const std::size_t face : faces) {
    const auto corners = state_->lists.corners(face);
    if (corners.size() >= 3) add_exits(corners, is_inside, pairs);
  }
  const std::vector<RimEdge> exits = distinct_exits(pairs);
  const Point middle{center[0], center[1], center[2]};
  std::vector<SpacePoint> points;
  for (const auto& [inner, outer] : exits) {
    const auto at = [&](VertexId v) { return point(state_->positions, v); };
    if (!(squared_distance(at(inner), middle) <= squared_radius(radius))) {
      raise(ErrorCode::InvalidOption, "ids: vertex " + std::to_string(inner) + " is not within the radius " +
                                          to_text(radius) + " of the center, expected a region of this ball");
    }
    const Point p = exit_point(at(inner), at(outer), middle, radius);
    points.push_back({p.x, p.y, p.z});
  }
  Rim rim;
  rim.offsets.push_back(0);
  for (const Polyline& line : join_segments(segments_of(pairs, exits), exits.size())) {
    for (const std::uint32_t i : line.points) {
      rim.points.push_back(points[i]);
      rim.edges.push_back(exits[i]);
    }
    rim.offsets.push_back(rim.points.size());
    rim.closed.push_back(static_cast<std::uint8_t>(line.is_closed));
  }
  return rim;
}

}  // namespace meshhood
