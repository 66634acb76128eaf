// SPDX-License-Identifier: MIT
#include "exact/build/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>

#include "base/sphere.h"

namespace meshhood {
namespace {

// The margin that single precision needs: a vertex, the query vertex and a centre are each rounded by up to 2^-24.2 in
// the frame, and the comparison of a distance with a radius by about 2^-22 of the radius.
constexpr double kRelativeRoom = 0x1p-20;
constexpr double kAbsoluteRoom = 0x1p-22;
constexpr double kRegionRoom = 0x1p-20;

// Farther than any vertex; its square is still a float.
constexpr float kFarAway = 1e18F;

std::vector<float> as_floats(std::span<const Point> points) {
  std::vector<float> xyz;
  xyz.reserve(3 * points.size());
  for (const Point& p : points) {
    xyz.push_back(static_cast<float>(p.x));
    xyz.push_back(static_cast<float>(p.y));
    xyz.push_back(static_cast<float>(p.z));
  }
  return xyz;
}

Point smallest_sphere_centre(std::span<const Point> points) {
  const std::vector<float> xyz = as_floats(points);
  const Sphere<float> sphere = bounding_sphere(std::span<const float>(xyz));
  return centre_of(sphere);
}

FrameSphere sphere_of(const Group& group, std::size_t i) {
  return {group.x[i], group.y[i], group.z[i], group.radius[i]};
}

void set_node(Group& group, std::size_t i, const FrameSphere& bounds, const MinimumRegion& region) {
  group.x[i] = bounds.x;
  group.y[i] = bounds.y;
  group.z[i] = bounds.z;
  group.radius[i] = bounds.radius;
  group.slope_x[i] = static_cast<float>(region.slope_axis.x);
  group.slope_y[i] = static_cast<float>(region.slope_axis.y);
  group.slope_z[i] = static_cast<float>(region.slope_axis.z);
  group.offset[i] = next_above(region.offset + kRegionRoom);  // mutant: region-too-narrow
}

void set_absent(Group& group, std::size_t i) {
  set_node(group, i, {kFarAway, kFarAway, kFarAway, 0}, MinimumRegion{{0, 0, 0}, 0});
}

/// The nodes of a group.
NodeList nodes_of(const Group& group, std::size_t count) {
  NodeList nodes(count);
  for (std::size_t i = 0; i < count; ++i) {
    nodes.bounds[i] = sphere_of(group, i);
    nodes.regions[i] = {{static_cast<double>(group.slope_x[i]), static_cast<double>(group.slope_y[i]),
                         static_cast<double>(group.slope_z[i])},
                        static_cast<double>(group.offset[i])};
  }
  return nodes;
}

/// A sphere of radius 0.
FrameSphere rounded(const Point& centre) {
  return {static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z), 0};
}

void set_radius(FrameSphere& sphere, double farthest_squared) {
  // mutant: sphere-too-small
  sphere.radius = next_above(std::sqrt(farthest_squared) * (1 + kRelativeRoom) + kAbsoluteRoom);
}

/// The tree while it is made: a level is complete before the next begins.
class GrowingTree {
 public:
  GrowingTree(const IndexView& index, std::span<Group> groups, std::span<double> mean_radii)
      : index_(index), groups_(groups), mean_radii_(mean_radii) {
    std::size_t begin = 0;
    for (const std::size_t nodes : tree_nodes(index.leaf_count())) {
      levels_.push_back({begin, nodes});
      begin += group_count(nodes);
    }
  }

  [[nodiscard]] std::size_t level_count() const { return levels_.size(); }
  [[nodiscard]] std::size_t node_count(std::size_t level) const { return levels_[level].nodes; }

  [[nodiscard]] Group& group(std::size_t level, std::size_t group) const {
    return groups_[levels_[level].first_group + group];
  }

  /// The number of children of a node of `level`, which is not the lowest.
  [[nodiscard]] std::size_t child_count(std::size_t level, std::size_t node) const {
    return std::min<std::size_t>(kFanOut, node_count(level - 1) - node * kFanOut);  // mutant: parent-without-last-child
  }

  void set(std::size_t level, std::size_t node, const FrameSphere& bounds, const MinimumRegion& region) const {
    set_node(group(level, node / kFanOut), node % kFanOut, bounds, region);
  }

  /// After the nodes of the level are set.
  void finish(std::size_t level) const {
    const std::size_t nodes = node_count(level);
    for (std::size_t i = nodes; i % kFanOut != 0; ++i) set_absent(group(level, i / kFanOut), i % kFanOut);
    mean_radii_[level] = mean_radius(groups_.subspan(levels_[level].first_group, group_count(nodes)), nodes);
  }

  /// Sets `out[at]` to the node of `level` above `children`.
  void measure_parent(std::size_t level, std::size_t node, std::span<const FrameSphere> spheres,
                      std::span<const MinimumRegion> regions, NodeList& out, std::size_t at) const {
    std::vector<Point> centres;
    for (const FrameSphere& sphere : spheres) centres.push_back(centre_of(sphere));
    FrameSphere bounds = rounded(smallest_sphere_centre(centres));
    const Point centre = centre_of(bounds);
    double farthest = 0;
    find_farthest(level, node, centre, farthest);
    set_radius(bounds, farthest);
    out.bounds[at] = bounds;
    out.regions[at] = enclosing_minimum_region(regions, centres, centre);
  }

