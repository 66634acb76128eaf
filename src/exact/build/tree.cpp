// SPDX-License-Identifier: MIT
#include "exact/build/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/sphere.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

// Single precision needs this margin: a vertex, the query vertex and a center are each rounded by up to 2^-24.2 in the
// frame, and the comparison of a distance with a radius by about 2^-22 of the radius.
constexpr double kRelativeRoom = 0x1p-20;
constexpr double kAbsoluteRoom = 0x1p-22;

// This is farther than any vertex, and its square is still a float.
constexpr float kFarAway = 1e18F;

void set_node(Group& group, std::size_t i, const FrameSphere& sphere) {
  group.x[i] = sphere.x;
  group.y[i] = sphere.y;
  group.z[i] = sphere.z;
  group.radius[i] = sphere.radius;
}

void set_absent(Group& group, std::size_t i) { set_node(group, i, {kFarAway, kFarAway, kFarAway, 0}); }

/// Returns the spheres of the nodes of a group.
Spheres spheres_of(const Group& group, std::size_t count) {
  Spheres result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(sphere_of(group, i));
  return result;
}

/// Returns a sphere of radius 0. The coordinates are rounded through memory: where they are converted back at once, g++
/// 12 would measure the radius from those that are not rounded (docs/decisions.md, "A compiler trap").
FrameSphere rounded(const Point& center) {
  const volatile auto x = static_cast<float>(center.x);
  const volatile auto y = static_cast<float>(center.y);
  const volatile auto z = static_cast<float>(center.z);
  return {x, y, z, 0};
}

void set_radius(FrameSphere& sphere, double farthest_squared) {
  sphere.radius = next_above(std::sqrt(farthest_squared) * (1 + kRelativeRoom) + kAbsoluteRoom);
}

/// The bounds of all nodes while they are computed: a level is complete before the next begins.
class GrowingTree {
 public:
  GrowingTree(const IndexView& index, std::span<Group> groups, std::span<double> mean_radii)
      : index_(index), groups_(groups), mean_radii_(mean_radii) {}

  [[nodiscard]] std::size_t level_count() const { return index_.levels.size() - 1; }
  [[nodiscard]] std::size_t first_group(std::size_t level) const { return index_.levels[level]; }
  [[nodiscard]] std::size_t end_group(std::size_t level) const { return index_.levels[level + 1]; }

  [[nodiscard]] std::size_t node_count(std::size_t group) const { return index_.records[group].nodes; }

  /// Returns the group that a node above the leaves covers.
  [[nodiscard]] std::size_t child_group(NodeId node) const {
    return std::size_t{index_.records[node / kFanOut].first_child} + node % kFanOut;
  }

  [[nodiscard]] const Group& group(std::size_t group) const { return groups_[group]; }

  void set(NodeId node, const FrameSphere& sphere) const { set_node(groups_[node / kFanOut], node % kFanOut, sphere); }

  /// Completes a level, after its nodes are set.
  void finish(std::size_t level) const {
    const std::size_t first = first_group(level);
    const std::size_t count = end_group(level) - first;
    for (std::size_t group = first; group < first + count; ++group) {
      for (std::size_t i = node_count(group); i < kFanOut; ++i) set_absent(groups_[group], i);
    }
    mean_radii_[level] = mean_radius(groups_.subspan(first, count), index_.records.subspan(first, count));
  }

  /// Returns the sphere of `node` above the nodes of one group, whose spheres are given.
  [[nodiscard]] FrameSphere measure_parent(NodeId node, std::span<const FrameSphere> spheres) const {
    std::vector<Point> centers;
    for (const FrameSphere& sphere : spheres) centers.push_back(center_of(sphere));
    FrameSphere result = rounded(bounding_center(centers));
    double farthest = 0;
    find_farthest(node, center_of(result), farthest);
    set_radius(result, farthest);
    return result;
  }

 private:
  /// Raises `farthest` to the largest squared distance from `from` to a vertex below the node. Looks only at children
  /// whose spheres reach farther, the one that reaches farthest first.
  void find_farthest(NodeId node, const Point& from, double& farthest) const {
    if (node < index_.leaf_count()) {
      for (std::size_t i = index_.leaf_begin[node]; i < index_.leaf_begin[node + std::size_t{1}]; ++i) {
        farthest = std::max(farthest, squared_distance(index_.in_frame(i), from));
      }
      return;
    }
    const std::size_t child = child_group(node);
    const Group& children = group(child);
    std::array<std::pair<double, std::size_t>, kFanOut> reach;
    // There are at most eight, which the compiler cannot know.
    const std::size_t count = std::min<std::size_t>(node_count(child), kFanOut);
    for (std::size_t i = 0; i < count; ++i) {
      const FrameSphere sphere = sphere_of(children, i);
      reach[i] = {std::sqrt(squared_distance(center_of(sphere), from)) + static_cast<double>(sphere.radius), i};
    }
    for (auto end = reach.begin() + static_cast<std::ptrdiff_t>(count); end != reach.begin(); --end) {
      const auto next = std::max_element(reach.begin(), end);
      if (next->first * next->first <= farthest) return;
      find_farthest(static_cast<NodeId>(child * kFanOut + next->second), from, farthest);
      *next = *(end - 1);
    }
  }

  const IndexView& index_;
  std::span<Group> groups_;
  std::span<double> mean_radii_;
};

