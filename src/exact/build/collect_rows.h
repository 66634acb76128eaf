// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/lists.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Calls `append(row, values)` for each of `count` rows, on several threads; it appends the values of the row. Throws
/// Error{Cancelled}.
template <class T, class Append>
Lists<T> collect_rows(std::size_t count, TaskContext& task, Append&& append) {
  constexpr std::size_t kRowsPerTask = 64;
  Lists<T> result{std::vector<std::uint32_t>(count + 1), {}};
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
  result.elements.reserve(all);
  for (std::vector<T>& piece : pieces) {
    result.elements.insert(result.elements.end(), piece.begin(), piece.end());
    piece = std::vector<T>();  // its memory is free for others
  }
  return result;
}

}  // namespace meshhood::inline v0_1
