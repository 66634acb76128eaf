// SPDX-License-Identifier: MIT
#include "io/near_welder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "io/seeded_hash.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();

// The predicate rounds, and squares of less than 2^-500 may vanish. No two vertices are 2^502 apart.
double reach_of(double eps) { return std::clamp(eps * (1 + 0x1p-20), 0x1p-500, 0x1p502); }

// The least power of two beyond four times `reach`.
double width_for(double reach) { return std::ldexp(1.0, std::ilogb(reach) + 3); }

}  // namespace

template <class Real>
NearWelder<Real>::NearWelder(std::vector<Real>& positions, std::vector<std::uint32_t>& ids, std::size_t vertices,
                             double eps)
    : positions_(positions),
      ids_(ids),
      squared_eps_(squared_radius(eps)),
      reach_(reach_of(eps)),
      cell_width_(width_for(reach_)),
      seed_(new_seed(this)),
      newest_(std::bit_ceil(vertices + 1), kEnd) {}

// The lower end of the cell. Exact, because the width is a power of two; it is so large that no quotient overflows.
template <class Real>
double NearWelder<Real>::cell(double coordinate) const {
  return std::floor(coordinate / cell_width_) * cell_width_;
}

// Rounding and `cell` are monotone, so a candidate lies in the cell of `low`, in that of `high`, or between them. Their
// distance is less than a width, so there is none between: where coordinates are at most a quarter of a width apart, it
// is at most twice the reach and a quarter; where they are farther apart, both round to the coordinate itself.
template <class Real>
auto NearWelder<Real>::cells(double coordinate) const -> Cells {
  const double low = coordinate - reach_;
  const double high = coordinate + reach_;
  return {cell(low), cell(high)};
}

template <class Real>
std::size_t NearWelder<Real>::bucket(double x, double y, double z) const {
  const std::uint64_t hash = hash_with(hash_with(hash_with(seed_, x), y), z);
  return static_cast<std::size_t>(hash) & (newest_.size() - 1);
}

// The first in the bucket that is near the point and comes before `before`; else `before`.
template <class Real>
std::uint32_t NearWelder<Real>::first_in(std::size_t bucket, const meshhood::Point& point, std::uint32_t before) const {
  const std::span<const Real> kept(positions_);
  for (std::uint32_t id = newest_[bucket]; id != kEnd; id = older_[id]) {
    if (id < before && squared_distance(meshhood::point(kept, id), point) <= squared_eps_) before = id;
  }
  return before;
}

template <class Real>
std::uint32_t NearWelder<Real>::first_near(const Point& point) const {
  const meshhood::Point center = meshhood::point(std::span<const Real>(point), 0);
  const Cells x = cells(center.x);
  const Cells y = cells(center.y);
  const Cells z = cells(center.z);
  std::uint32_t first = kEnd;
  for (std::size_t i = 0; i < (x[0] == x[1] ? 1U : 2U); ++i) {
    for (std::size_t j = 0; j < (y[0] == y[1] ? 1U : 2U); ++j) {
      for (std::size_t k = 0; k < (z[0] == z[1] ? 1U : 2U); ++k) {
        first = first_in(bucket(x[i], y[j], z[k]), center, first);
      }
    }
  }
  return first;
}

template <class Real>
std::uint32_t NearWelder<Real>::keep(const Point& point) {
  const auto id = static_cast<std::uint32_t>(older_.size());
  positions_.insert(positions_.end(), point.begin(), point.end());
  const meshhood::Point p = meshhood::point(std::span<const Real>(point), 0);
  std::uint32_t& newest = newest_[bucket(cell(p.x), cell(p.y), cell(p.z))];
  older_.push_back(newest);
  newest = id;
  return id;
}

template <class Real>
void NearWelder<Real>::append(const Point& point) {
  const std::uint32_t near = first_near(point);
  ids_.push_back(near == kEnd ? keep(point) : near);
}

template class NearWelder<float>;
template class NearWelder<double>;

}  // namespace meshhood::inline v0_1::io
