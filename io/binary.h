// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "io/input_buffer.h"

namespace meshhood::io {

/// Reads the next value of a binary file; false at the end of the file.
template <class T>
[[nodiscard]] bool load(InputBuffer& input, std::endian order, T& value) {
  const auto bytes = input.ahead(sizeof(T));
  if (bytes.size() < sizeof(T)) return false;
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes.begin(), sizeof(T), raw.begin());
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  std::memcpy(&value, raw.data(), sizeof(T));
  input.skip(sizeof(T));
  return true;
}

}  // namespace meshhood::io
