// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstring>

namespace meshhood::parts {

/// The number of type T at `bytes`, in reversed byte order if `swaps`.
template <class T>
[[nodiscard]] T number_at(const char* bytes, bool swaps) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes, sizeof(T), raw.begin());
  if (swaps) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

}  // namespace meshhood::parts
