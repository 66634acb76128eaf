// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "exact/build/minimum_region.h"
#include "exact/layout.h"

namespace meshhood {

/// The bounds of the nodes of one level.
struct NodeList {
  explicit NodeList(std::size_t nodes) : bounds(nodes), regions(nodes) {}

  std::vector<FrameSphere> bounds;
  std::vector<MinimumRegion> regions;
};

/// The groups of all levels, leaves first, and the mean radius of the bounding spheres on each level.
struct TreeArrays {
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// The mean radius of the `nodes` nodes of a level. The order of summation is fixed, so that a loaded index can be
/// verified bit for bit.
[[nodiscard]] double mean_radius(std::span<const Group> level, std::size_t nodes);

/// Whether the group has no `i`-th node.
[[nodiscard]] bool is_absent(const Group& group, std::size_t i);

/// The tree over the leaves.
///
/// leaf_begin  by leaf, and one more: its first vertex in index order
/// points      the vertices in index order, in the frame
/// O(#V log #V).
[[nodiscard]] TreeArrays make_tree(NodeList leaves, std::span<const VertexId> leaf_begin, std::span<const Point> points,
                                   TaskContext& task);

/// A sphere around `points` with this centre, rounded to floats. Its radius includes the margin that a comparison with
/// a ball in single precision needs (see simd/kernels.h).
[[nodiscard]] FrameSphere enclosing_sphere(std::span<const Point> points, const Point& centre);

/// The same around nearly the best centre.
[[nodiscard]] FrameSphere enclosing_sphere(std::span<const Point> points);

[[nodiscard]] inline Point centre_of(const FrameSphere& sphere) {
  return {static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z)};
}

}  // namespace meshhood
