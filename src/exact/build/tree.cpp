// SPDX-License-Identifier: MIT
#include "exact/build/tree.h"

#include <algorithm>
#include <cmath>
#include <cstring>

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

/// The eight nodes from `begin` on.
Group make_group(const NodeList& level, std::size_t begin) {
  Group group;
  for (std::size_t i = 0; i < kFanOut; ++i) {
    if (begin + i < level.bounds.size()) {
      set_node(group, i, level.bounds[begin + i], level.regions[begin + i]);
    } else {
      set_absent(group, i);
    }
  }
  return group;
}

void append_level(const NodeList& nodes, TreeArrays& tree) {
  const std::size_t begin = tree.groups.size();
  const std::size_t count = nodes.bounds.size();
  for (std::size_t node = 0; node < count; node += kFanOut) tree.groups.push_back(make_group(nodes, node));
  tree.mean_radii.push_back(mean_radius(std::span(tree.groups).subspan(begin), count));
}

/// The parents of the nodes of `level`, each of which covers `leaves` leaves.
NodeList make_parents(const NodeList& level, std::size_t leaves, std::span<const VertexId> leaf_begin,
                      std::span<const Point> points, TaskContext& task) {
  const std::size_t leaf_count = leaf_begin.size() - 1;
  NodeList parents(group_count(level.bounds.size()));
  task.parallel_for(parents.bounds.size(), 1, [&](unsigned, std::size_t parent, std::size_t) {
    const std::size_t begin = parent * kFanOut;
    const std::size_t end = std::min(begin + kFanOut, level.bounds.size());  // mutant: parent-without-last-child
    std::vector<Point> centres;
    for (std::size_t i = begin; i < end; ++i) centres.push_back(centre_of(level.bounds[i]));
    const std::size_t first = leaf_begin[begin * leaves];
    const std::size_t last = leaf_begin[std::min(end * leaves, leaf_count)];
    parents.bounds[parent] = enclosing_sphere(points.subspan(first, last - first), smallest_sphere_centre(centres));
    parents.regions[parent] = enclosing_minimum_region(std::span(level.regions).subspan(begin, end - begin), centres,
                                                       centre_of(parents.bounds[parent]));
  });
  return parents;
}

}  // namespace

FrameSphere enclosing_sphere(std::span<const Point> points, const Point& centre) {
  FrameSphere sphere{static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z), 0};
  const Point rounded = centre_of(sphere);
  double farthest = 0;
  for (const Point& p : points) farthest = std::max(farthest, squared_distance(p, rounded));
  sphere.radius = next_above(std::sqrt(farthest) * (1 + kRelativeRoom) + kAbsoluteRoom);  // mutant: sphere-too-small
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

TreeArrays make_tree(NodeList level, std::span<const VertexId> leaf_begin, std::span<const Point> points,
                     TaskContext& task) {
  const std::size_t levels = tree_nodes(level.bounds.size()).size();
  TreeArrays tree;
  tree.groups.reserve(tree_groups(level.bounds.size()));
  for (std::size_t leaves = 1; tree.mean_radii.size() < levels; leaves *= kFanOut) {
    if (leaves > 1) level = make_parents(level, leaves / kFanOut, leaf_begin, points, task);
    append_level(level, tree);
  }
  return tree;
}

}  // namespace meshhood
