// SPDX-License-Identifier: MIT
// Builds leaves of some samples of the mesh with the function that builds those of an index, and compares their size
// with that of the leaves in which the same vertices are now.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "meshhood/refit.h"

#include "exact/build/leaves.h"
#include "exact/build/tree.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/neighbors.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kSamples = 16;
constexpr std::size_t kSampleSize = 1024;
// Only this part of a sample, nearest to its center, is compared, because leaves at its surface are cut off.
constexpr std::size_t kInnerSize = kSampleSize / 4;

/// Returns leaves that together hold the `size` vertices nearest to a point. If a ball around the point holds enough
/// leaves for that many vertices, the leaves that meet the ball are sufficient.
std::vector<LeafId> leaves_around(const IndexView& index, const Point& center, std::size_t size) {
  struct Reach {
    double nearest;
    double farthest;
    LeafId leaf;
  };
  std::vector<Reach> reaches;
  for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
    if (index.leaves[leaf].size == 0) continue;
    const FrameSphere& sphere = index.leaves[leaf].bounds;
    const double distance = std::sqrt(squared_distance(center_of(sphere), center));
    const auto radius = static_cast<double>(sphere.radius);
    reaches.push_back({distance - radius, distance + radius, leaf});
  }
  // A leaf has at least one vertex.
  const std::size_t enough = std::min(size, reaches.size());
  const auto end = reaches.begin() + static_cast<std::ptrdiff_t>(enough);
  const auto farthest_first = [](const Reach& a, const Reach& b) {
    return std::pair(a.farthest, a.leaf) < std::pair(b.farthest, b.leaf);
  };
  std::nth_element(reaches.begin(), end - 1, reaches.end(), farthest_first);
  std::sort(reaches.begin(), end, farthest_first);
  std::size_t held = 0;
  double limit = 0;
  for (auto at = reaches.begin(); at != end && held < size; ++at) {
    held += index.leaves[at->leaf].size;
    limit = at->farthest;
  }
  std::vector<LeafId> leaves;
  for (const Reach& reach : reaches) {
    if (reach.nearest <= limit) leaves.push_back(reach.leaf);
  }
  return leaves;
}

/// Returns the `size` vertices nearest to the seed, by places in index order, in order of distance.
std::vector<std::uint32_t> take_sample(const IndexView& index, std::size_t seed, std::size_t size) {
  const Point center = index.in_frame(seed);
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const LeafId leaf : leaves_around(index, center, size)) {
    for (std::uint32_t place = index.leaf_begin[leaf]; place < index.leaf_begin[leaf + std::size_t{1}]; ++place) {
      found.emplace_back(squared_distance(center, index.in_frame(place)), place);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> sample;
  for (std::size_t i = 0; i < std::min(size, found.size()); ++i) sample.push_back(found[i].second);
  return sample;
}

/// Returns the part of the mesh between the vertices of a sample, which are numbered in the order given.
GraphData graph_of(const IndexView& index, const std::vector<std::uint32_t>& sample) {
  std::vector<std::pair<std::uint32_t, VertexId>> number;  // ascending by place
  std::vector<double> positions;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    number.emplace_back(sample[i], static_cast<VertexId>(i));
    const Point p = index.position(sample[i]);
    positions.insert(positions.end(), {p.x, p.y, p.z});
  }
  std::sort(number.begin(), number.end());
  Adjacency adjacency{{0}, {}};
  for (const std::uint32_t place : sample) {
    const auto row = static_cast<std::ptrdiff_t>(adjacency.neighbors.size());
    for_each_neighbor(index, index.slot_at(place), [&](std::size_t other) {
      const auto at = std::ranges::lower_bound(number, other, {}, &std::pair<std::uint32_t, VertexId>::first);
      if (at != number.end() && at->first == other) adjacency.neighbors.push_back(at->second);
    });
    std::sort(adjacency.neighbors.begin() + row, adjacency.neighbors.end());
    adjacency.offsets.push_back(static_cast<EdgeOffset>(adjacency.neighbors.size()));
  }
  return {std::move(positions), std::move(adjacency)};
}

/// Returns the radius of the new leaf of each vertex, in the frame `frame`.
std::vector<double> new_radii(const GraphData& graph, const Frame& frame) {
  TaskContext task;
  const LeafPartition leaves = make_leaves(graph.view().positions, EdgeSource(graph.view().adjacency), frame, task);
  const auto& xyz = std::get<std::vector<double>>(graph.positions);
  std::vector<double> radii(leaves.slot.size());
  for (std::size_t leaf = 0; leaf + 1 < leaves.leaf_begin.size(); ++leaf) {
    const auto vertices = std::span(leaves.permutation)
                              .subspan(leaves.leaf_begin[leaf], leaves.leaf_begin[leaf + 1] - leaves.leaf_begin[leaf]);
    if (vertices.empty()) continue;
    std::vector<Point> points;
    for (const VertexId v : vertices) points.push_back(frame.to_frame(point(std::span<const double>(xyz), v)));
    const auto radius = static_cast<double>(enclosing_sphere(points).radius);
    for (const VertexId v : vertices) radii[v] = radius;
  }
  return radii;
}

/// The mean radii of the leaves that hold the inner vertices of a sample, in the unit of the mesh.
struct Radii {
  double present = 0;
  double rebuilt = 0;
};

/// `frame` is that of a new index.
Radii compare_around(const IndexView& index, std::size_t seed, const Frame& frame) {
  const std::vector<std::uint32_t> sample = take_sample(index, seed, kSampleSize);
  const std::vector<double> rebuilt = new_radii(graph_of(index, sample), frame);
  const std::size_t inner = std::min(sample.size(), kInnerSize);
  Radii mean;
  for (std::size_t i = 0; i < inner; ++i) {
    const Leaf& leaf = index.leaves[leaf_of(index.slot_at(sample[i]))];
    mean.present += static_cast<double>(leaf.bounds.radius) / index.frame.scale / static_cast<double>(inner);
    mean.rebuilt += rebuilt[i] / frame.scale / static_cast<double>(inner);
  }
  return mean;
}

}  // namespace

Quality quality(const Index& index) {
  const IndexView& view = IndexAccess::view(index);
  const std::size_t samples = std::min(kSamples, view.vertex_count());
  if (samples == 0) return {.mean_radius = 0, .rebuilt_radius = 0, .gain = 1};
  const auto share = 1 / static_cast<double>(samples);
  const Frame frame = make_frame(index.positions());
  Quality result{.mean_radius = 0, .rebuilt_radius = 0, .gain = 1};
  for (std::size_t i = 0; i < samples; ++i) {
    const Radii radii = compare_around(view, (2 * i + 1) * view.vertex_count() / (2 * samples), frame);
    result.mean_radius += share * radii.present;
    result.rebuilt_radius += share * radii.rebuilt;
  }
  result.gain = result.mean_radius / result.rebuilt_radius;
  return result;
}

}  // namespace meshhood::inline v0_1
