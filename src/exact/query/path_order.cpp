// SPDX-License-Identifier: MIT
#include "exact/query/path_order.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace meshhood::inline v0_1 {
namespace {

// So that the number of intervals in a unit of length is finite.
constexpr double kShortestRange = 0x1p-900;

// Intervals with more paths are sorted one by one.
constexpr std::uint32_t kFewPaths = 16;

/// By insertion: for paths that are nearly in order.
void sort_by_insertion(std::span<Path> paths) {
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const Path path = paths[i];
    std::size_t k = i;
    for (; k > 0 && comes_before(path, paths[k - 1]); --k) paths[k] = paths[k - 1];
    paths[k] = path;
  }
}

}  // namespace

std::span<const Path> PathOrder::sorted(const Path& first, std::span<const Path> paths) {
  sorted_.resize(paths.size() + 1);
  sorted_.front() = first;
  const std::span<Path> result = std::span(sorted_).subspan(1);
  double longest = kShortestRange;
  for (const Path& path : paths) longest = std::max(longest, path.length);
  const double scale = static_cast<double>(paths.size()) / longest;
  const auto interval = [&](const Path& path) { return static_cast<std::size_t>(path.length * scale); };
  ends_.assign(paths.size() + 2, 0);  // rounding may lead to the interval after the last
  for (const Path& path : paths) ++ends_[interval(path)];
  std::uint32_t begin = 0;
  std::uint32_t most = 0;
  for (std::uint32_t& end : ends_) {
    most = std::max(most, end);
    begin += std::exchange(end, begin);
  }
  for (const Path& path : paths) result[ends_[interval(path)]++] = path;
  if (most <= kFewPaths) {
    sort_by_insertion(result);
    assert(std::is_sorted(result.begin(), result.end(), comes_before));
    return sorted_;
  }
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const std::size_t from = i == 0 ? 0 : ends_[i - 1];
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(from),
              result.begin() + static_cast<std::ptrdiff_t>(ends_[i]), comes_before);
  }
  assert(std::is_sorted(result.begin(), result.end(), comes_before));
  return sorted_;
}

}  // namespace meshhood::inline v0_1
