// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/error.h"

namespace meshhood::inline v0_1 {

/// Returns the passes over all rows, one for each of the scales; the radius itself if it has no scales. Throws
/// Error{InvalidRadius}, naming the scale, and Error{InvalidOption} if the list of scales is empty.
[[nodiscard]] std::vector<BatchRadius> radius_of_passes(const BatchRadius& radius);

/// Returns memory for `count` ids, and as many distances if they are wanted. Throws Error{InvalidOption} if its size is
/// wrong.
[[nodiscard]] BatchMemory allocated(const BatchAllocator& allocate, std::size_t count, bool distances);

/// Returns how much of a limit each thread may use before it adds that to the number that all share. It adds seldom,
/// because threads wait for each other there. All threads together use at most a sixteenth of the limit.
[[nodiscard]] inline std::uint64_t share_at_once(std::uint64_t limit, unsigned threads) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 16;
  return std::min(kMost, limit / (std::uint64_t{16} * threads));
}

/// A checked copy of the rows of a batch: nothing that the caller changes later has an effect.
class Rows {
 public:
  /// Throws Error{VertexOutOfRange, InvalidRadius}, naming the row, and Error{InvalidRadius} if there are scales.
  Rows(const BatchQuery& query, std::size_t vertex_count);

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Returns whether row `v` is of vertex `v`, for all vertices.
  [[nodiscard]] bool are_all_vertices() const { return !vertices_; }

  [[nodiscard]] VertexId vertex(std::size_t row) const {
    return vertices_ ? (*vertices_)[row] : static_cast<VertexId>(row);
  }

  [[nodiscard]] double radius(std::size_t row) const { return radii_ ? (*radii_)[row] : radius_; }

  /// Replaces the radius of all rows, each of which has the same.
  void set_radius(double radius) { radius_ = radius; }

  /// Replaces row `i` by the former row `order[i]`. `order` is a permutation of the rows.
  void reorder(std::span<const std::size_t> order);

 private:
  [[nodiscard]] bool are_valid(std::size_t vertex_count) const;

  std::optional<std::vector<VertexId>> vertices_;
  std::optional<std::vector<double>> radii_;
  std::size_t size_;
  double radius_;  // of all rows, unless there are `radii_`
};

/// Refuses lists of more bytes than the caller allows.
class SizeLimit {
 public:
  /// `item_bytes` is the size of an id, or of one with a distance. No limit is beyond what an array of either can have.
  SizeLimit(std::uint64_t max_bytes, std::size_t item_bytes, std::size_t rows)
      : rows_(rows),
        max_bytes_(std::min(max_bytes, kMostOfArray / std::min(item_bytes, sizeof(double)) * item_bytes)),
        item_bytes_(item_bytes),
        max_items_(max_bytes_ / item_bytes) {}

  /// Takes a row from each of `kSample` stretches of the rows. The multiplier scatters them, so that the sample is
  /// right for alternating rows, too.
  static constexpr std::size_t kSample = 64;
  [[nodiscard]] std::size_t sampled_row(std::size_t i) const {
    return i * stretch() + i * std::size_t{0x9E37'79B1} % stretch();
  }
  [[nodiscard]] std::size_t stretch() const { return rows_ / kSample; }

  /// Refuses a result that is far too large, by the sizes of the sampled rows: to find all rows would show it only
  /// after most of the time is spent. `how_exact` says what the sizes are.
  void check_sample(std::span<const double> sizes, const char* how_exact) const {
    constexpr double kDeviations = 4;  // so that no result is refused by chance
    const auto rows = static_cast<double>(rows_);
    const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / kSample;
    double variance = 0;
    for (const double size : sizes) variance += (size - mean) * (size - mean) / kSample;
    if (allows(rows * (mean - kDeviations * std::sqrt(variance / kSample)))) return;
    refuse(how_exact, static_cast<std::uint64_t>(std::min(std::round(rows * mean), 0x1p63)));
  }

  [[nodiscard]] bool allows(double items) const { return items <= static_cast<double>(max_items_); }
  [[nodiscard]] std::uint64_t max_items() const { return max_items_; }

  /// Counts the items of some rows. Any thread may call it.
  void add(std::uint64_t items) {
    const std::uint64_t total = total_.fetch_add(items, std::memory_order_relaxed) + items;
    if (total > max_items_) refuse("at least ", total);
  }

  /// Returns, after all rows were added, whether the result and `bytes` more are within the limit.
  [[nodiscard]] bool leaves(std::uint64_t bytes) const { return bytes <= max_bytes_ - total_ * item_bytes_; }

  /// `items` is the size of the result, as far as it is known.
  [[noreturn]] void refuse(const char* how_exact, std::uint64_t items) const {
    constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t bytes = items > kMost / item_bytes_ ? kMost : items * item_bytes_;
    raise(ErrorCode::TooLarge, "the result of " + std::to_string(rows_) + " rows, " + how_exact +
                                   std::to_string(bytes) + " bytes, exceeds max_bytes, " + std::to_string(max_bytes_));
  }

 private:
  static constexpr std::uint64_t kMostOfArray = std::numeric_limits<std::ptrdiff_t>::max();

  std::size_t rows_;
  std::uint64_t max_bytes_;
  std::uint64_t item_bytes_;
  std::uint64_t max_items_;
  std::atomic<std::uint64_t> total_{0};
};

}  // namespace meshhood::inline v0_1