/// Returns the spheres of all nodes of a level, by place, from those of the level below.
Spheres make_parents(const GrowingTree& tree, std::size_t level, std::span<const FrameSphere> below,
                     TaskContext& task) {
  const std::size_t first = tree.first_group(level);
  const std::size_t first_below = tree.first_group(level - 1);
  Spheres parents((tree.end_group(level) - first) * kFanOut);
  task.parallel_for(tree.end_group(level) - first, 1, [&](unsigned, std::size_t group, std::size_t) {
    for (std::size_t i = 0; i < tree.node_count(first + group); ++i) {
      const auto node = static_cast<NodeId>((first + group) * kFanOut + i);
      const std::size_t child = tree.child_group(node);
      const std::size_t count = tree.node_count(child);
      parents[group * kFanOut + i] = tree.measure_parent(node, below.subspan((child - first_below) * kFanOut, count));
    }
  });
  return parents;
}

/// Replaces ascending nodes by those that cover them.
void climb(std::vector<NodeId>& nodes, std::span<const NodeId> parents) {
  for (NodeId& node : nodes) node = parents[node / kFanOut];
  std::erase(nodes, kNoNode);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

// A chunk of this size takes much longer than passing it to a thread.
constexpr std::size_t kVertexGrain = 2048;

/// Returns the positions in index order, padded with zeros.
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

/// Returns the spheres of `count` leaves; `leaf_at(i)` is the i-th.
template <class LeafAt>
Spheres measure(std::size_t count, LeafAt&& leaf_at, const IndexView& index, TaskContext& task) {
  constexpr std::size_t kGrain = 64;  // a chunk of this size takes much longer than passing it to a thread
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

FrameSphere enclosing_sphere(std::span<const Point> points, const Point& center) {
  FrameSphere sphere = rounded(center);
  double farthest = 0;
  for (const Point& p : points) farthest = std::max(farthest, squared_distance(p, center_of(sphere)));
  set_radius(sphere, farthest);
  return sphere;
}

FrameSphere enclosing_sphere(std::span<const Point> points) {
  return enclosing_sphere(points, bounding_center(points));
}

bool is_absent(const Group& group, std::size_t i) {
  Group other = group;
  set_absent(other, i);
  // Absent nodes are made by `set_absent`, bit for bit. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  return std::memcmp(&other, &group, sizeof(Group)) == 0;
}

double mean_radius(std::span<const Group> groups, std::span<const GroupRecord> records) {
  double sum = 0;
  std::size_t nodes = 0;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    for (std::size_t i = 0; i < records[group].nodes; ++i) sum += static_cast<double>(groups[group].radius[i]);
    nodes += records[group].nodes;
  }
  return sum / static_cast<double>(nodes);
}

void set_vertices(std::span<const VertexId> leaf_begin, std::span<const std::uint32_t> levels,
                  std::vector<GroupRecord>& records) {
  const std::size_t leaf_groups = levels.size() > 1 ? levels[1] : 0;
  for (std::size_t group = 0; group < records.size(); ++group) {
    GroupRecord& record = records[group];
    for (std::size_t i = 0; i <= kFanOut; ++i) {
      if (group < leaf_groups) {
        record.begin[i] = leaf_begin[group * kFanOut + i];
      } else if (i < record.nodes) {
        record.begin[i] = records[record.first_child + i].begin.front();
      } else {
        record.begin[i] = records[record.first_child + record.nodes - 1].begin.back();
      }
    }
  }
}

TreeArrays make_tree(Spheres nodes, const IndexView& index, TaskContext& task) {
  TreeArrays arrays{std::vector<Group>(index.records.size()), std::vector<double>(index.levels.size() - 1)};
  const GrowingTree tree(index, arrays.groups, arrays.mean_radii);
  for (std::size_t level = 0; level < tree.level_count(); ++level) {
    if (level > 0) nodes = make_parents(tree, level, nodes, task);
    const std::size_t first = tree.first_group(level);
    for (std::size_t group = first; group < tree.end_group(level); ++group) {
      for (std::size_t i = 0; i < tree.node_count(group); ++i) {
        const std::size_t at = (group - first) * kFanOut + i;
        tree.set(static_cast<NodeId>(group * kFanOut + i), nodes[at]);
      }
    }
    tree.finish(level);
  }
  return arrays;
}

void update_tree(std::span<const LeafId> leaves, Spheres spheres, const IndexView& index, std::span<Group> groups,
                 std::span<double> mean_radii) {
  const GrowingTree tree(index, groups, mean_radii);
  std::vector<NodeId> nodes(leaves.begin(), leaves.end());
  for (std::size_t level = 0; level < tree.level_count(); ++level) {
    if (level > 0) {
      climb(nodes, index.parents);
      spheres.clear();
      for (const NodeId node : nodes) {
        const std::size_t child = tree.child_group(node);
        spheres.push_back(tree.measure_parent(node, spheres_of(tree.group(child), tree.node_count(child))));
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) tree.set(nodes[i], spheres[i]);
    tree.finish(level);
  }
}

std::vector<std::size_t> groups_above(std::span<const LeafId> leaves, const IndexView& index) {
  std::vector<std::size_t> result;
  for (std::vector<NodeId> nodes(leaves.begin(), leaves.end()); !nodes.empty(); climb(nodes, index.parents)) {
    for (const NodeId node : nodes) {
      if (result.empty() || result.back() != node / kFanOut) result.push_back(node / kFanOut);
    }
  }
  return result;
}

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
