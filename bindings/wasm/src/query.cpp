// SPDX-License-Identifier: MIT
// Neighborhoods of vertices by any method, and what is nearest to them.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {

/// The numbers are part of the interface with JavaScript. Of equal distances, the smaller id comes first. Not in a
/// namespace without a name: a function that takes it would not be exported.
enum class VertexOrder : std::uint8_t { Index, Id, Distance };

namespace {

/// Of each vertex in index order.
std::vector<std::uint32_t> places() {
  const std::span<const VertexId> permutation = workspace.index().permutation();
  std::vector<std::uint32_t> result(workspace.index().vertex_count());
  std::iota(result.begin(), result.end(), 0U);
  for (std::size_t i = 0; i < permutation.size(); ++i) result[permutation[i]] = static_cast<std::uint32_t>(i);
  return result;
}

void sort_rows(VertexOrder order, std::span<const std::uint32_t> offsets) {
  struct Item {
    double key;
    VertexId id;
    double distance;
  };
  const std::vector<std::uint32_t> place = order == VertexOrder::Index ? places() : std::vector<std::uint32_t>();
  const auto key = [&](std::size_t i) -> double {
    return order == VertexOrder::Distance ? answer.reals[i] : order == VertexOrder::Index ? place[answer.ids[i]] : 0;
  };
  const bool has_distances = !answer.reals.empty();
  std::vector<Item> items;
  for (std::size_t row = 0; row + 1 < offsets.size(); ++row) {
    const std::size_t begin = offsets[row];
    items.clear();
    for (std::size_t i = begin; i < offsets[row + 1]; ++i) {
      items.push_back({key(i), answer.ids[i], has_distances ? answer.reals[i] : 0});
    }
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return std::tie(a.key, a.id) < std::tie(b.key, b.id); });
    for (std::size_t i = 0; i < items.size(); ++i) {
      answer.ids[begin + i] = items[i].id;
      if (has_distances) answer.reals[begin + i] = items[i].distance;
    }
  }
}

/// The rows have one radius.
NearestOptions nearest_options() { return {.metric = rows.metric, .radius = rows.radius.common()}; }

}  // namespace

/// Puts the ids of the answer, and the distances, if there are any, into an order: each row by itself if the counts are
/// its offsets.
[[clang::export_name("sort_answer")]] void sort_answer(VertexOrder order, bool has_rows) {
  const std::array whole{std::uint32_t{0}, static_cast<std::uint32_t>(answer.ids.size())};
  sort_rows(order, has_rows ? std::span<const std::uint32_t>(answer.counts) : whole);
}

/// The counts of the answer are the offsets of the rows; with `count_only`, their sizes.
[[clang::export_name("batch")]] void batch(MethodName method, bool count_only, bool with_distances, bool by_id) {
  const SearchMethod& search = workspace.method(method);
  if (count_only) {
    const auto sizes = counts(search, rows);
    answer.counts.assign(sizes.begin(), sizes.end());
    return;
  }
  Neighborhoods found = neighborhoods(search, rows, {.distances = with_distances, .sorted = by_id});
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
  KNearest found = meshhood::k_nearest(workspace.searched(), rows.vertices, k, nearest_options());
  answer.ids = std::move(found.ids);
  answer.reals = std::move(found.distances);
}

/// The same rows up to an area. The counts of the answer are their offsets.
[[clang::export_name("discs")]] void discs(double area, const double* areas, std::size_t area_count) {
  Neighborhoods found =
      meshhood::discs(workspace.searched(), rows.vertices, area, {areas, area_count}, nearest_options());
  answer.counts.assign(found.offsets.begin(), found.offsets.end());
  answer.ids = std::move(found.ids);
  answer.reals = std::move(found.distances);
}

}  // namespace meshhood::wasm
