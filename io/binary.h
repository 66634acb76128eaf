// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "io/input_buffer.h"

namespace meshhood::inline v0_1::io {

/// The value at `bytes`, of which there are enough.
template <class T>
[[nodiscard]] T number_at(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes, sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// Reads the next value of a binary file; false at the end of the file.
template <class T>
[[nodiscard]] bool load(InputBuffer& input, std::endian order, T& value) {
  const auto bytes = input.ahead(sizeof(T));
  if (bytes.size() < sizeof(T)) return false;
  value = number_at<T>(bytes.data(), order);
  input.skip(sizeof(T));
  return true;
}

/// The bytes of a value in a binary file.
template <class T>
[[nodiscard]] std::array<char, sizeof(T)> stored(std::endian order, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return raw;
}

}  // namespace meshhood::inline v0_1::io
