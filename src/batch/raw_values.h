// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>

namespace meshhood {

/// A growing array whose memory is not set to zero first.
template <class T>
class RawValues {
 public:
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const T> part(std::size_t begin, std::size_t size) const {
    return {values_.get() + begin, size};
  }

  /// Adds `count` values, which the caller sets.
  std::span<T> add(std::size_t count) {
    const std::size_t needed = size_ + count;
    if (needed > capacity_) {
      const std::size_t capacity = std::max(needed, 2 * capacity_);
      auto larger = std::make_unique_for_overwrite<T[]>(capacity);  // NOLINT(modernize-avoid-c-arrays)
      std::copy_n(values_.get(), size_, larger.get());
      values_ = std::move(larger);
      capacity_ = capacity;
    }
    return {values_.get() + std::exchange(size_, needed), count};
  }

 private:
  std::unique_ptr<T[]> values_;  // NOLINT(modernize-avoid-c-arrays): a vector would write to all of it
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace meshhood
