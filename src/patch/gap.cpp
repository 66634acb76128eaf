// SPDX-License-Identifier: MIT
// Searches the meshlets, the nearest first, but not those that the patch has as a whole.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "base/vector.h"
#include "patch/clipped_triangle.h"
#include "patch/packet_patches.h"
#include "patch/search.h"
#include "patch/twofold.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns the distance of a triangle from `q`, in twice the precision.
double far_distance(const Point& q, const std::array<Point, 3>& corners, double scale) {
  std::array<RealVector<Twofold>, 3> p{offset_of<Twofold>(corners[0], q, scale),
                                       offset_of<Twofold>(corners[1], q, scale),
                                       offset_of<Twofold>(corners[2], q, scale)};
  const RealVector<Twofold> area = cross(p[1] - p[0], p[2] - p[0]);
  const double size = length(in_double(area));
  double least = kInfinity;
  bool has_foot = size > 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const RealVector<Twofold> side = p[(i + 1) % 3] - p[i];
    has_foot = has_foot && static_cast<double>(dot(area, cross(p[i], side))) > 0;
    const Twofold square = dot(side, side);
    Twofold share = static_cast<double>(square) > 0 ? Twofold(0) - dot(p[i], side) / square : Twofold(0);
    if (!(static_cast<double>(share) > 0)) share = Twofold(0);
    if (static_cast<double>(share) > 1) share = Twofold(1);
    least = std::min(least, length(in_double(p[i] + share * side)));
  }
  return (has_foot ? std::abs(static_cast<double>(dot(area, p[0]))) / size : least) / scale;
}

/// Finds the nearest triangles that patches do not have. Compares a triangle with all centers of a packet at once, as
/// they are close. Leaves out only what surely is too far, so the order of triangles changes no answer.
template <class Patches>
class GapSearch {
 public:
  GapSearch(const PatchState& state, const Patches& patches, QueryWord queries)
      : state_(&state), patches_(&patches), queries_(queries), scale_(state.index->frame.scale) {
    const auto center = [&](std::size_t q) { return state.index->frame.to_frame(patches.ball(q).center); };
    BoundingBox around;
    for_each_query(queries, [&](std::size_t q) { around.add(center(q)); });
    middle_ = 0.5 * around.low + 0.5 * around.high;
    for_each_query(queries, [&](std::size_t q) {
      centers_.set(q, scale_ * patches.ball(q).center);
      off_middle_[q] = length(center(q) - middle_);
      limit_to(q, radius(q));
    });
  }

  /// Writes the gaps of the queries.
  void run(std::span<SurfacePoint> gaps) {
    std::visit(
        [&](auto xyz) {
          state_->meshlets.boxes.search(
              middle_, [&] { return reach(); },
              [&](std::size_t meshlet) { visit(static_cast<MeshletId>(meshlet), xyz); });
        },
        state_->index->positions);
    for_each_query(queries_, [&](std::size_t q) {
      const auto& [t, at] = nearest_[q];
      if (at.distance == kInfinity) return;
      const Triangles& all = state_->triangles;
      gaps[q] = surface_point(*state_->index, *state_->faces, all.face[t], all.corners[t], at);
    });
  }

 private:
  [[nodiscard]] double radius(std::size_t q) const { return patches_->ball(q).radius / scale_; }

  void limit_to(std::size_t q, double distance) {
    reaches_[q] = reach_of(distance * scale_, scale_);
    squared_reaches_[q] = reaches_[q] * reaches_[q];
  }

  /// Returns how far the queries reach from the middle.
  [[nodiscard]] double reach() const {
    double most = 0;
    for_each_query(queries_, [&](std::size_t q) { most = std::max(most, off_middle_[q] + reaches_[q]); });
    return most;
  }

  template <class Real>
  void visit(MeshletId meshlet, std::span<const Real> xyz) {
    const QueryWord queries = may_reach(meshlet) & ~patches_->having_all(meshlet);
    if (queries == 0) return;
    for (const TriangleId t : state_->triangles.of_meshlet(meshlet)) {
      if (const QueryWord others = queries & ~patches_->having(t); others != 0) compare(t, others, xyz);
    }
  }

  /// Returns the queries that may reach a meshlet.
  [[nodiscard]] QueryWord may_reach(MeshletId meshlet) const {
    const Meshlet& sums = state_->meshlets.meshlets[meshlet];
    const Point center = scale_ * sums.center();
    QueryWord may = 0;
    for_each_query(queries_, [&](std::size_t q) {
      const double limit = reaches_[q] + sums.radius;
      if (squared_distance(center, centers_.at(q)) <= limit * limit) may |= QueryWord{1} << q;
    });
    return may;
  }

  template <class Real>
  void compare(TriangleId t, QueryWord queries, std::span<const Real> xyz) {
    const auto& places = state_->triangles.corners[t];
    const std::array<Point, 3> corners{point(xyz, places[0]), point(xyz, places[1]), point(xyz, places[2])};
    const std::array<Point, 3> scaled{scale_ * corners[0], scale_ * corners[1], scale_ * corners[2]};
    for_each_query(kernels_->may_reach(scaled, queries, centers_, squared_reaches_), [&](std::size_t q) {
      if (!patches_->has(q, t)) offer(q, t, corners);
    });
  }

  void offer(std::size_t q, TriangleId t, const std::array<Point, 3>& corners) {
    const Point& center = patches_->ball(q).center;
    TrianglePoint found = nearest_in_triangle(center, corners, scale_);
    if (is_far(q, corners)) found.distance = far_distance(center, corners, scale_);
    TriangleHit& nearest = nearest_[q];
    if (found.distance > radius(q) || found.distance > nearest.at.distance) return;
    const std::vector<std::uint32_t>& face = state_->triangles.face;
    if (found.distance == nearest.at.distance && face[nearest.triangle] <= face[t]) return;
    nearest = {t, found};
    limit_to(q, found.distance);
  }

  [[nodiscard]] bool is_far(std::size_t q, const std::array<Point, 3>& corners) const {
    const double far = kFar * radius(q);
    const Point& center = patches_->ball(q).center;
    return std::ranges::any_of(corners, [&](const Point& p) { return squared_distance(p, center) > far * far; });
  }

  const PatchState* state_;
  const Patches* patches_;
  const PatchKernels* kernels_ = &patch_kernels(best_isa());
  QueryWord queries_;
  double scale_;
  Point middle_{};                  // of the centers, in the frame
  PointPerLane<double> centers_{};  // times the scale
  PerLane<double> off_middle_{};    // how far the centers are from there, in the frame
  PerLane<double> reaches_{};       // in the frame: no triangle farther away is the nearest
  PerLane<double> squared_reaches_{};
  std::array<TriangleHit, kPacketCapacity> nearest_;
};

}  // namespace

SurfacePoint PatchSearch::gap() const {
  SurfacePoint gap;
  if (exists()) GapSearch(*state_, *this, 1).run({&gap, 1});
  return gap;
}

const SurfacePoint& PacketPatches::gap(std::size_t query) {
  if (gaps_.empty()) {
    gaps_.resize(kPacketCapacity);
    GapSearch(*state_, *this, queries_ & met_).run(gaps_);
  }
  return gaps_[query];
}

}  // namespace meshhood::inline v0_1
