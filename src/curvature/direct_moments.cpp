// SPDX-License-Identifier: MIT
#include "curvature/direct_moments.h"

#include <algorithm>
#include <cmath>

#include "base/vector.h"
#include "curvature/packet_moments.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

Point DirectMoments::offset(std::uint32_t i, const Point& center) const { return source_.index->position(i) - center; }

/// Powers of two that bring the longest offset and the largest weight of the neighborhood to about 1.
void DirectMoments::set_units(const Point& center) {
  double extent = 0;
  double weight = 0;
  for (const std::uint32_t i : found_) {
    const Point p = source_.index->frame.scale * offset(i, center);
    extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!source_.weights.empty()) weight = std::max(weight, source_.weights[i]);
  }
  scale_ = unit_factor(extent, source_.index->frame);
  weight_exponent_ = weight > 0 ? -std::ilogb(weight) : 0;
}

void DirectMoments::sum(std::uint32_t place, double radius) {
  if (!searcher_) searcher_.emplace(*searched_, source_.metric);
  find_places(*searcher_, *source_.index, place, radius, found_);
  const Point center = offset(place, {0, 0, 0});
  set_units(center);
  PaddedMoments sums{};
  for (std::size_t begin = 0; begin < found_.size(); begin += kLeafCapacity) {
    const std::size_t size = std::min<std::size_t>(found_.size() - begin, kLeafCapacity);
    for (std::size_t k = 0; k < size; ++k) {
      const std::uint32_t i = found_[begin + k];
      points_.set(k, scale_ * offset(i, center),
                  source_.weights.empty() ? 1 : std::ldexp(source_.weights[i], weight_exponent_));
    }
    for (std::size_t k = size; k % 8 != 0; ++k) points_.set(k, {0, 0, 0}, 0);
    PaddedMoments some;
    moment_kernels(best_isa()).sum(points_, size, some);
    add(sums, some);
  }
  for (std::size_t m = 0; m < kMomentCount; ++m) moments_.at[m][0] = sums.at[m];
}

}  // namespace meshhood::inline v0_1
