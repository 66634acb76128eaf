// SPDX-License-Identifier: MIT
#include "exact/query/path_order.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace meshhood {
namespace {

// So that the number of intervals in a unit of length is finite.
constexpr double kShortestRange = 0x1p-900;

bool is_before(const Path& a, const Path& b) { return a.length != b.length ? a.length < b.length : a.end < b.end; }

/// By insertion, if there are few.
void sort_few(std::span<Path> paths) {
  constexpr std::size_t kFew = 16;
  if (paths.size() > kFew) {
    std::sort(paths.begin(), paths.end(), is_before);
    return;
  }
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const Path path = paths[i];
    std::size_t k = i;
    for (; k > 0 && is_before(path, paths[k - 1]); --k) paths[k] = paths[k - 1];
    paths[k] = path;
  }
}

}  // namespace

void PathOrder::sort(std::span<Path> paths) {
  double longest = kShortestRange;
  for (const Path& path : paths) longest = std::max(longest, path.length);
  const double scale = static_cast<double>(paths.size()) / longest;
  const auto interval = [&](const Path& path) { return static_cast<std::size_t>(path.length * scale); };
  unsorted_.assign(paths.begin(), paths.end());
  ends_.assign(paths.size() + 2, 0);  // rounding may lead to the interval after the last
  for (const Path& path : unsorted_) ++ends_[interval(path)];
  std::uint32_t begin = 0;
  for (std::uint32_t& end : ends_) begin += std::exchange(end, begin);
  for (const Path& path : unsorted_) paths[ends_[interval(path)]++] = path;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const std::size_t first = i == 0 ? 0 : ends_[i - 1];
    sort_few(paths.subspan(first, ends_[i] - first));
  }
}

}  // namespace meshhood
