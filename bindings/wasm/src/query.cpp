// SPDX-License-Identifier: MIT
// Neighborhoods of vertices by any method, and what is nearest to them.
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "shared/row_order.h"
#include "workspace.h"

namespace meshhood::wasm {

/// The numbers are part of the interface with JavaScript. Of equal distances, the smaller id comes first. Not in a
/// namespace without a name: a function that takes it would not be exported.
enum class VertexOrder : std::uint8_t { Index, Id, Distance };

namespace {

RowOrder row_order(VertexOrder order) {
  if (order == VertexOrder::Index) return RowOrder(workspace.index().permutation());
  return RowOrder(order == VertexOrder::Id ? RowSort::Id : RowSort::Distance);
}

void sort_rows(RowOrder&& order, std::span<const std::uint32_t> offsets) {
  for (std::size_t row = 0; row + 1 < offsets.size(); ++row) {
    const std::size_t begin = offsets[row];
    const std::size_t size = offsets[row + 1] - begin;
    order.sort(std::span(answer.ids).subspan(begin, size),
               answer.reals.empty() ? std::span<double>() : std::span(answer.reals).subspan(begin, size));
  }
}

/// Refuses a result of breadth-first search that is too large before a row is found: the rows found so far would be
/// lost to the instance (see raise.cpp). Its neighborhoods are those of the index, which counts them fast.
void check_size_of_rows(bool with_distances) {
  constexpr std::uint64_t kCopies = 3;  // of the result: it grows by doubling, and is copied
  const auto sizes = counts(workspace.searched(), rows);
  const std::uint64_t bytes = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0}) *
                              (sizeof(VertexId) + (with_distances ? sizeof(double) : 0));
  const std::uint64_t most = workspace.run().max_bytes / kCopies;
  if (bytes <= most) return;
  raise(ErrorCode::TooLarge, "the result of " + std::to_string(sizes.size()) + " rows, " + std::to_string(bytes) +
                                 " bytes, exceeds max_bytes, " + std::to_string(most));
}

/// The rows have one radius.
NearestOptions nearest_options() { return {.metric = rows.metric, .radius = rows.radius.common()}; }

}  // namespace

/// Puts the ids of the answer, and the distances, if there are any, into an order: each row by itself if the counts are
/// its offsets.
[[clang::export_name("sort_answer")]] void sort_answer(VertexOrder order, bool has_rows) {
  const std::array whole{std::uint32_t{0}, static_cast<std::uint32_t>(answer.ids.size())};
  sort_rows(row_order(order), has_rows ? std::span<const std::uint32_t>(answer.counts) : whole);
}

/// The counts of the answer are the offsets of the rows; with `count_only`, their sizes.
[[clang::export_name("batch")]] void batch(MethodName method, bool count_only, bool with_distances, RowSort sort) {
  const SearchMethod& search = workspace.method(method);
  if (count_only) {
    const auto sizes = counts(search, rows);
    answer.counts.assign(sizes.begin(), sizes.end());
    return;
  }
  if (method == MethodName::Bfs) check_size_of_rows(with_distances);
  Neighborhoods found = neighborhoods(search, rows, {.distances = with_distances, .sort = sort}, workspace.run());
  answer.counts.assign(found.offsets.begin(), found.offsets.end());
  answer.ids = std::move(found.ids);
  answer.reals = std::move(found.distances);
}

/// The ids of the answer are the nearest unconnected vertices, the reals their distances.
[[clang::export_name("nearest_unconnected")]] void nearest_unconnected() {
  Unconnected found = meshhood::nearest_unconnected(workspace.searched(), rows);
  answer.ids = std::move(found.vertex);
  answer.reals = std::move(found.distance);
}

/// The ids and reals of the answer have `k` places for each row.
[[clang::export_name("k_nearest")]] void k_nearest(std::size_t k) {
  KNearest found = meshhood::k_nearest(workspace.searched(), rows.vertices, k, nearest_options(), workspace.run());
  answer.ids = std::move(found.ids);
  answer.reals = std::move(found.distances);
}

/// The same rows up to an area. The counts of the answer are their offsets.
[[clang::export_name("discs")]] void discs(double area, const double* areas, std::size_t area_count) {
  Neighborhoods found = meshhood::discs(workspace.searched(), rows.vertices, area, {areas, area_count},
                                        nearest_options(), workspace.run());
  answer.counts.assign(found.offsets.begin(), found.offsets.end());
  answer.ids = std::move(found.ids);
  answer.reals = std::move(found.distances);
}

}  // namespace meshhood::wasm
