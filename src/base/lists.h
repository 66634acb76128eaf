// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Lists of elements, one after the other.
template <class T, class Offset = std::uint32_t>
struct Lists {
  std::vector<Offset> offsets{0};  // by list, and one more: where its elements begin
  std::vector<T> elements;

  void add(std::span<const T> list) {
    elements.insert(elements.end(), list.begin(), list.end());
    offsets.push_back(static_cast<Offset>(elements.size()));
  }

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t list) const {
    assert(list < size());
    return std::span(elements).subspan(offsets[list], static_cast<std::size_t>(offsets[list + 1] - offsets[list]));
  }
  [[nodiscard]] std::size_t bytes() const { return offsets.size() * sizeof(Offset) + elements.size() * sizeof(T); }
};

/// Sorts the values, and removes repeats.
template <class T>
void sort_out(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Fills lists: `for_each(f)` calls `f(list, element)` for every element of each list, and does so twice, in the same
/// order. A list has its elements in the reverse of that order. An `Offset` must be able to count all elements. Takes
/// O(#lists + #elements).
template <class Offset, class T, class ForEach>
void gather_rows(std::size_t lists, ForEach&& for_each, std::vector<Offset>& offsets, std::vector<T>& elements) {
  offsets.assign(lists + 1, 0);
  for_each([&](std::size_t list, const T&) { ++offsets[list]; });
  std::inclusive_scan(offsets.begin(), offsets.end(), offsets.begin());
  elements.resize(offsets.back());
  // Each offset stands at the end of its list and moves to the beginning as the list fills.
  for_each([&](std::size_t list, const T& element) { elements[--offsets[list]] = element; });
}

template <class T, class Offset, class ForEach>
[[nodiscard]] Lists<T, Offset> gather_lists(std::size_t lists, ForEach&& for_each) {
  Lists<T, Offset> result;
  gather_rows(lists, for_each, result.offsets, result.elements);
  return result;
}

/// Calls `append(row, values)` for each of `count` rows, on several threads; it appends the values of the row. Each
/// task has its own copy of `append`, which can own memory. Throws Error{Cancelled}.
template <class T, class Append>
Lists<T> collect_rows(std::size_t count, TaskContext& task, const Append& append) {
  constexpr std::size_t kRowsPerTask = 64;
  Lists<T> result{std::vector<std::uint32_t>(count + 1), {}};
  std::vector<std::vector<T>> pieces((count + kRowsPerTask - 1) / kRowsPerTask);
  task.parallel_for(count, kRowsPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    std::vector<T>& piece = pieces[begin / kRowsPerTask];
    Append append_here = append;
    for (std::size_t row = begin; row < end; ++row) {
      append_here(row, piece);
      result.offsets[row + 1] = static_cast<std::uint32_t>(piece.size());
    }
  });
  std::size_t all = 0;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    const std::size_t end = std::min((piece + 1) * kRowsPerTask, count);
    for (std::size_t row = piece * kRowsPerTask; row < end; ++row) {
      result.offsets[row + 1] += static_cast<std::uint32_t>(all);
    }
    all += pieces[piece].size();
  }
  result.elements.reserve(all);
  for (std::vector<T>& piece : pieces) {
    result.elements.insert(result.elements.end(), piece.begin(), piece.end());
    piece = std::vector<T>();  // this frees its memory for others
  }
  return result;
}

}  // namespace meshhood::inline v0_1
