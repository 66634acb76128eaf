// SPDX-License-Identifier: MIT
#include "exact/query/path_queue.h"

#include <algorithm>

namespace meshhood::inline v0_1 {
namespace {

// So that the number of buckets in a unit of length is finite.
constexpr double kNarrowestBucket = 0x1p-1000;

bool is_shorter(const Path& a, const Path& b) { return a.length < b.length; }

}  // namespace

void PathQueue::clear(double width) {
  width_ = std::max(width, kNarrowestBucket);
  base_ = 0;
  scale_ = 1 / width_;
  buckets_.clear();
  beyond_.clear();
  open_ = 0;
}

bool PathQueue::open() {
  open_ = buckets_.find_from(open_);
  if (open_ == PathBuckets::kCount) {
    if (beyond_.empty()) return false;
    begin_window();
  }
  return true;
}

/// Begins a window with the shortest path beyond the last, whose buckets are empty.
void PathQueue::begin_window() {
  const auto [first, last] = std::minmax_element(beyond_.begin(), beyond_.end(), is_shorter);
  base_ = first->length;
  scale_ = 1 / std::max(width_, (last->length - base_) / (PathBuckets::kCount - 1));
  open_ = 0;
  std::erase_if(beyond_, [&](const Path& path) {
    const double at = position(path.length);
    if (!(at < PathBuckets::kCount)) return false;
    buckets_.add(static_cast<std::size_t>(at), path);
    return true;
  });
}

}  // namespace meshhood::inline v0_1
