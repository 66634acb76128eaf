// SPDX-License-Identifier: MIT
// Makes a mesh of a patch. The part of a triangle in the ball is convex: its outline runs along the chords of its
// sides, and along arcs, which points divide. A point on a side has a name that all triangles at the side give it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/lists.h"
#include "base/vector.h"
#include "patch/clipped_triangle.h"
#include "patch/search.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {
namespace {

/// A point by what it lies on, in the order of the points of a mesh: a vertex, or a side by the end beyond the point
/// and the other, or else by a number.
using PointName = std::uint64_t;

constexpr PointName vertex_name(VertexId v) { return v; }
constexpr PointName side_name(VertexId beyond, VertexId other) { return ((PointName{beyond} + 1) << 32) | other; }
constexpr PointName inner_name(std::size_t number) { return (PointName{kNoVertex} << 32) | number; }
constexpr bool is_vertex(PointName name) { return name >> 32 == 0; }

/// A point that is no vertex.
struct NewPoint {
  PointName name;
  std::size_t number;  // in the order of the triangles
  PointName same;      // of the point that stands for it, because they touch: its own, unless it is on a side
  std::array<VertexId, 3> vertices;
  std::array<double, 3> weights;
  SpacePoint point;
};

/// A triangle of the mesh by the names of its corners.
struct NamedTriangle {
  std::size_t face;
  std::array<PointName, 3> corners;
};

class Clip {
 public:
  Clip(const PatchState& state, const PatchBall& ball, double radius, double tolerance)
      : state_(&state), ball_(ball), radius_(radius), tolerance_(tolerance) {}

  void add(TriangleId t) {
    const std::array<std::uint32_t, 3>& places = state_->triangles.corners[t];
    triangle_ = {corners_of(*state_->index, places), places, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      triangle_.inside[i] = ball_.contains(triangle_.corners[i]);
      vertices_[i] = state_->index->id(places[i]);
    }
    if (triangle_.inside[0] && triangle_.inside[1] && triangle_.inside[2]) {
      for (const VertexId v : vertices_) outline_.push_back(vertex_name(v));
    } else if (std::isfinite(ball_.unit)) {
      add_clipped();
    }
    outlines_.emplace_back(state_->triangles.face[t], outline_.size());
  }

  [[nodiscard]] ClippedMesh finish() {
    std::ranges::sort(new_points_, {}, [](const NewPoint& p) { return std::pair(p.name, p.number); });
    for (PointName& name : outline_) name = resolved(name);
    return number(named_triangles());
  }

 private:
  void add_clipped() {
    ClippedTriangle clipped(ball_, triangle_);
    clipped.find_outline();
    if (clipped.has_disc()) return add_disc(clipped.circle());
    for (std::size_t i = 0; i < 3; ++i) {
      if (!clipped.meets(i)) continue;
      outline_.push_back(triangle_.inside[i] ? vertex_name(vertices_[i]) : add_on_side(clipped, i, true));
      if (!clipped.has_arc(i)) continue;
      outline_.push_back(add_on_side(clipped, i, false));
      const auto [to, angle] = clipped.arc_from(i);
      divide(clipped.circle(), angle, clipped.exit(i), clipped.entry(to));
    }
  }

  /// Adds a whole circle, from any point of it and around to it.
  void add_disc(const Circle& circle) {
    const Point side = triangle_.corners[1] - triangle_.corners[0];
    const Point begin = circle.distance * circle.normal + (circle.radius() / length(side)) * side;
    add_inside(begin);
    divide(circle, 2 * std::numbers::pi, begin, begin);
  }

  /// Adds the point where side `i` enters the ball, or leaves it, and returns its name.
  PointName add_on_side(const ClippedTriangle& clipped, std::size_t i, bool enters) {
    const std::size_t beyond = enters ? i : (i + 1) % 3;
    const std::size_t other = enters ? (i + 1) % 3 : i;
    const PointName name = side_name(vertices_[beyond], vertices_[other]);
    const PointName opposite =
        triangle_.inside[other] ? vertex_name(vertices_[other]) : side_name(vertices_[other], vertices_[beyond]);
    const SpacePoint at = in_space(enters ? clipped.entry(i) : clipped.exit(i));
    const double share = share_of_side(from_point(at, beyond), from_point(at, other));
    new_points_.push_back({name,
                           new_points_.size(),
                           clipped.touches(i) ? std::min(name, opposite) : name,
                           {vertices_[beyond], vertices_[other], vertices_[other]},
                           {1 - share, share, 0},
                           at});
    return name;
  }

