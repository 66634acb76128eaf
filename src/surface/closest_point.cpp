// SPDX-License-Identifier: MIT
// The point of a surface nearest to a point in space.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include "meshhood/surface.h"

#include "base/vector.h"
#include "batch/position_sort.h"
#include "exact/layout.h"
#include "exact/query/arguments.h"
#include "shared/large_pages.h"
#include "shared/parallel.h"
#include "surface/face_tree.h"
#include "surface/face_triangles.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

/// 0 where squares of lengths vanish.
double share_of(double part, double whole) { return whole > 0 ? part / whole : 0; }

/// The point of a triangle nearest to the origin, by the regions of Ericson, "Real-Time Collision Detection" (2005),
/// sec. 5.1.5. For slivers it may be another point of the triangle, or not a number.
Point roughly_nearest(const std::array<Point, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Point ab = b - a;
  const Point ac = c - a;
  const double d1 = -dot(ab, a);
  const double d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -dot(ab, b);
  const double d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + share_of(d1, d1 - d3) * ab;
  const double d5 = -dot(ab, c);
  const double d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + share_of(d2, d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + share_of(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b);
  // Rounding may bring several of them below 0.
  if (!(va >= 0 && vb >= 0 && vc >= 0)) return a;
  const double share = share_of(1, va + vb + vc);
  return a + (vb * share) * ab + (vc * share) * ac;
}

/// A triangle is first compared roughly, which bounds its distance from both sides. Only those that no other one
/// excludes are measured exactly, at the end.
class ClosestPoint {
 public:
  ClosestPoint(const IndexView& index, const StoredFaces& faces, const FaceTree& tree)
      : index_(&index), faces_(&faces), tree_(&tree), triangles_(tree.triangles()), scale_(index.frame.scale) {}

  /// Begins with the last answer, which is near if the points are.
  SurfacePoint run(const Point& q) {
    q_ = q;
    in_frame_ = index_->frame.to_frame(q);
    reach_ = kInfinity;
    nearest_.at.distance = kInfinity;
    const std::size_t first = nearest_.triangle;
    compare(first);
    tree_->boxes().search(
        in_frame_, [&] { return reach_; },
        [&](std::size_t i) {
          if (i != first) compare(i);
        });
    measure();
    const Triangle& triangle = triangles_[nearest_.triangle];
    return surface_point(*index_, *faces_, triangle.face, triangle.corners, nearest_.at);
  }

 private:
  struct Candidate {
    std::size_t triangle;
    double least;  // of its squared distances, in the frame; may be not a number
  };

  /// No point of a triangle is nearer than its corners are along any direction; that to its nearest point tells the
  /// most.
  void compare(std::size_t i) {
    std::array<Point, 3> from_q;
    for (std::size_t k = 0; k < 3; ++k) {
      from_q[k] = index_->in_frame(triangles_[i].corners[k]) - in_frame_;
    }
    const Point nearest = roughly_nearest(from_q);
    const double along = std::min({dot(nearest, from_q[0]), dot(nearest, from_q[1]), dot(nearest, from_q[2])});
    const double square = dot(nearest, nearest);
    const double least = along > 0 ? along * along / square : 0;
    if (is_far(least)) return;
    limit_to(std::sqrt(square));
    if (size_ == candidates_.size()) measure();
    candidates_[size_++] = {i, least};
  }

  [[nodiscard]] bool is_far(double least) const { return least > reach_ * reach_; }

  /// There is a triangle at this distance, in the frame.
  void limit_to(double distance) { reach_ = std::min(reach_, reach_of(distance, scale_)); }

  /// The candidates that are left, exactly.
  void measure() {
    for (const Candidate& candidate : std::span(candidates_).first(std::exchange(size_, 0))) {
      if (is_far(candidate.least)) continue;
      const Triangle& triangle = triangles_[candidate.triangle];
      const TriangleHit found{candidate.triangle,
                              nearest_in_triangle(q_, corners_of(*index_, triangle.corners), scale_)};
      if (!precedes(found, nearest_, triangles_)) continue;
      nearest_ = found;
      limit_to(nearest_.at.distance * scale_);
    }
  }

  const IndexView* index_;
  const StoredFaces* faces_;
  const FaceTree* tree_;
  std::span<const Triangle> triangles_;
  double scale_;
  Point q_{};
  Point in_frame_{};
  double reach_ = 0;  // in the frame: what is farther cannot be the nearest
  std::array<Candidate, 16> candidates_{};
  std::size_t size_ = 0;
  TriangleHit nearest_;
};

}  // namespace

SurfacePoint Surface::closest_point(const SpacePoint& point) const {
  const State& state = SurfaceAccess::state(*this);
  check_point(point, "point");
  TaskContext alone;
  return ClosestPoint(*state.index, state.faces(), state.tree(alone)).run({point[0], point[1], point[2]});
}

std::vector<SurfacePoint> Surface::closest_points(std::span<const SpacePoint> points, const Run& run) const {
  std::vector<SurfacePoint> found = make_values<SurfacePoint>(points.size());
  for_each_closest_point(points, [&](std::size_t row, const SurfacePoint& point) { found[row] = point; }, run);
  return found;
}

void Surface::for_each_closest_point(std::span<const SpacePoint> points, const SurfacePointVisitor& visit,
                                     const Run& run) const {
  const State& state = SurfaceAccess::state(*this);
  check_points(points, "points");
  TaskContext task(run.threads, run.progress, points.size());
  const FaceTree& tree = state.tree(task);
  search_along_curve(
      points, state.index->frame, task, [&] { return ClosestPoint(*state.index, state.faces(), tree); }, visit);
}

}  // namespace meshhood::inline v0_1
