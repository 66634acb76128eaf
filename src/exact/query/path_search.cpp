// SPDX-License-Identifier: MIT
#include "exact/query/path_search.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <utility>

namespace meshhood::inline v0_1 {
namespace {

// With this, the number of buckets in a unit of length is finite.
constexpr double kNarrowestBucket = 0x1p-1000;

bool is_shorter(const Path& a, const Path& b) { return a.length < b.length; }

// Buckets are so narrow that few paths become shorter in their bucket, and so wide that most buckets have paths.
constexpr double kBucketsPerEdge = 8;

constexpr double kUnreached = kInfinity;

// No path is shorter.
constexpr double kWall = -1;

bool is_longer(const Path& a, const Path& b) { return a.length > b.length; }

// With this, the number of intervals in a unit of length is finite.
constexpr double kShortestRange = 0x1p-900;

// Intervals with more paths are sorted one by one.
constexpr std::uint32_t kFewPaths = 16;

/// Sorts paths that are nearly in order.
void sort_by_insertion(std::span<Path> paths) {
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const Path path = paths[i];
    std::size_t k = i;
    for (; k > 0 && comes_before(path, paths[k - 1]); --k) paths[k] = paths[k - 1];
    paths[k] = path;
  }
}

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

PathSearch::PathSearch(const IndexView& index, KeptGraph& graph)
    : index_(&index),
      graph_(&graph.paths_of(index)),
      edges_(graph_->edges.get()),
      lengths_(index.vertex_count(), kUnreached) {}

void PathSearch::begin(std::span<const Path> starts, double radius) {
  forget();
  is_complete_ = false;
  radius_ = radius;
  queue_.clear(starts.empty() ? 0 : mean_length_near(starts.front().end) / kBucketsPerEdge);
  for (const Path& start : starts) {
    if (index_->is_wall_at(start.end) || !(start.length <= radius) || lengths_[start.end] <= start.length) continue;
    lengths_[start.end] = start.length;
    queue_.push(start);
  }
}

/// Empties the queue, and notes the vertices whose lengths `forget` must clear.
void PathSearch::abandon() {
  while (queue_.open()) {
    queue_.take([this](const Path& path) { left_.push_back(path.end); });
  }
}

void PathSearch::forget() {
  if (is_complete_) {
    for (const Path& path : found_) lengths_[path.end] = kUnreached;
    for (const std::uint32_t vertex : left_) lengths_[vertex] = kUnreached;
  } else {
    std::fill(lengths_.begin(), lengths_.end(), kUnreached);
  }
  is_complete_ = true;
  found_.clear();
  left_.clear();
  shorter_count_ = 0;
  steps_ = 0;
}

/// Returns the mean of the lengths of some edges near a vertex; 0 if there are none.
double PathSearch::mean_length_near(std::uint32_t vertex) const {
  constexpr std::size_t kMost = 128;
  const std::span<const double> after = std::span(graph_->lengths).subspan(edges_->offsets[vertex]);
  const std::span<const double> some = after.first(std::min(after.size(), kMost));
  return some.empty() ? 0 : std::accumulate(some.begin(), some.end(), 0.0) / static_cast<double>(some.size());
}

void PathSearch::search_open_bucket() {
  const auto begin = static_cast<std::ptrdiff_t>(found_.size());
  int rounds = 0;
  for (; take_round(); ++rounds) {
    if (rounds < kRounds) {
      follow_round();
    } else {
      follow_in_order();
    }
  }
  if (rounds < 2) return;
  const auto is_longer_than_least = [this](const Path& path) { return !is_least(path); };
  found_.erase(std::remove_if(found_.begin() + begin, found_.end(), is_longer_than_least), found_.end());
}

/// Takes the shortest paths to their ends from the open bucket. Returns whether there are any.
bool PathSearch::take_round() {
  std::size_t count = 0;
  queue_.take([&](const Path& path) {
    if (round_.size() == count) round_.resize(2 * count + 1);
    // Whether it is the shortest cannot be predicted, so there is no branch.
    round_[count] = path;
    count += is_least(path) ? 1 : 0;
    prefetch_edges(path.end);
  });
  round_count_ = count;
  return count != 0;
}

void PathSearch::prefetch_edges(std::uint32_t vertex) const {
  const std::size_t begin = edges_->offsets[vertex];
  fetch_lines(edges_->neighbors.data() + begin, 1);
  fetch_lines(graph_->lengths.data() + begin, 2);
}

void PathSearch::follow_round() {
  for (const Path& path : std::span(round_).first(round_count_)) {
    if (is_least(path)) follow(path);
  }
  push_shorter();
}

/// Follows the rest of the open bucket, the shortest path first, as in the algorithm of Dijkstra.
void PathSearch::follow_in_order() {
  round_.resize(round_count_);
  std::make_heap(round_.begin(), round_.end(), is_longer);
  while (!round_.empty()) {
    std::pop_heap(round_.begin(), round_.end(), is_longer);
    const Path path = round_.back();
    round_.pop_back();
    if (!is_least(path)) continue;
    follow(path);
    push_shorter();
    queue_.take([this](const Path& late) {
      round_.push_back(late);
      std::push_heap(round_.begin(), round_.end(), is_longer);
    });
  }
}

void PathSearch::follow(const Path& path) {
  ++steps_;
  found_.push_back(path);
  const std::size_t begin = edges_->offsets[path.end];
  const std::size_t end = edges_->offsets[path.end + std::size_t{1}];
  if (shorter_.size() < shorter_count_ + (end - begin)) shorter_.resize(2 * (shorter_count_ + (end - begin)));
  const VertexId* const neighbors = edges_->neighbors.data();
  const double* const edges = graph_->lengths.data();
  double* const lengths = lengths_.data();
  const double from = path.length;
  Path* shorter = shorter_.data() + shorter_count_;
  // Whether a path is shorter than those before cannot be predicted, so there is no branch.
  for (std::size_t i = begin; i < end; ++i) {
    const VertexId neighbor = neighbors[i];
    const double length = from + edges[i];
    const double before = lengths[neighbor];
    lengths[neighbor] = std::min(before, length);
    *shorter = {length, neighbor};
    shorter += length < before ? 1 : 0;
  }
  shorter_count_ = static_cast<std::size_t>(shorter - shorter_.data());
}

void PathSearch::push_shorter() {
  for (const Path& path : std::span(shorter_).first(shorter_count_)) {
    if (!(path.length <= radius_)) {
      left_.push_back(path.end);
    } else if (index_->is_wall_at(path.end)) {
      lengths_[path.end] = kWall;
      left_.push_back(path.end);
    } else {
      prefetch_edges(path.end);
      queue_.push(path);
    }
  }
  shorter_count_ = 0;
}

std::span<const Path> PathSearch::found_in_order() {
  if (found_.empty()) return {};
  return order_.sorted(found_.front(), std::span(found_).subspan(1));
}

std::span<const Path> PathOrder::sorted(std::span<const Path> paths) {
  sorted_.resize(paths.size() + 1);  // the function below uses the first
  const std::span<Path> result = std::span(sorted_).subspan(1);
  if (paths.size() <= kernels_->few_numbers) {
    sort_by_comparison(paths, result);
  } else {
    sort_by_intervals(paths, result);
  }
  assert(std::is_sorted(result.begin(), result.end(), comes_before));
  return result;
}

std::span<const Path> PathOrder::sorted(const Path& one, std::span<const Path> paths) {
  static_cast<void>(sorted(paths));
  sorted_.front() = one;
  for (std::size_t i = 1; i < sorted_.size() && comes_before(sorted_[i], sorted_[i - 1]); ++i) {
    std::swap(sorted_[i], sorted_[i - 1]);
  }
  return sorted_;
}

/// Puts each path after those that are shorter, and after those of its length that were put before.
void PathOrder::sort_by_comparison(std::span<const Path> paths, std::span<Path> result) const {
  constexpr std::size_t kMost = Kernels::kMostFewNumbers;
  std::array<double, kMost + Kernels::kSpareNumbers> lengths;
  std::array<std::uint64_t, lengths.size()> shorter;
  for (std::size_t i = 0; i < paths.size(); ++i) lengths[i] = paths[i].length;
  std::fill_n(&lengths[paths.size()], Kernels::kSpareNumbers, 0);
  kernels_->count_less(lengths.data(), paths.size(), shorter.data());
  std::array<std::uint8_t, kMost> equal{};
  for (std::size_t i = 0; i < paths.size(); ++i) result[shorter[i] + equal[shorter[i]]++] = paths[i];
  sort_by_insertion(result);
}

void PathOrder::sort_by_intervals(std::span<const Path> paths, std::span<Path> result) {
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
    return;
  }
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const std::size_t from = i == 0 ? 0 : ends_[i - 1];
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(from),
              result.begin() + static_cast<std::ptrdiff_t>(ends_[i]), comes_before);
  }
}

}  // namespace meshhood::inline v0_1
