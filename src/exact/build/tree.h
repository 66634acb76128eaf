// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// The bounding spheres of some nodes of one level.
using Spheres = std::vector<FrameSphere>;

/// The groups of all levels, leaves first, and the mean radius of the bounding spheres on each level.
struct TreeArrays {
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// Sets the `begin` of every record: `leaf_begin` is, by place of a leaf, and one more, its first vertex in index
/// order.
void set_vertices(std::span<const VertexId> leaf_begin, std::span<const std::uint32_t> levels,
                  std::vector<GroupRecord>& records);

/// Returns the mean radius of the nodes of some groups. The order of summation is fixed, so that a loaded index can be
/// verified bit for bit.
[[nodiscard]] double mean_radius(std::span<const Group> groups, std::span<const GroupRecord> records);

/// Returns whether the group has no `i`-th node.
[[nodiscard]] bool is_absent(const Group& group, std::size_t i);

/// Makes the tree over the leaves. Takes O(#V), hardly more than #V / 4 distances.
///
/// leaves  the spheres of all leaves
/// index   the frame, the positions, `leaf_begin`, `levels`, `records` and `parents`
[[nodiscard]] TreeArrays make_tree(Spheres leaves, const IndexView& index, TaskContext& task);

/// Replaces the spheres of some leaves in a tree, and computes again those of the nodes above them: they become what
/// `make_tree` would compute. O(leaves log #V), and a sum over the radii of all nodes.
///
/// leaves   ascending
/// spheres  of these leaves
/// index    as for `make_tree`
void update_tree(std::span<const LeafId> leaves, Spheres spheres, const IndexView& index, std::span<Group> groups,
                 std::span<double> mean_radii);

/// Returns the places, in the array of all groups, of those that `update_tree` changes.
[[nodiscard]] std::vector<std::size_t> groups_above(std::span<const LeafId> leaves, const IndexView& index);

/// Returns a sphere around `points` with this center, rounded to floats. Its radius includes the margin that a
/// comparison with a ball in single precision needs (see simd/kernels.h).
[[nodiscard]] FrameSphere enclosing_sphere(std::span<const Point> points, const Point& center);

/// Returns such a sphere around nearly the best center.
[[nodiscard]] FrameSphere enclosing_sphere(std::span<const Point> points);

/// The number of steps that `make_geometry` reports: positions, leaves, tree.
inline constexpr std::size_t kGeometrySteps = 3;

/// Makes the positions in index order, the bounds of the leaves and the tree: the last part of a build, and all of a
/// `refit`.
///
/// positions     valid, in the caller's order
/// connectivity  a view of all that does not depend on the positions
/// geometry      has the frame, and the leaves without their bounds; the rest is filled
/// O(#V).
void make_geometry(const PositionsView& positions, const IndexView& connectivity, GeometryData& geometry,
                   TaskContext& task);

/// Does the same from the positions in `geometry`, in index order.
void measure_geometry(const IndexView& connectivity, GeometryData& geometry, TaskContext& task);

/// Return the bounding spheres of some leaves, or of all places for leaves. A leaf without vertices has a sphere of
/// zeros. `index` has the frame, the positions and the leaves. O(#V) of the leaves.
[[nodiscard]] Spheres measure_leaves(std::span<const LeafId> leaves, const IndexView& index, TaskContext& task);
[[nodiscard]] Spheres measure_leaves(const IndexView& index, TaskContext& task);

}  // namespace meshhood::inline v0_1
