// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace meshhood {

/// A directed segment between two points, given by their numbers.
struct Segment {
  std::uint32_t from;
  std::uint32_t to;
};

/// A chain of points, each joined to the next; of a loop also the last to the first.
struct Polyline {
  std::vector<std::uint32_t> points;
  bool is_closed;
};

/// Joins segments into the longest polylines that end only at points of which the number of segments is not two. A
/// polyline has the direction of its first segment. `points` is the number of points.
[[nodiscard]] std::vector<Polyline> join_segments(std::span<const Segment> segments, std::size_t points);

}  // namespace meshhood
