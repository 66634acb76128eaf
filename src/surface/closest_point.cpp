// SPDX-License-Identifier: MIT
// Finds the point of a surface nearest to a point in space.

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
#include "shared/text.h"
#include "surface/face_tree.h"
#include "surface/face_triangles.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

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

  void compare(std::size_t i) {
    const RoughDistance rough = compare_roughly(corners_in_frame(*index_, triangles_[i].corners), in_frame_);
    if (is_far(rough.least)) return;
    limit_to(std::sqrt(rough.square));
    if (size_ == candidates_.size()) measure();
    candidates_[size_++] = {i, rough.least};
  }

  [[nodiscard]] bool is_far(double least) const { return least > reach_ * reach_; }

  /// Notes that there is a triangle at this distance, in the frame.
  void limit_to(double distance) { reach_ = std::min(reach_, reach_of(distance, scale_)); }

  /// Measures exactly the candidates that are left.
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
  check_function(visit, "visit");
  const State& state = SurfaceAccess::state(*this);
  check_points(points, "points");
  TaskContext task(run.threads, run.progress, points.size());
  const FaceTree& tree = state.tree(task);
  search_along_curve(
      points, state.index->frame, task, [&] { return ClosestPoint(*state.index, state.faces(), tree); }, visit);
}

}  // namespace meshhood::inline v0_1