  void add_inside(const Point& on_sphere) {
    const PointName name = inner_name(inner_points_++);
    const SpacePoint at = in_space(on_sphere);
    const TrianglePoint found =
        nearest_in_triangle({at[0], at[1], at[2]}, triangle_.corners, state_->index->frame.scale);
    new_points_.push_back({name, new_points_.size(), name, vertices_, found.barycentric, at});
    outline_.push_back(name);
  }

  /// Adds points between the ends of an arc.
  void divide(const Circle& circle, double angle, const Point& from, const Point& to) {
    constexpr double kLong = 2;
    const double size = circle.radius();
    const double half = length(to - from) / 2;
    // If the circle is a point, the ends of the arc may differ by their rounding.
    const double height = half < size ? half * half / (size + std::sqrt((size - half) * (size + half))) : size;
    if (angle < kLong && !(height > tolerance_)) return;
    const Point middle = circle.middle(angle, from, to);
    divide(circle, angle / 2, from, middle);
    add_inside(middle);
    divide(circle, angle / 2, middle, to);
  }

  /// Moves a point onto the sphere. On a line whose ends are far away, it is off it by some units in the last place.
  [[nodiscard]] SpacePoint in_space(const Point& near_sphere) const {
    const Point p = ball_.center + (radius_ / length(near_sphere)) * near_sphere;
    return {p.x, p.y, p.z};
  }

  /// Returns a corner relative to `p`, in the frame.
  [[nodiscard]] Point from_point(const SpacePoint& p, std::size_t corner) const {
    return ball_.scale * (triangle_.corners[corner] - Point{p[0], p[1], p[2]});
  }

  [[nodiscard]] const NewPoint& new_point(PointName name) const {
    return *std::ranges::lower_bound(new_points_, name, {}, &NewPoint::name);
  }

  /// Returns the name by which a point is stored. What the first triangle of a side says of its points holds for all.
  [[nodiscard]] PointName resolved(PointName name) const { return is_vertex(name) ? name : new_point(name).same; }

  /// Divides each outline into a fan of triangles.
  [[nodiscard]] std::vector<NamedTriangle> named_triangles() const {
    std::vector<NamedTriangle> triangles;
    std::vector<PointName> corners;
    std::size_t begin = 0;
    for (const auto& [face, end] : outlines_) {
      corners.clear();
      for (; begin < end; ++begin) {
        if (corners.empty() || corners.back() != outline_[begin]) corners.push_back(outline_[begin]);
      }
      while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
      for (std::size_t i = 2; i < corners.size(); ++i) {
        triangles.push_back({face, {corners[0], corners[i - 1], corners[i]}});
      }
    }
    return triangles;
  }

  [[nodiscard]] ClippedMesh number(const std::vector<NamedTriangle>& triangles) const {
    std::vector<PointName> names;
    for (const NamedTriangle& triangle : triangles) {
      names.insert(names.end(), triangle.corners.begin(), triangle.corners.end());
    }
    sort_out(names);
    ClippedMesh mesh;
    for (const PointName name : names) add_point(name, mesh);
    for (const auto& [face, corners] : triangles) {
      mesh.faces.push_back(face);
      auto& numbers = mesh.triangles.emplace_back();
      std::ranges::transform(corners, numbers.begin(), [&](PointName name) {
        return static_cast<VertexId>(std::ranges::lower_bound(names, name) - names.begin());
      });
    }
    return mesh;
  }

  void add_point(PointName name, ClippedMesh& mesh) const {
    if (is_vertex(name)) {
      const auto v = static_cast<VertexId>(name);
      const Point p = state_->index->position_of(v);
      mesh.points.push_back({p.x, p.y, p.z});
      mesh.vertices.push_back({v, v, v});
      mesh.weights.push_back({1, 0, 0});
    } else {
      const NewPoint& made = new_point(name);
      mesh.points.push_back(made.point);
      mesh.vertices.push_back(made.vertices);
      mesh.weights.push_back(made.weights);
    }
  }

  const PatchState* state_;
  PatchBall ball_;
  double radius_;
  double tolerance_;
  PatchTriangle triangle_{};                                   // that is added
  std::array<VertexId, 3> vertices_{};                         // its corners
  std::vector<PointName> outline_;                             // of all triangles, one after the other
  std::vector<std::pair<std::size_t, std::size_t>> outlines_;  // of each: its face, and its end in `outline_`
  std::vector<NewPoint> new_points_;
  std::size_t inner_points_ = 0;
};

}  // namespace

ClippedMesh PatchSearch::clip(double radius, double tolerance) const {
  Clip clip(*state_, ball_, radius, tolerance);
  for (const TriangleId t : triangles()) clip.add(t);
  return clip.finish();
}

}  // namespace meshhood::inline v0_1
