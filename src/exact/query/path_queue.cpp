// SPDX-License-Identifier: MIT
#include "exact/query/path_queue.h"

#include <array>
#include <cstdint>

#include "base/limits.h"

namespace meshhood {
namespace {

// So that the number of buckets in a unit of length is finite.
constexpr double kNarrowestBucket = 0x1p-1000;

/// Ties are broken, because standard libraries sort equal elements in different ways.
bool is_before(const Path& a, const Path& b) { return a.length != b.length ? a.length < b.length : a.end < b.end; }
bool is_after(const Path& a, const Path& b) { return is_before(b, a); }

}  // namespace

void PathQueue::clear(double width) {
  width_ = std::max(width, kNarrowestBucket);
  base_ = 0;
  scale_ = 1 / width_;
  buckets_.clear();
  beyond_.clear();
  open_ = 0;
  sorted_.clear();
  late_.clear();
  pushed_count_ = 0;
  least_pushed_ = kInfinity;
}

Path PathQueue::take_first() {
  Path path;
  if (late_.empty() || (!sorted_.empty() && is_before(sorted_.back(), late_.front()))) {
    path = sorted_.back();
    sorted_.pop_back();
  } else {
    path = late_.front();
    std::pop_heap(late_.begin(), late_.end(), is_after);
    late_.pop_back();
  }
  return path;
}

/// Moves the paths that were pushed to where they belong.
void PathQueue::file_pushed() {
  for (std::size_t i = 0; i < pushed_count_; ++i) {
    const Path& path = pushed_[i];
    const double at = position(path.length);
    if (!(at < PathBuckets::kCount)) {
      beyond_.push_back(path);
    } else if (static_cast<std::size_t>(at) == open_) {  // mutant: open-bucket-is-not-sorted-again
      late_.push_back(path);
      std::push_heap(late_.begin(), late_.end(), is_after);
    } else {
      buckets_.add(static_cast<std::size_t>(at), path);
    }
  }
  pushed_count_ = 0;
  least_pushed_ = kInfinity;
}

/// Begins a window with the shortest path beyond the last, whose buckets are empty, and opens its first bucket.
bool PathQueue::begin_window() {
  if (beyond_.empty()) return false;
  const auto [first, last] = std::minmax_element(beyond_.begin(), beyond_.end(), is_before);
  base_ = first->length;
  scale_ = 1 / std::max(width_, (last->length - base_) / (PathBuckets::kCount - 1));
  std::erase_if(beyond_, [&](const Path& path) {
    const double at = position(path.length);
    if (!(at < PathBuckets::kCount)) return false;
    buckets_.add(static_cast<std::size_t>(at), path);
    return true;
  });
  open_ = 0;
  return true;
}

void PathQueue::sort_bucket() {
  if (bucket_.size() <= 4) {
    sort_few<4>();
  } else if (bucket_.size() <= 8) {
    sort_few<8>();
  } else if (bucket_.size() <= 16) {
    sort_few<16>();
  } else {
    sorted_.swap(bucket_);
    std::sort(sorted_.begin(), sorted_.end(), is_after);
  }
}

/// The place of a path is the number of those that are shorter. It is counted without branches, which could not be
/// predicted.
template <std::size_t kMost>
void PathQueue::sort_few() {
  std::array<double, kMost> lengths;
  lengths.fill(-1);  // shorter than any path
  for (std::size_t i = 0; i < bucket_.size(); ++i) lengths[i] = bucket_[i].length;
  std::array<std::uint32_t, kMost> longer{};
  for (std::size_t i = 1; i < kMost; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const std::uint32_t is_longer = lengths[i] >= lengths[k] ? 1 : 0;
      longer[k] += is_longer;
      longer[i] += 1 - is_longer;
    }
  }
  sorted_.resize(bucket_.size());
  for (std::size_t i = 0; i < bucket_.size(); ++i) sorted_[longer[i]] = bucket_[i];
}

}  // namespace meshhood
