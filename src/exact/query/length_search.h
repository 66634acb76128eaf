// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/metric.h"

#include "exact/layout.h"
#include "exact/query/path_search.h"
#include "exact/vertex_set.h"
#include "exact/weighted_graph.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Finds the vertices around a start by path distance or by number of edges: for each the length, and its place in
/// index order. A length is the least radius whose neighborhood has the vertex. Walls are not passed, ignored vertices
/// are passed and left out. Each thread needs its own.
class LengthSearch {
 public:
  /// Receives the vertices that were found since its last call, and returns true to end the search. All that are nearer
  /// than one of them have then been found.
  using OnFound = std::function<bool(std::span<const Path>)>;

  explicit LengthSearch(const IndexView& index) : index_(&index) {}
  LengthSearch(const LengthSearch&) = delete;
  LengthSearch& operator=(const LengthSearch&) = delete;
  virtual ~LengthSearch() = default;

  /// Finds the vertices whose length by a path that continues one of `starts` is at most `radius`, until `on_found`
  /// ends the search. By the number of edges there is one start, of length 0.
  virtual void run(std::span<const Path> starts, double radius, const OnFound& on_found) = 0;

  // These results are those of the last run, and valid until the next.

  /// Returns what was found, in no stated order.
  [[nodiscard]] virtual std::span<const Path> found() = 0;

  /// Returns what was found, ascending by length, then by place.
  [[nodiscard]] virtual std::span<const Path> in_order() = 0;

  /// Adds what was found to `subsets`, in no stated order.
  virtual void collect(std::vector<LeafSubset>& subsets);

 protected:
  const IndexView* index_;
};

/// Makes a search by `metric`, which must be along edges. For paths this takes O(#V), and O(#V + #E) for the first
/// search of an index. The arguments must outlive the search.
[[nodiscard]] std::unique_ptr<LengthSearch> make_length_search(const IndexView& index, KeptGraph& graph, Metric metric,
                                                               const Kernels& kernels);

/// Makes the search by the number of edges.
[[nodiscard]] std::unique_ptr<LengthSearch> make_ring_search(const IndexView& index, KeptGraph& graph,
                                                             const Kernels& kernels);

}  // namespace meshhood::inline v0_1
