// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood {

/// Consecutive vertices `begin .. end - 1` in the order of a searcher; its `permutation()` maps them to the caller's
/// ids.
struct VertexRange {
  VertexId begin;
  VertexId end;

  [[nodiscard]] std::size_t size() const { return std::size_t{end} - begin; }

  friend bool operator==(const VertexRange&, const VertexRange&) = default;
};

/// A type that answers queries about the neighborhood of a vertex `v` within `radius`. `Searcher`, `paper::Searcher`,
/// `ReferenceSearcher` and `BallSearcher` satisfy it; they differ in what belongs to the neighborhood.
///
/// - `v` is in [0, `vertex_count()`). `radius` is >= 0 or infinite, in the unit of the positions. A vertex at exactly
///   `radius` is inside.
/// - `neighborhood` fills `ids`, and `distances` in the same order. Each vertex is listed once, `v` included.
/// - `count` returns the number of vertices.
/// - `ranges` returns the neighborhood as disjoint, nonempty ranges of the searcher's order. They are valid until the
///   next call.
/// - `permutation()` gives the caller's id of each vertex in that order; it is empty if the two orders are the same.
/// - An answer depends on the index or mesh, the vertex and the radius alone, and so does the order of its ids and
///   ranges. Earlier queries, threads and the processor have no effect.
///
/// A searcher owns scratch memory: use one object per thread.
template <class S>
concept NeighborhoodSearcher = requires(S& searcher, const S& constant, VertexId v, double radius,
                                        std::vector<VertexId>& ids, std::vector<double>& distances) {
  { constant.vertex_count() } -> std::same_as<std::size_t>;
  { constant.permutation() } -> std::same_as<std::span<const VertexId>>;
  { searcher.neighborhood(v, radius, ids) } -> std::same_as<void>;
  { searcher.neighborhood(v, radius, ids, distances) } -> std::same_as<void>;
  { searcher.count(v, radius) } -> std::same_as<std::size_t>;
  { searcher.ranges(v, radius) } -> std::same_as<std::span<const VertexRange>>;
};

/// Calls `on_run(VertexRange)` for each range of the neighborhood, in the order of `ranges`: with a `Searcher`
/// ascending. No id is copied. If `on_run` returns bool, false stops the visit. Returns whether it visited every range.
///
/// The whole neighborhood is found before the first call: an early stop saves the work of `on_run`, not the search.
/// `on_run` must not use `searcher`.
///
/// Throws as `searcher.ranges`; an exception from `on_run` is passed on.
template <NeighborhoodSearcher S, class F>
bool visit(S& searcher, VertexId v, double radius, F&& on_run) {
  for (const VertexRange run : searcher.ranges(v, radius)) {
    if constexpr (std::is_same_v<std::invoke_result_t<F&, VertexRange>, bool>) {
      if (!std::invoke(on_run, run)) return false;
    } else {
      std::invoke(on_run, run);
    }
  }
  return true;
}

/// Folds the neighborhood: starts with `init` and replaces it by `f(value, VertexRange)` for each range, as `visit`
/// gives them. The same query gives the same ranges in the same order, so a floating-point sum has the same bits.
/// Throws as `visit`.
template <NeighborhoodSearcher S, class T, class F>
[[nodiscard]] T reduce(S& searcher, VertexId v, double radius, T init, F&& f) {
  visit(searcher, v, radius, [&](VertexRange run) { init = std::invoke(f, std::move(init), run); });
  return init;
}

}  // namespace meshhood
