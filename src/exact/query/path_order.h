// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/query/path_buckets.h"

namespace meshhood {

/// Sorts paths by length, then by their ends: by counting those of equal intervals of length, of which there are as
/// many as paths. Takes linear time if the lengths are spread about evenly, as those of shortest paths are, and O(n log
/// n) otherwise.
class PathOrder {
 public:
  /// The lengths are finite, and not negative.
  void sort(std::span<Path> paths);

 private:
  std::vector<Path> unsorted_;
  std::vector<std::uint32_t> ends_;  // by interval
};

}  // namespace meshhood
