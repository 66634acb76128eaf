// SPDX-License-Identifier: MIT
#include "patch/search.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/vector.h"

namespace meshhood::inline v0_1 {

PatchSearch::PatchSearch(const PatchState& state)
    : state_(&state),
      inside_(state.index->vertex_count()),
      seen_(state.triangles.size()),
      kinds_(state.meshlets.size()) {}

std::vector<TriangleId> PatchSearch::triangles() const {
  const Triangles& all = state_->triangles;
  const auto seen = std::span(triangles_).first(seen_count_);
  std::vector<TriangleId> result(seen.begin(), seen.end());
  for (const MeshletId meshlet : meshlets_) {
    for (const TriangleId t : all.of_meshlet(meshlet)) result.push_back(t);
  }
  std::ranges::sort(result, {}, [&](TriangleId t) { return std::pair(all.face[t], t); });
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// A meshlet is whole if its bounding sphere or its box lies in the ball.
inline PatchSearch::Kind PatchSearch::kind_of(MeshletId meshlet) {
  constexpr double kDipSlack = 0x1p-46;
  if (kinds_.is_known(meshlet)) return kinds_[meshlet];
  const Meshlet& sums = state_->meshlets.meshlets[meshlet];
  const double distance = ball_.scale * length(sums.center() - ball_.center);
  const double inner = ball_.radius * (1 - kDipSlack);
  bool is_whole = distance + sums.radius <= inner;
  if (!is_whole && distance < inner) {
    const Point low = ball_.center - sums.box.low;
    const Point high = sums.box.high - ball_.center;
    const Point far{std::max(low.x, high.x), std::max(low.y, high.y), std::max(low.z, high.z)};
    is_whole = ball_.scale * length(far) <= inner;
  }
  return kinds_.set(meshlet, is_whole ? Kind::Whole : Kind::Partial);
}

/// There is no branch on what was seen before, because it could not be predicted.
inline void PatchSearch::visit(TriangleId t) {
  if (seen_count_ == triangles_.size()) triangles_.resize(2 * seen_count_ + 64);
  triangles_[seen_count_] = t;
  seen_count_ += static_cast<std::size_t>(!seen_.has(t));
  seen_.add(t);
}

inline void PatchSearch::enter(std::uint32_t place) {
  inside_.add(place);
  for (const TriangleId t : state_->triangles.fans[place]) visit(t);
}

/// Steps from the triangles seen and the meshlets taken until there are no more.
template <class Real>
void PatchSearch::spread(std::span<const Real> xyz) {
  std::size_t next_meshlet = 0;
  for (std::size_t next = 0; next < seen_count_ || next_meshlet < meshlets_.size();) {
    if (next == seen_count_) {
      leave(meshlets_[next_meshlet++]);
      continue;
    }
    const TriangleId t = triangles_[next++];
    const MeshletId meshlet = state_->triangles.meshlet_of(t);
    const Kind kind = kind_of(meshlet);
    if (kind == Kind::Whole) take(meshlet);
    if (kind != Kind::Partial) continue;
    PatchTriangle triangle{{}, state_->triangles.corners[t], {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t place = triangle.places[i];
      triangle.corners[i] = point(xyz, place);
      if (!inside_.has(place) && ball_.contains(triangle.corners[i])) enter(place);
      triangle.inside[i] = inside_.has(place);
    }
    if (triangle.inside[0] && triangle.inside[1] && triangle.inside[2]) {
      if (measures_) add_whole(t, triangle);
    } else {
      add_cut(t, triangle);
    }
  }
}

void PatchSearch::run(const Point& center, double radius, std::span<const TriangleId> starts, bool measures) {
  ball_ = patch_ball(center, radius, state_->index->frame.scale);
  measures_ = measures;
  kinds_.forget();
  inside_.forget();
  seen_.forget();
  seen_count_ = 0;
  meshlets_.clear();
  sums_.clear(state_->triangles.normal_of(*state_->index, starts));
  for (const TriangleId t : starts) visit(t);
  std::visit([&](auto xyz) { spread(xyz); }, state_->index->positions);
}

void PatchSearch::take(MeshletId meshlet) {
  kinds_[meshlet] = Kind::Taken;
  meshlets_.push_back(meshlet);
  const Meshlet& sums = state_->meshlets.meshlets[meshlet];
  const Point offset = ball_.scale * (sums.center() - ball_.center);
  sums_.add_whole(sums.area, sums.moment + dot(sums.vector_area, offset));
  if (sums.has_border) sums_.meet_border();
}

/// Enters the corners of a taken meshlet, all of which are in the ball.
void PatchSearch::leave(MeshletId meshlet) {
  for (const std::uint32_t place : state_->meshlets.corners[meshlet]) {
    if (!inside_.has(place)) enter(place);
  }
}

void PatchSearch::add_whole(TriangleId t, const PatchTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const Point area = 0.5 * cross(ball_.scale * (b - a), ball_.scale * (c - a));
  sums_.add_whole(length_without_underflow(area), dot(area, ball_.scale * (a - ball_.center)));
  if (state_->triangles.has_border(t)) sums_.meet_border();
}

void PatchSearch::add_cut(TriangleId t, const PatchTriangle& triangle) {
  ClippedTriangle clipped(ball_, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    if (clipped.dips(i)) state_->triangles.for_each_beside(t, i, [&](TriangleId other) { visit(other); });
    if (clipped.meets(i) && state_->triangles.is_border(t, static_cast<unsigned>(i))) sums_.meet_border();
  }
  if (measures_ && std::isfinite(ball_.unit)) clipped.add_to(sums_);  // else the radius is almost 0
}

}  // namespace meshhood::inline v0_1
