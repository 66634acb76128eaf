// SPDX-License-Identifier: MIT
// Makes a mesh of the faces of a region, and finds its rim: each face at the border of the region gives a segment
// between two edges that leave it, and the segments are joined into polylines.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshhood/error.h"

#include "base/lists.h"
#include "base/vector.h"
#include "exact/query/arguments.h"
#include "shared/distance.h"
#include "shared/text.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

/// A set of vertices, and the faces that belong to it.
class FaceSelection {
 public:
  /// Throws Error{VertexOutOfRange}.
  FaceSelection(const SurfaceState& surface, std::span<const VertexId> ids, Corners corners)
      : is_marked_(surface.index->vertex_count()) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] < is_marked_.size()) continue;
      raise_no_such_vertex(ErrorCode::VertexOutOfRange, "ids: position " + std::to_string(i) + ": vertex ",
                           std::to_string(ids[i]), is_marked_.size());
    }
    for (const VertexId v : ids) {
      is_marked_[v] = true;
      faces_.insert(faces_.end(), surface.lists()[v].begin(), surface.lists()[v].end());
    }
    sort_out(faces_);
    if (corners == Corners::Any) return;
    std::erase_if(faces_, [&](std::size_t face) {
      return !std::ranges::all_of(surface.faces()[face], [&](VertexId v) { return has(v); });
    });
  }

  [[nodiscard]] bool has(VertexId v) const { return is_marked_[v]; }
  [[nodiscard]] const std::vector<std::size_t>& faces() const { return faces_; }  // ascending

 private:
  std::vector<bool> is_marked_;
  std::vector<std::size_t> faces_;
};

/// An edge that leaves a region: its end inside, and its end outside.
using RimEdge = std::array<VertexId, 2>;

/// Calls `f(begin, count)` for each run of `count` corners inside the region, the first of which is corner `begin`;
/// corners are numbered around the face. There is no run if all are inside.
template <class IsInside, class F>
void for_each_run(std::span<const VertexId> corners, IsInside&& is_inside, F&& f) {
  const std::size_t size = corners.size();
  for (std::size_t begin = 0; begin < size; ++begin) {
    if (is_inside(corners[(begin + size - 1) % size]) || !is_inside(corners[begin])) continue;
    std::size_t count = 1;
    while (is_inside(corners[(begin + count) % size])) ++count;
    f(begin, count);
  }
}

/// A directed segment between two points, given by their numbers.
struct Segment {
  std::uint32_t from;
  std::uint32_t to;
};

/// A chain of points, each joined to the next; in a loop also the last to the first.
struct Polyline {
  std::vector<std::uint32_t> points;
  bool is_closed;
};

/// Joins segments into the longest polylines that end only at points of which the number of segments is not two. A
/// polyline has the direction of its first segment.
class Joiner {
 public:
  Joiner(std::span<const Segment> segments, std::size_t points) : segments_(segments), is_used_(segments.size()) {
    of_points_ = gather_lists<std::size_t, std::size_t>(points, [&](auto&& f) {
      for (std::size_t i = segments.size(); i-- > 0;) {
        f(segments[i].from, i);
        f(segments[i].to, i);
      }
    });
  }

  std::vector<Polyline> join() {
    std::vector<Polyline> result;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_used_[i] && is_end(segments_[i].from)) result.push_back(walk(i, segments_[i].from));
    }
    // Where faces are not consistently oriented, segments run against the others.
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_used_[i] && is_end(segments_[i].to)) result.push_back(walk(i, segments_[i].to));
    }
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_used_[i]) result.push_back(walk(i, segments_[i].from));
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_end(std::uint32_t point) const { return of_points_[point].size() != 2; }

  /// Walks from `start`, an end of segment `next`, to an end or back to `start`.
  Polyline walk(std::size_t next, std::uint32_t start) {
    Polyline line{{start}, false};
    std::uint32_t at = start;
    while (true) {
      is_used_[next] = true;
      at = segments_[next].from == at ? segments_[next].to : segments_[next].from;
      if (at == start && !is_end(at)) {
        line.is_closed = true;
        return line;
      }
      line.points.push_back(at);
      if (is_end(at)) return line;
      const std::span<const std::size_t> both = of_points_[at];
      next = is_used_[both[0]] ? both[1] : both[0];
    }
  }

  std::span<const Segment> segments_;
  Lists<std::size_t, std::size_t> of_points_;  // the segments at each point, ascending
  std::vector<bool> is_used_;
};

/// The two exits that a face joins, in the direction that has the region on its left.
struct ExitPair {
  RimEdge from;
  RimEdge to;
};

