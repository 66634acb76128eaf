// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "index/layout.h"

namespace meshhood {

/// The arrays of an `IndexStorage` in memory of our own, as `build` fills them.
struct IndexArrays {
  Frame frame;
  std::variant<std::vector<float>, std::vector<double>> positions;
  std::vector<VertexId> permutation;
  std::vector<std::uint32_t> place;
  std::vector<VertexId> leaf_begin;
  std::vector<Leaf> leaves;
  std::vector<Link> links;
  std::vector<Crossing> crossings;
  std::vector<Lanes> adjacency;
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// What is searched, from what was built.
[[nodiscard]] std::unique_ptr<const IndexStorage> make_storage(IndexArrays arrays);

}  // namespace meshhood