 private:
  struct Level {
    std::size_t first_group;
    std::size_t nodes;
  };

  /// Raises `farthest` to the largest squared distance from `from` to a vertex below the node. Looks only at children
  /// whose spheres reach farther, the one that reaches farthest first.
  void find_farthest(std::size_t level, std::size_t node, const Point& from, double& farthest) const {
    if (level == 0) {
      for (std::size_t i = index_.leaf_begin[node]; i < index_.leaf_begin[node + 1]; ++i) {
        farthest = std::max(farthest, squared_distance(index_.in_frame(i), from));
      }
      return;
    }
    const Group& children = group(level - 1, node);
    std::array<std::pair<double, std::size_t>, kFanOut> reach;
    const std::size_t count = child_count(level, node);
    for (std::size_t i = 0; i < count; ++i) {
      const FrameSphere sphere = sphere_of(children, i);
      reach[i] = {std::sqrt(squared_distance(centre_of(sphere), from)) + static_cast<double>(sphere.radius), i};
    }
    std::sort(reach.begin(), reach.begin() + static_cast<std::ptrdiff_t>(count), std::greater<>());
    for (std::size_t i = 0; i < count; ++i) {
      if (reach[i].first * reach[i].first <= farthest) return;  // mutant: farthest-vertex-skipped
      find_farthest(level - 1, node * kFanOut + reach[i].second, from, farthest);
    }
  }

  const IndexView& index_;
  std::span<Group> groups_;
  std::span<double> mean_radii_;
  std::vector<Level> levels_;
};

/// All parents of the nodes of the level below.
NodeList make_parents(const GrowingTree& tree, std::size_t level, const NodeList& children, TaskContext& task) {
  NodeList parents(tree.node_count(level));
  task.parallel_for(parents.bounds.size(), 1, [&](unsigned, std::size_t parent, std::size_t) {
    const std::size_t begin = parent * kFanOut;
    const std::size_t count = tree.child_count(level, parent);
    tree.measure_parent(level, parent, std::span(children.bounds).subspan(begin, count),
                        std::span(children.regions).subspan(begin, count), parents, parent);
  });
  return parents;
}

/// Replaces ascending nodes by their parents.
void climb(std::vector<std::size_t>& nodes) {
  for (std::size_t& node : nodes) node /= kFanOut;
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

}  // namespace

FrameSphere enclosing_sphere(std::span<const Point> points, const Point& centre) {
  FrameSphere sphere = rounded(centre);
  double farthest = 0;
  for (const Point& p : points) farthest = std::max(farthest, squared_distance(p, centre_of(sphere)));
  set_radius(sphere, farthest);
  return sphere;
}

FrameSphere enclosing_sphere(std::span<const Point> points) {
  return enclosing_sphere(points, smallest_sphere_centre(points));
}

bool is_absent(const Group& group, std::size_t i) {
  Group other = group;
  set_absent(other, i);
  // Absent nodes are made by `set_absent`, bit for bit. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  return std::memcmp(&other, &group, sizeof(Group)) == 0;
}

double mean_radius(std::span<const Group> level, std::size_t nodes) {
  double sum = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    sum += static_cast<double>(level[node / kFanOut].radius[node % kFanOut]);
  }
  return sum / static_cast<double>(nodes);  // mutant: mean-over-absent-nodes
}

TreeArrays make_tree(NodeList nodes, const IndexView& index, TaskContext& task) {
  const std::size_t leaves = index.leaf_count();
  TreeArrays arrays{std::vector<Group>(tree_groups(leaves)), std::vector<double>(tree_nodes(leaves).size())};
  const GrowingTree tree(index, arrays.groups, arrays.mean_radii);
  for (std::size_t level = 0; level < tree.level_count(); ++level) {
    if (level > 0) nodes = make_parents(tree, level, nodes, task);
    for (std::size_t i = 0; i < nodes.bounds.size(); ++i) tree.set(level, i, nodes.bounds[i], nodes.regions[i]);
    tree.finish(level);
  }
  return arrays;
}

void update_tree(std::span<const LeafId> leaves, NodeList bounds, const IndexView& index, std::span<Group> groups,
                 std::span<double> mean_radii) {
  const GrowingTree tree(index, groups, mean_radii);
  std::vector<std::size_t> nodes(leaves.begin(), leaves.end());
  for (std::size_t level = 0; level < tree.level_count(); ++level) {
    if (level > 0) {
      climb(nodes);
      bounds = NodeList(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const NodeList children = nodes_of(tree.group(level - 1, nodes[i]), tree.child_count(level, nodes[i]));
        tree.measure_parent(level, nodes[i], children.bounds, children.regions, bounds, i);
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) tree.set(level, nodes[i], bounds.bounds[i], bounds.regions[i]);
    tree.finish(level);
  }
}

std::vector<std::size_t> groups_above(std::span<const LeafId> leaves, std::size_t leaf_count) {
  std::vector<std::size_t> result;
  std::vector<std::size_t> nodes(leaves.begin(), leaves.end());
  std::size_t begin = 0;
  for (const std::size_t count : tree_nodes(leaf_count)) {
    climb(nodes);
    for (const std::size_t group : nodes) result.push_back(begin + group);
    begin += group_count(count);
  }
  return result;
}

}  // namespace meshhood