/// Adds a pair for each run of corners inside the region: the edges on which the boundary of the face leaves the region
/// after the run and enters it before the run.
template <class IsInside>
void add_exits(std::span<const VertexId> corners, IsInside&& is_inside, std::vector<ExitPair>& pairs) {
  const auto corner = [&](std::size_t i) { return corners[i % corners.size()]; };
  for_each_run(corners, is_inside, [&](std::size_t begin, std::size_t count) {
    const std::size_t last = begin + count - 1;
    const ExitPair pair{{corner(last), corner(last + 1)}, {corner(begin), corner(begin + corners.size() - 1)}};
    if (pair.from != pair.to) pairs.push_back(pair);
  });
}

std::vector<RimEdge> distinct_exits(std::span<const ExitPair> pairs) {
  std::vector<RimEdge> exits;
  for (const ExitPair& pair : pairs) exits.insert(exits.end(), {pair.from, pair.to});
  sort_out(exits);
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

/// Returns the point of the rim on each of `edges`.
std::vector<SpacePoint> rim_points(const IndexView& index, std::span<const RimEdge> edges, const SpacePoint& center,
                                   double radius) {
  const Point middle{center[0], center[1], center[2]};
  std::vector<SpacePoint> points;
  for (const auto& [inner, outer] : edges) {
    const auto at = [&](VertexId v) { return index.position_of(v); };
    if (!(squared_distance(at(inner), middle) <= squared_radius(radius))) {
      raise(ErrorCode::InvalidOption, "ids: vertex " + std::to_string(inner) + " is not within the radius " +
                                          to_text(radius) + " of the center, expected a region of this ball");
    }
    const Point p = exit_point(at(inner), at(outer), middle, radius);
    points.push_back({p.x, p.y, p.z});
  }
  return points;
}

}  // namespace

// The point inside + t d, with d = outside - inside and e = inside - center, has the distance r from the center where
//   (d.d) t^2 + 2 (d.e) t + (e.e - r^2) = 0.
// The last term is not positive, so there is one root t >= 0. Of its two usual forms, this is the one that adds numbers
// of equal sign. All lengths are first divided by the largest of them, so that no product overflows.
Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius) {
  if (squared_distance(outside, center) <= squared_radius(radius)) return outside;
  const Point d = outside - inside;
  const Point e = inside - center;
  const double unit = std::max({largest_component(d), largest_component(e), radius});
  const Point step = (1 / unit) * d;
  const Point offset = (1 / unit) * e;
  const double a = dot(step, step);
  const double b = dot(step, offset);
  const double r = radius / unit;
  const double distance = length(offset);
  const double c = std::min((distance - r) * (distance + r), 0.0);
  const double root = std::sqrt(b * b - a * c);
  const double t = b > 0 ? -c / (b + root) : (root - b) / a;
  return inside + std::clamp(t, 0.0, 1.0) * d;
}

std::vector<std::size_t> Surface::faces(std::span<const VertexId> ids, Corners corners) const {
  return FaceSelection(SurfaceAccess::state(*this), ids, corners).faces();
}

Submesh Surface::submesh(std::span<const VertexId> ids, Corners corners) const {
  const State& state = SurfaceAccess::state(*this);
  Submesh result;
  result.faces = FaceSelection(state, ids, corners).faces();
  result.offsets.push_back(0);
  for (const std::size_t face : result.faces) {
    const auto all = state.faces()[face];
    result.corners.insert(result.corners.end(), all.begin(), all.end());
    result.offsets.push_back(result.corners.size());
  }
  result.vertices = result.corners;
  sort_out(result.vertices);
  for (VertexId& corner : result.corners) {
    const auto place = std::lower_bound(result.vertices.begin(), result.vertices.end(), corner);
    corner = static_cast<VertexId>(place - result.vertices.begin());
  }
  return result;
}

Rim Surface::rim(std::span<const VertexId> ids, const SpacePoint& center, double radius) const {
  const State& state = SurfaceAccess::state(*this);
  check_point(center, "center");
  check_radius(radius);
  const FaceSelection selection(state, ids, Corners::Any);
  const auto is_inside = [&](VertexId v) { return selection.has(v); };
  std::vector<ExitPair> pairs;
  for (const std::size_t face : selection.faces()) {
    const auto corners = state.faces()[face];
    if (corners.size() >= 3) add_exits(corners, is_inside, pairs);
  }
  const std::vector<RimEdge> exits = distinct_exits(pairs);
  const std::vector<SpacePoint> points = rim_points(*state.index, exits, center, radius);
  Rim rim;
  rim.offsets.push_back(0);
  for (const Polyline& line : Joiner(segments_of(pairs, exits), exits.size()).join()) {
    for (const std::uint32_t i : line.points) {
      rim.points.push_back(points[i]);
      rim.edges.push_back(exits[i]);
    }
    rim.offsets.push_back(rim.points.size());
    rim.closed.push_back(static_cast<std::uint8_t>(line.is_closed));
  }
  return rim;
}

}  // namespace meshhood::inline v0_1
