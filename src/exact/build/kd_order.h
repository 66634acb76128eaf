// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/parallel.h"

namespace meshhood {

/// A point to be put in order, and whose it is.
struct Site {
  std::array<float, 3> at;
  std::uint32_t id;
};

/// Reorders `sites` so that every `unit` consecutive ones, counted from the first, lie close together: cuts across the
/// widest side, at a multiple of `unit` near the middle, and so on. Which sites come together is the same for any
/// order in which they are given. O(n log(n / unit)).
void kd_order(std::span<Site> sites, std::size_t unit);

/// The same on several threads.
void kd_order(std::span<Site> sites, std::size_t unit, TaskContext& task);

/// Reorders `sites` so that this holds for runs of every power of `fan_out`.
void kd_order_nested(std::span<Site> sites, std::size_t fan_out);

}  // namespace meshhood
