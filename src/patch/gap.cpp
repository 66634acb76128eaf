// SPDX-License-Identifier: MIT
// The boxes of the meshlets, the nearest first, but those that the patch has as a whole.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>

#include "base/vector.h"
#include "patch/patches.h"
#include "patch/section.h"
#include "patch/twofold.h"
#include "surface/face_triangles.h"
#include "surface/triangle_point.h"

namespace meshhood {
namespace {

inline double squared_distance(const Point& q, const BoundingBox& box) {
  const auto beyond = [](double x, double low, double high) { return std::max({low - x, x - high, 0.0}); };
  const Point gap{beyond(q.x, box.low.x, box.high.x), beyond(q.y, box.low.y, box.high.y),
                  beyond(q.z, box.low.z, box.high.z)};
  return dot(gap, gap);
}

/// The distance of a triangle from `q`, in twice the precision.
double far_distance(const Point& q, const std::array<Point, 3>& corners, double scale) {
  std::array<RealVector<Twofold>, 3> p{offset_of<Twofold>(corners[0], q, scale),
                                       offset_of<Twofold>(corners[1], q, scale),
                                       offset_of<Twofold>(corners[2], q, scale)};
  const RealVector<Twofold> area = cross(p[1] - p[0], p[2] - p[0]);
  const double size = length(area.round());
  double least = kInfinity;
  bool has_foot = size > 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const RealVector<Twofold> side = p[(i + 1) % 3] - p[i];
    has_foot = has_foot && static_cast<double>(dot(area, cross(p[i], side))) > 0;
    const Twofold square = dot(side, side);
    Twofold share = static_cast<double>(square) > 0 ? Twofold(0) - dot(p[i], side) / square : Twofold(0);
    if (!(static_cast<double>(share) > 0)) share = Twofold(0);
    if (static_cast<double>(share) > 1) share = Twofold(1);
    least = std::min(least, length((p[i] + share * side).round()));
  }
  return (has_foot ? std::abs(static_cast<double>(dot(area, p[0]))) / size : least) / scale;
}

template <class Real>
class GapSearch {
 public:
  GapSearch(const PatchState& state, const FoundPatch& patch, std::span<const Real> xyz)
      : state_(&state), patch_(&patch), xyz_(xyz), ball_(patch.ball()), radius_(patch.radius()) {
    nearest_.distance = kInfinity;
    set_limit(radius_);
  }

  SurfacePoint run() {
    state_->meshlets.boxes.search(
        state_->index->frame.to_frame(ball_.center), [&] { return reach_; },
        [&](std::size_t meshlet) { visit(static_cast<MeshletId>(meshlet)); });
    if (nearest_.distance == kInfinity) return {};
    return surface_point(*state_->index, *state_->faces, state_->triangles.face[triangle_],
                         state_->triangles.corners[triangle_], nearest_);
  }

 private:
  void set_limit(double distance) {
    reach_ = reach_of(distance * ball_.scale, ball_.scale);
    const double limit = reach_ / ball_.scale;
    squared_limit_ = limit * limit;
  }

  void visit(MeshletId meshlet) {
    if (patch_->has_all(meshlet)) return;
    const std::vector<TriangleId>& first = state_->triangles.first_of_meshlet;
    for (TriangleId t = first[meshlet]; t < first[meshlet + std::size_t{1}]; ++t) {
      if (!patch_->has(t)) offer(t);
    }
  }

  void offer(TriangleId t) {
    const auto& places = state_->triangles.corners[t];
    const std::array<Point, 3> corners{point(xyz_, places[0]), point(xyz_, places[1]), point(xyz_, places[2])};
    BoundingBox box;
    for (const Point& corner : corners) box.add(corner);
    if (squared_distance(ball_.center, box) > squared_limit_) return;
    TrianglePoint found = nearest_in_triangle(ball_.center, corners, ball_.scale);
    if (is_far(corners)) found.distance = far_distance(ball_.center, corners, ball_.scale);
    const std::size_t face = state_->triangles.face[t];
    if (found.distance > radius_ || found.distance > nearest_.distance) return;
    if (found.distance == nearest_.distance && state_->triangles.face[triangle_] <= face) return;
    nearest_ = found;
    triangle_ = t;
    set_limit(found.distance);
  }

  [[nodiscard]] bool is_far(const std::array<Point, 3>& corners) const {
    return std::ranges::any_of(
        corners, [&](const Point& p) { return squared_distance(p, ball_.center) > kFar * kFar * radius_ * radius_; });
  }

  const PatchState* state_;
  const FoundPatch* patch_;
  std::span<const Real> xyz_;
  PatchBall ball_;
  double radius_;
  double reach_ = 0;  // in the frame
  double squared_limit_ = 0;
  TrianglePoint nearest_{};
  TriangleId triangle_ = 0;
};

}  // namespace

SurfacePoint FoundPatch::gap() const {
  if (!exists_) return {};
  return std::visit([&](auto xyz) { return GapSearch(*state_, *this, xyz).run(); }, state_->index->positions);
}

}  // namespace meshhood
