// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/parallel.h"

namespace meshhood {

/// Rows of values, one after the other, as those of an adjacency.
template <class T>
struct CollectedRows {
  std::vector<std::uint32_t> offsets;  // by row, and one more: where its values begin
  std::vector<T> values;

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t row) const {
    return std::span(values).subspan(offsets[row], offsets[row + 1] - offsets[row]);
  }
};

/// Calls `append(row, values)` for each of `count` rows, on several threads; it appends the values of the row. Throws
/// Error{Cancelled}.
template <class T, class Append>
CollectedRows<T> collect_rows(std::size_t count, TaskContext& task, Append&& append) {
  constexpr std::size_t kRowsPerTask = 64;
  CollectedRows<T> result{std::vector<std::uint32_t>(count + 1), {}};
  std::vector<std::vector<T>> pieces((count + kRowsPerTask - 1) / kRowsPerTask);
  task.parallel_for(count, kRowsPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    std::vector<T>& piece = pieces[begin / kRowsPerTask];
    for (std::size_t row = begin; row < end; ++row) {
      append(row, piece);
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
  result.values.reserve(all);
  for (std::vector<T>& piece : pieces) {
    result.values.insert(result.values.end(), piece.begin(), piece.end());
    piece = std::vector<T>();  // its memory is free for others
  }
  return result;
}

}  // namespace meshhood
