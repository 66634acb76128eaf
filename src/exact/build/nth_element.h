// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>

namespace meshhood {

/// The place of the median of three values of `range`.
template <class T, class Less>
[[nodiscard]] std::size_t median_of(std::span<const T> range, std::size_t a, std::size_t b, std::size_t c,
                                    const Less& less) {
  if (less(range[b], range[a])) std::swap(a, b);
  if (less(range[b], range[c])) return b;
  return less(range[a], range[c]) ? c : a;
}

/// Hoare's partition of `range` around its first value. Returns the size of the first part. There must be values on
/// either side that end both scans.
template <class T, class Less>
[[nodiscard]] std::size_t partition_around_first(std::span<T> range, const Less& less) {
  std::size_t low = 1;
  std::size_t high = range.size();
  for (;;) {
    while (less(range[low], range[0])) ++low;
    --high;
    while (less(range[0], range[high])) --high;
    if (low >= high) return low;
    std::swap(range[low++], range[high]);
  }
}

/// As `std::nth_element` for distinct values, but deterministic: the order within both parts, and so the index, is the
/// same with every standard library. It is the order of libstdc++, with which the golden files were made. O(n), or O(n
/// log n) in the worst case.
template <class T, class Less>
void nth_element(std::span<T> range, std::size_t nth, const Less& less) {
  for (auto rounds = 2 * std::bit_width(range.size() / 2); range.size() > 3 && rounds > 0; --rounds) {
    std::swap(range[0], range[median_of(std::span<const T>(range), 1, range.size() / 2, range.size() - 1, less)]);
    const std::size_t cut = partition_around_first(range, less);
    if (cut <= nth) {
      range = range.subspan(cut);
      nth -= cut;
    } else {
      range = range.first(cut);
    }
  }
  std::sort(range.begin(), range.end(), less);
}

}  // namespace meshhood
