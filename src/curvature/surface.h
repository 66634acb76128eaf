// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/curvature.h"
#include "meshhood/search.h"

#include "exact/bound_index.h"
#include "exact/layout.h"
#include "shared/distance.h"
#include "shared/raw_vector.h"

namespace meshhood {

/// The arrays of a `CurvatureIndex`, in index order.
struct CurvatureIndex::State {
  explicit State(const Index& given);

  /// With the normals of another, whose mesh is the same.
  State(const Index& given, const State& other);

  Index searched;    // shares its memory with the caller's
  BoundIndex index;  // its arrays
  std::shared_ptr<RawVector<double>> normals;
  std::span<double> normal_x;  // unit vectors; NaN without one
  std::span<double> normal_y;
  std::span<double> normal_z;

  [[nodiscard]] Point position(std::size_t place) const {
    return std::visit([&](auto xyz) { return point(xyz, place); }, index->positions);
  }
  [[nodiscard]] Point normal(std::size_t place) const { return {normal_x[place], normal_y[place], normal_z[place]}; }

  void set_spans();

  /// The neighbor with the lowest id; the vertex itself if it has none.
  [[nodiscard]] std::size_t first_neighbor(std::size_t place) const;
};

/// The position in index order of a vertex of the caller.
[[nodiscard]] inline std::uint32_t place_of(const IndexView& index, VertexId v) {
  const std::uint32_t slot = index.slot[v];
  return index.leaf_begin[leaf_of(slot)] + lane_of(slot);
}

/// For the sources of curvature, and for tests.
struct CurvatureAccess {
  using State = CurvatureIndex::State;

  /// Throws Error{InvalidOption} after a refit in place.
  [[nodiscard]] static const State& state(const CurvatureIndex& surface) {
    surface.state_->index.check_current();
    return *surface.state_;
  }
  [[nodiscard]] static CurvatureIndex make(std::unique_ptr<const State> state) {
    return CurvatureIndex(std::move(state));
  }
};

using SurfaceState = CurvatureAccess::State;

/// The places in index order of the vertices of the neighborhood of the one at `place`. They ascend.
inline void find_places(Searcher& searcher, const IndexView& index, std::uint32_t place, double radius,
                        std::vector<std::uint32_t>& found) {
  found.clear();
  for (const VertexRange& range : searcher.ranges(index.id(place), radius)) {
    for (VertexId i = range.begin; i < range.end; ++i) found.push_back(i);
  }
}

}  // namespace meshhood
