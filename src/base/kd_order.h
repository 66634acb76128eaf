// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shared/distance.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

struct KdPoint {
  std::array<float, 3> at;
  std::uint32_t id;
};

/// Rounds to the nearest floats.
[[nodiscard]] inline KdPoint kd_point(const Point& p, std::size_t id) {
  return {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, static_cast<std::uint32_t>(id)};
}

/// The place where a set of n points is cut.
enum class KdCut {
  Middle,  // after half of the units, rounded down; the last of them may be short
  Power,   // at the largest power of two of units below n, so that each such number of units lies close together
};

/// Reorders `points` so that every `unit` consecutive ones, counted from the first, lie close together: cuts the set
/// across the widest side of its bounding box, and continues with both parts. Ties are broken by id, and each `unit`
/// points are in ascending order of ids, so the result does not depend on the order given, nor on the number of
/// threads. Throws Error{Cancelled}. O(n log(n / unit)).
///
/// unit  at most 32
void kd_order(std::span<KdPoint> points, std::size_t unit, TaskContext& task, KdCut where = KdCut::Middle);

}  // namespace meshhood::inline v0_1
