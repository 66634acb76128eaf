// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace meshhood::inline v0_1 {

/// Asks the system for large pages where it has them, because it hands over memory in these several times as fast.
void prefer_large_pages(void* memory, std::size_t bytes);

/// Returns `count` values in large pages: most of the time to make a vector of millions is that of the system.
template <class T>
[[nodiscard]] std::vector<T> make_values(std::size_t count, const T& value = T()) {
  std::vector<T> values;
  values.reserve(count);
  prefer_large_pages(values.data(), count * sizeof(T));
  values.resize(count, value);
  return values;
}

}  // namespace meshhood::inline v0_1
