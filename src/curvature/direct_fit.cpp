// SPDX-License-Identifier: MIT
#include "curvature/direct_fit.h"

#include <algorithm>
#include <cmath>

#include "base/vector.h"
#include "curvature/packet_moments.h"
#include "exact/index_access.h"
#include "exact/neighbors.h"

namespace meshhood::inline v0_1 {

/// Adds the vertices nearest to the query vertex among those that are linked to the set, one by one; of several the one
/// with the lowest id. No walls and no ignored vertices.
void DirectFit::extend(std::uint32_t place) {
  const IndexView& index = *surface_->index;
  const Point center = surface_->position(place);
  const auto is_barred = [&](std::uint32_t i) { return index.is_wall_at(i) || index.is_ignored_at(i); };
  while (found_.size() < kFewestPoints) {
    std::optional<std::uint32_t> nearest;
    const auto key = [&](std::uint32_t i) {
      return std::pair(squared_distance(surface_->position(i), center), index.id(i));
    };
    for (const std::uint32_t i : found_) {
      for_each_neighbor(index, index.slot_at(i), [&](std::size_t to) {
        const auto other = static_cast<std::uint32_t>(to);
        if (is_barred(other) || std::find(found_.begin(), found_.end(), other) != found_.end()) return;
        if (!nearest || key(other) < key(*nearest)) nearest = other;
      });
    }
    if (!nearest) return;
    found_.push_back(*nearest);
  }
}

void DirectFit::filter(const Point& normal) {
  facing_.clear();
  for (const std::uint32_t i : found_) {
    if (dot(surface_->normal(i), normal) > 0) facing_.push_back(i);
  }
  if (facing_.size() >= kFewestPoints) found_.swap(facing_);
}

/// Returns the factor by which the coordinates were multiplied.
double DirectFit::set_points(std::uint32_t place) {
  const Point center = surface_->position(place);
  const double scale = scale_for(extent_of(*surface_->index, found_, center));
  points_.clear();
  for (const std::uint32_t i : found_) points_.push_back(scale * (surface_->position(i) - center));
  return scale;
}

DirectFit::Result DirectFit::fit(std::uint32_t place, double radius, const TangentFrame& frame) {
  if (!searcher_) searcher_.emplace(*surface_->searched, metric_);
  find_places(*searcher_, *surface_->index, place, radius, found_);
  const std::size_t inside = found_.size();
  const bool is_extended = inside < kFewestPoints;
  if (is_extended) extend(place);
  if (found_.size() < kFewestPoints) return {CurvatureState::TooFew, {}, inside};
  if (options_->filter) filter(frame.n);
  const std::size_t count = is_extended ? inside : found_.size();
  const double scale = set_points(place);
  const auto result = [&](const PointFit& fit, const TangentFrame& axes) -> Result {
    PrincipalCurvature curvature = principal_curvature(fit.quadric, axes, options_->shape_operator);
    curvature.k1 *= scale;
    curvature.k2 *= scale;
    const CurvatureState state = is_extended ? CurvatureState::Extended : CurvatureState::Fitted;
    return {fit.unique ? state : CurvatureState::RankDeficient, curvature, count};
  };
  if (options_->fit == CurvatureFit::Jet) {
    const JetFit jet = fit_jet(points_, frame.n);
    return result(jet.fit, jet.frame);
  }
  for (Point& p : points_) p = {dot(p, frame.u), dot(p, frame.v), dot(p, frame.n)};
  return result(fit_points(points_), frame);
}

/// The factor of all coordinates: a power of two. Of several fits, the one with the smallest coefficients depends
/// on the unit. libigl fits in the unit of the mesh; where squares and coordinates differ too much there, it drops
/// terms.
double DirectFit::scale_for(double extent) const {
  const double scale = unit_factor(extent, surface_->index->frame);
  if (!(extent > 0)) return scale;
  const bool moderate = scale > 0x1p-20 && scale < 0x1p20;
  return options_->shape_operator == ShapeOperator::Libigl && moderate ? 1 : scale;
}

}  // namespace meshhood::inline v0_1
