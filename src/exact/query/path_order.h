// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/query/path_queue.h"

namespace meshhood::inline v0_1 {

[[nodiscard]] inline bool comes_before(const Path& a, const Path& b) {
  return a.length != b.length ? a.length < b.length : a.end < b.end;
}

/// Sorts paths by length, then by their ends: by counting those of equal intervals of length, of which there are as
/// many as paths. Takes linear time if the lengths are spread about evenly, as those of shortest paths are, and O(n log
/// n) otherwise.
class PathOrder {
 public:
  /// The paths in order, after `first`, which stays the first. Their lengths are finite, and not negative. Valid until
  /// the next call.
  [[nodiscard]] std::span<const Path> sorted(const Path& first, std::span<const Path> paths);

 private:
  std::vector<Path> sorted_;
  std::vector<std::uint32_t> ends_;  // by interval
};

}  // namespace meshhood::inline v0_1
