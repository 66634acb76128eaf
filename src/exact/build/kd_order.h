// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/parallel.h"

namespace meshhood {

struct KdPoint {
  std::array<float, 3> at;
  std::uint32_t id;
};

/// Reorders `points` so that every `unit` consecutive ones, counted from the first, lie close together: cuts the set
/// across the widest side of its bounding box, at the multiple of `unit` nearest to the middle from below, and
/// continues with both halves. Ties are broken by id, so the sets of `unit` points do not depend on the order given;
/// the order within each does. O(n log(n / unit)).
void kd_order(std::span<KdPoint> points, std::size_t unit);

/// The same on several threads, with the same result. Throws Error{Cancelled}.
void kd_order(std::span<KdPoint> points, std::size_t unit, TaskContext& task);

/// Reorders `points` so that this holds for every power of `fan_out` as the unit. O(n log n).
void kd_order_nested(std::span<KdPoint> points, std::size_t fan_out);

}  // namespace meshhood
