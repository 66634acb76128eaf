// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "exact/layout.h"

namespace meshhood {

/// The arrays of an `IndexView` in memory of our own, as `build` fills them.
struct IndexData {
  Frame frame;
  std::variant<std::vector<float>, std::vector<double>> positions;
  std::vector<VertexId> permutation;
  std::vector<std::uint32_t> slot;
  std::vector<VertexId> leaf_begin;
  std::vector<Leaf> leaves;
  std::vector<Link> links;
  std::vector<CrossEdge> cross_edges;
  std::vector<LaneMask> adjacency;
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// What is searched, from what was built.
[[nodiscard]] std::unique_ptr<const IndexView> make_view(IndexData arrays);

}  // namespace meshhood
