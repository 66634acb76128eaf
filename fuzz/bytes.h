// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

namespace meshhood::fuzz {

/// Takes numbers from the front of an input.
class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> bytes) : left_(bytes) {}

  [[nodiscard]] bool empty() const { return left_.empty(); }

  /// The next bytes as a number, or `otherwise` if there are too few.
  template <class T>
  T take(T otherwise = {}) {
    if (left_.size() < sizeof(T)) {
      left_ = {};
      return otherwise;
    }
    T value = otherwise;
    std::memcpy(&value, left_.data(), sizeof(T));
    left_ = left_.subspan(sizeof(T));
    return value;
  }

 private:
  std::span<const std::byte> left_;
};

}  // namespace meshhood::fuzz
