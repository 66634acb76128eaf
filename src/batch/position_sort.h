// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "meshhood/start.h"

#include "base/frame.h"
#include "shared/distance.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// Sorts `rows` by their upper halves, which are positions. Rows of equal positions keep their order. It is a radix
/// sort, because a whole mesh has millions of rows, and comparing them takes longer than small neighborhoods. If the
/// rows are sorted already, it looks once at each, and needs no memory.
void sort_by_position(RawVector<std::uint64_t>& rows, TaskContext& task);

/// Returns the numbers 0 to `count - 1`, of 32 bits, in the order of `position(number)`, the upper half of each.
template <class Position>
[[nodiscard]] RawVector<std::uint64_t> sorted_by_position(std::size_t count, const Position& position,
                                                          TaskContext& task) {
  constexpr std::size_t kGrain = std::size_t{1} << 12;  // enough that passing them to a thread costs little
  RawVector<std::uint64_t> rows(count);
  task.parallel_for(count, kGrain, [&](unsigned /*thread*/, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) rows[i] = (std::uint64_t{position(i)} << 32) + i;
  });
  sort_by_position(rows, task);
  return rows;
}

/// Returns the rows 0 to `rows - 1` in the order of `position(row)`, 2^32 at a time.
template <class Position>
[[nodiscard]] RawVector<std::size_t> rows_by_position(std::size_t rows, const Position& position, TaskContext& task) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 32;
  constexpr std::size_t kGrain = std::size_t{1} << 14;
  RawVector<std::size_t> order(rows);
  for (std::uint64_t next = 0; next < rows; next += kMost) {
    const auto first = static_cast<std::size_t>(next);
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kMost, rows - first));
    const RawVector<std::uint64_t> sorted =
        sorted_by_position(count, [&](std::size_t i) { return position(first + i); }, task);
    task.parallel_for(count, kGrain, [&](unsigned /*thread*/, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) order[first + i] = first + static_cast<std::uint32_t>(sorted[i]);
    });
  }
  return order;
}

/// Calls `f(thread, row)` for the rows 0 to `rows - 1` in the order of `position(row)`, so that a thread gets `at_once`
/// rows that follow each other. Finishes `task`, which `f` advances.
template <class Position, class F>
void for_each_by_position(std::size_t rows, std::size_t at_once, const Position& position, TaskContext& task,
                          const F& f) {
  const RawVector<std::size_t> in_order = rows_by_position(rows, position, task);
  task.parallel_for(rows, at_once, [&](unsigned thread, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && task.should_continue(thread); ++i) f(thread, in_order[i]);
  });
  task.finish();
}

/// Returns the rows along a curve of Morton (1966), on which near points mostly follow each other. `at(row)` is in the
/// frame.
template <class At>
[[nodiscard]] RawVector<std::size_t> rows_along_curve(std::size_t rows, const At& at, TaskContext& task) {
  constexpr double kCells = 1U << 10U;  // per axis
  const auto spread = [](double coordinate) {
    const double cell = (coordinate + 1) * (kCells / 2);
    std::uint32_t bits = cell > 0 ? static_cast<std::uint32_t>(std::min(cell, kCells - 1)) : 0;  // a NaN becomes 0
    bits = (bits | bits << 16U) & 0x030000ffU;
    bits = (bits | bits << 8U) & 0x0300f00fU;
    bits = (bits | bits << 4U) & 0x030c30c3U;
    return (bits | bits << 2U) & 0x09249249U;
  };
  const auto position = [&](std::size_t row) {
    const Point p = at(row);
    return spread(p.x) | spread(p.y) << 1U | spread(p.z) << 2U;
  };
  return rows_by_position(rows, position, task);
}

/// Calls `visit(row, search.run(point))` for each point, on any thread and in no stated order. `make()` makes a search
/// for each run of points that follow each other along the curve. Finishes `task`.
template <class Make, class Visit>
void search_along_curve(std::span<const SpacePoint> points, const Frame& frame, TaskContext& task, const Make& make,
                        const Visit& visit) {
  constexpr std::size_t kPointsOfSearch = 256;
  const auto point_of = [&](std::size_t row) { return Point{points[row][0], points[row][1], points[row][2]}; };
  const RawVector<std::size_t> in_order =
      rows_along_curve(points.size(), [&](std::size_t row) { return frame.to_frame(point_of(row)); }, task);
  task.parallel_for(points.size(), kPointsOfSearch, [&](unsigned thread, std::size_t begin, std::size_t end) {
    auto search = make();
    for (std::size_t i = begin; i < end && task.should_continue(thread); ++i) {
      visit(in_order[i], search.run(point_of(in_order[i])));
      task.advance(thread, 1);
    }
  });
  task.finish();
}

}  // namespace meshhood::inline v0_1
