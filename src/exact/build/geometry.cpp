// SPDX-License-Identifier: MIT
#include "exact/build/geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "exact/build/tree.h"

namespace meshhood::inline v0_1 {
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

/// The spheres of `count` leaves; `leaf_at(i)` is the i-th.
template <class LeafAt>
Spheres measure(std::size_t count, LeafAt&& leaf_at, const IndexView& index, TaskContext& task) {
  constexpr std::size_t kGrain = 64;  // enough that passing them to a thread costs little
  Spheres result(count);
  task.parallel_for(count, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    std::visit(
        [&](auto xyz) {
          std::array<Point, kLeafCapacity> points;
          for (std::size_t i = begin; i < end; ++i) {
            const std::size_t first = index.leaf_begin[leaf_at(i)];
            const std::size_t size = index.leaf_begin[leaf_at(i) + 1] - first;
            for (std::size_t lane = 0; lane < size; ++lane)
              points[lane] = index.frame.to_frame(point(xyz, first + lane));
            if (size > 0) result[i] = enclosing_sphere(std::span(points).first(size));
          }
        },
        index.positions);
  });
  return result;
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

Spheres measure_leaves(std::span<const LeafId> leaves, const IndexView& index, TaskContext& task) {
  return measure(leaves.size(), [&](std::size_t i) { return std::size_t{leaves[i]}; }, index, task);
}

Spheres measure_leaves(const IndexView& index, TaskContext& task) {
  return measure(index.leaf_count(), [](std::size_t i) { return i; }, index, task);
}

}  // namespace meshhood::inline v0_1
