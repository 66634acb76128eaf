// SPDX-License-Identifier: MIT
#include "io/welder.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1::io {
namespace {

// A hash of coordinates that differs from run to run.

std::uint64_t mixed(std::uint64_t word) {
  word *= 0x9e3779b97f4a7c15U;
  return word ^ (word >> 32U);
}

// Not known before the program runs: the time, and where the system has put `place` in memory.
std::uint64_t new_seed(const void* place) {
  const auto time = static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
  return mixed(time ^ mixed(reinterpret_cast<std::uintptr_t>(place)));
}

// -0 has the hash of 0.
std::uint64_t hash_with(std::uint64_t hash, double coordinate) {
  return mixed(hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0));  // -0 + 0 is 0
}

constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kFirstBuckets = std::size_t{1} << 12;

// The predicate rounds, and squares of less than 2^-500 may vanish. No two vertices are 2^502 apart.
double reach_of(double eps) { return std::clamp(eps * (1 + 0x1p-20), 0x1p-500, 0x1p502); }

// The least power of two beyond four times `reach`.
double width_for(double reach) { return std::ldexp(1.0, std::ilogb(reach) + 3); }

bool are_equal(const Point& p, const Point& q) { return p.x == q.x && p.y == q.y && p.z == q.z; }

}  // namespace

template <class Real>
Welder<Real>::Welder(std::vector<Real>& positions, std::vector<std::uint32_t>& ids, std::string file, double eps)
    : positions_(positions),
      ids_(ids),
      file_(std::move(file)),
      is_exact_(eps == 0),
      squared_eps_(squared_radius(eps)),
      reach_(reach_of(eps)),
      cell_width_(width_for(reach_)),
      seed_(new_seed(this)),
      newest_(kFirstBuckets, kEnd) {}

template <class Real>
void Welder<Real>::expect(std::size_t vertices) {
  older_.reserve(vertices);
  const std::size_t buckets = std::bit_ceil(vertices);
  if (buckets > newest_.size()) resize(buckets);
}

// The lower end of the cell. Exact, because the width is a power of two; it is so large that no quotient overflows.
template <class Real>
double Welder<Real>::cell(double coordinate) const {
  return is_exact_ ? coordinate : std::floor(coordinate / cell_width_) * cell_width_;
}

// Rounding and `cell` are monotone, so a candidate lies in the cell of `low`, in that of `high`, or between them. Their
// distance is less than a width, so there is none between: where coordinates are at most a quarter of a width apart, it
// is at most twice the reach and a quarter; where they are farther apart, both round to the coordinate itself.
template <class Real>
auto Welder<Real>::cells(double coordinate) const -> Cells {
  const double low = coordinate - reach_;
  const double high = coordinate + reach_;
  return {cell(low), cell(high)};
}

template <class Real>
std::size_t Welder<Real>::bucket(double x, double y, double z) const {
  const std::uint64_t hash = hash_with(hash_with(hash_with(seed_, x), y), z);
  return static_cast<std::size_t>(hash) & (newest_.size() - 1);
}

// The first in the bucket that is near the point and comes before `before`; else `before`.
template <class Real>
std::uint32_t Welder<Real>::first_in(std::size_t bucket, const meshhood::Point& point, std::uint32_t before) const {
  for (std::uint32_t id = newest_[bucket]; id != kEnd; id = older_[id]) {
    const meshhood::Point other = kept(id);
    if (is_exact_ && are_equal(other, point)) return id;  // there is no other
    if (!is_exact_ && id < before && squared_distance(other, point) <= squared_eps_) before = id;
  }
  return before;
}

template <class Real>
std::uint32_t Welder<Real>::first_near(const meshhood::Point& point) const {
  if (is_exact_) return first_in(bucket(point.x, point.y, point.z), point, kEnd);
  const Cells x = cells(point.x);
  const Cells y = cells(point.y);
  const Cells z = cells(point.z);
  std::uint32_t first = kEnd;
  for (std::size_t i = 0; i < (x[0] == x[1] ? 1U : 2U); ++i) {
    for (std::size_t j = 0; j < (y[0] == y[1] ? 1U : 2U); ++j) {
      for (std::size_t k = 0; k < (z[0] == z[1] ? 1U : 2U); ++k) {
        first = first_in(bucket(x[i], y[j], z[k]), point, first);
      }
    }
  }
  return first;
}

template <class Real>
std::uint32_t Welder<Real>::keep(const Point& point) {
  const auto id = static_cast<std::uint32_t>(older_.size());
  if (id == kMaxVertices) raise(ErrorCode::TooLarge, fmt::format("{}: more than {} vertices", file_, kMaxVertices));
  positions_.insert(positions_.end(), point.begin(), point.end());
  older_.push_back(kEnd);
  if (older_.size() > newest_.size()) {
    resize(2 * newest_.size());
  } else {
    list(id);
  }
  return id;
}

// Makes a kept vertex the newest of its bucket.
template <class Real>
void Welder<Real>::list(std::uint32_t id) {
  const meshhood::Point p = kept(id);
  older_[id] = std::exchange(newest_[bucket(cell(p.x), cell(p.y), cell(p.z))], id);
}

// The old table is freed before there is a new one, so that both are never in memory.
template <class Real>
void Welder<Real>::resize(std::size_t buckets) {
  std::vector<std::uint32_t>().swap(newest_);
  newest_.resize(buckets, kEnd);
  for (std::uint32_t id = 0; id < older_.size(); ++id) list(id);
}

template <class Real>
void Welder<Real>::append(const Point& point) {
  const std::uint32_t near = first_near({double{point[0]}, double{point[1]}, double{point[2]}});
  ids_.push_back(near == kEnd ? keep(point) : near);
}

template class Welder<float>;
template class Welder<double>;

}  // namespace meshhood::inline v0_1::io
