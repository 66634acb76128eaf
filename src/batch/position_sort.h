// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "shared/distance.h"

namespace meshhood {

/// Sorts `items` by `position(item)`, a number of 32 bits. Items of equal positions keep their order. A radix sort,
/// because the rows of a whole mesh are millions, and comparing them takes longer than small neighborhoods. Items that
/// are sorted cost one look at each, and no memory.
template <class Item, class Position>
void sort_by_position(std::span<Item> items, const Position& position) {
  constexpr unsigned kDigitBits = 11;
  constexpr std::uint32_t kDigits = 1U << kDigitBits;
  const auto precedes = [&](const Item& a, const Item& b) { return position(a) < position(b); };
  if (std::is_sorted(items.begin(), items.end(), precedes)) return;
  std::uint32_t bits_in_use = 0;
  for (const Item& item : items) bits_in_use |= position(item);
  std::vector<Item> memory(items.size());
  std::span<Item> sorted = items;  // by the digits so far
  std::span<Item> next = memory;
  for (unsigned shift = 0; shift < 32 && bits_in_use >> shift != 0; shift += kDigitBits) {
    const auto digit_of = [&](const Item& item) { return (position(item) >> shift) % kDigits; };
    std::array<std::size_t, kDigits> places{};
    for (const Item& item : sorted) ++places[digit_of(item)];
    std::exclusive_scan(places.begin(), places.end(), places.begin(), std::size_t{0});
    for (const Item& item : sorted) next[places[digit_of(item)]++] = item;
    std::swap(sorted, next);
  }
  if (sorted.data() != items.data()) std::copy(sorted.begin(), sorted.end(), items.begin());
}

/// The rows 0 to `rows - 1` in the order of `position(row)`.
template <class Position>
[[nodiscard]] std::vector<std::size_t> rows_by_position(std::size_t rows, const Position& position) {
  std::vector<std::pair<std::uint32_t, std::size_t>> by_position(rows);
  for (std::size_t row = 0; row < rows; ++row) by_position[row] = {position(row), row};
  sort_by_position(std::span(by_position), [](const auto& row) { return row.first; });
  std::vector<std::size_t> order(rows);
  for (std::size_t i = 0; i < rows; ++i) order[i] = by_position[i].second;
  return order;
}

/// The rows along a curve of Morton (1966), on which near points mostly follow each other. `at(row)`: its point in the
/// frame.
template <class At>
[[nodiscard]] std::vector<std::size_t> rows_along_curve(std::size_t rows, const At& at) {
  constexpr double kCells = 1U << 10U;  // an axis
  const auto spread = [](double coordinate) {
    const double cell = (coordinate + 1) * (kCells / 2);
    std::uint32_t bits = cell > 0 ? static_cast<std::uint32_t>(std::min(cell, kCells - 1)) : 0;  // 0 if not a number
    bits = (bits | bits << 16U) & 0x030000ffU;
    bits = (bits | bits << 8U) & 0x0300f00fU;
    bits = (bits | bits << 4U) & 0x030c30c3U;
    return (bits | bits << 2U) & 0x09249249U;
  };
  return rows_by_position(rows, [&](std::size_t row) {
    const Point p = at(row);
    return spread(p.x) | spread(p.y) << 1U | spread(p.z) << 2U;
  });
}

}  // namespace meshhood
