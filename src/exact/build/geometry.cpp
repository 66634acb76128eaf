// SPDX-License-Identifier: MIT
#include "exact/build/geometry.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "exact/build/leaf_spheres.h"
#include "exact/build/tree.h"

namespace meshhood {
namespace {

// Enough that passing them to a thread costs little.
constexpr std::size_t kVertexGrain = 2048;

/// The positions in index order, padded with zeros.
template <class Real>
RawVector<Real> permute_positions(const StridedPositions<Real>& xyz, const IndexView& index, TaskContext& task) {
  RawVector<Real> permuted(3 * (xyz.size() + kLeafCapacity));
  std::fill(permuted.begin() + static_cast<std::ptrdiff_t>(3 * xyz.size()), permuted.end(), Real{0});
  task.parallel_for(xyz.size(), kVertexGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) permuted[3 * i + axis] = xyz(index.id(i), axis);
    }
  });
  return permuted;
}

}  // namespace

void make_geometry(const PositionsView& positions, const IndexView& connectivity, GeometryData& geometry,
                   TaskContext& task) {
  positions.visit([&](const auto& xyz) { geometry.positions = permute_positions(xyz, connectivity, task); });
  task.advance(1);
  measure_geometry(connectivity, geometry, task);
}

void measure_geometry(const IndexView& connectivity, GeometryData& geometry, TaskContext& task) {
  IndexView index = connectivity;
  index.frame = geometry.frame;
  index.positions = view_of(geometry.positions);
  index.leaves = geometry.leaves;
  Spheres leaves = measure_leaves(index, task);
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) geometry.leaves[leaf].bounds = leaves[leaf];
  task.advance(1);
  TreeArrays tree = make_tree(std::move(leaves), index, task);
  geometry.groups = std::move(tree.groups);
  geometry.mean_radii = std::move(tree.mean_radii);
  task.advance(1);
}

}  // namespace meshhood
