// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "meshhood/adjacency.h"

#include "exact/layout.h"

namespace meshhood {

/// The arrays of an `IndexView` in vectors, filled by `build`.
struct IndexData {
  Frame frame;
  PositionsData positions;
  std::vector<VertexId> permutation;
  std::vector<std::uint32_t> slot;
  std::vector<Leaf> leaves;
  std::vector<VertexId> leaf_begin;
  std::vector<Link> links;
  std::vector<CrossEdge> cross_edges;
  std::vector<LaneMask> adjacency;
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// A view that owns `data`.
[[nodiscard]] std::unique_ptr<const IndexView> make_view(IndexData data);

}  // namespace meshhood
