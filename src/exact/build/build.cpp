// SPDX-License-Identifier: MIT
// The steps that build the exact index.
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/index.h"

#include "base/adjacency.h"
#include "base/parallel.h"
#include "exact/build/leaf_nodes.h"
#include "exact/build/leaves.h"
#include "exact/build/links.h"
#include "exact/build/tree.h"
#include "exact/index_access.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

// Squares of distances underflow in a mesh smaller than the inverse, so regions would be wrong.
constexpr double kLargestScaleWithRegions = 0x1p480;

// Enough vertices, or leaves, to be worth a thread's while.
constexpr std::size_t kVertexGrain = 8192;
constexpr std::size_t kLeafGrain = 64;

/// The vertices in index order, in the frame.
std::vector<Point> permute_points(const PositionsView& positions, const Frame& frame,
                                  std::span<const VertexId> permutation, TaskContext& task) {
  return positions.visit([&](const auto& xyz) {
    std::vector<Point> points(permutation.size());
    task.parallel_for(points.size(), kVertexGrain, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) points[i] = frame.to_frame(point(xyz, permutation[i]));
    });
    return points;
  });
}

/// The positions in index order.
template <class Real>
std::vector<Real> permute_positions(const StridedPositions<Real>& xyz, std::span<const VertexId> permutation,
                                    TaskContext& task) {
  std::vector<Real> permuted(3 * (xyz.size() + kLeafCapacity));
  task.parallel_for(permutation.size(), kVertexGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) permuted[3 * i + axis] = xyz(permutation[i], axis);
    }
  });
  return permuted;
}

std::vector<Leaf> make_leaf_records(const LeafPartition& partition, const Links& links,
                                    std::span<const FrameSphere> bounds, TaskContext& task) {
  std::vector<Leaf> leaves(bounds.size() + 1);
  task.parallel_for(bounds.size(), kLeafGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      const std::uint32_t first = partition.leaf_begin[leaf];
      const auto size = static_cast<std::uint8_t>(partition.leaf_begin[leaf + 1] - first);
      leaves[leaf] = {bounds[leaf], first, leaf == 0 ? 0 : links.link_end[leaf - 1], size,
                      is_connected(&links.adjacency[first], size)};
    }
  });
  leaves.back() = {{},
                   static_cast<std::uint32_t>(partition.permutation.size()),
                   bounds.empty() ? 0 : links.link_end.back(),
                   0,
                   false};
  return leaves;
}

template <class T>
void pad(std::vector<T>& values) {
  values.resize(values.size() + kLeafCapacity);
  values.shrink_to_fit();
}

Index finish(IndexData arrays, TaskContext& task) {
  task.report_progress();
  return IndexAccess::make(std::move(arrays));
}

}  // namespace

Index build(const MeshView& mesh, const BuildOptions& options) {
  TaskContext task(options.threads, options.progress, IndexAccess::kBuildSteps);
  const Adjacency graph = adjacency(mesh, task);
  return finish(IndexAccess::build_valid({mesh.positions, graph.view()}, task), task);
}

Index build(const GraphView& graph, const BuildOptions& options) {
  TaskContext task(options.threads, options.progress, IndexAccess::kBuildSteps);
  validate(graph);
  return finish(IndexAccess::build_valid(graph, task), task);
}

IndexData IndexAccess::build_valid(const GraphView& graph, TaskContext& task) {
  task.advance(1);
  IndexData arrays;
  arrays.frame = make_frame(graph.positions);
  LeafPartition partition = make_leaves(graph, arrays.frame, task);
  task.advance(1);
  Links links = make_links(graph.adjacency, partition, task);
  task.advance(1);
  const std::vector<Point> points = permute_points(graph.positions, arrays.frame, partition.permutation, task);
  const bool with_regions = arrays.frame.scale <= kLargestScaleWithRegions;
  NodeList lowest = make_leaf_nodes(partition.leaf_begin, links, points, with_regions, task);
  task.advance(1);
  arrays.leaves = make_leaf_records(partition, links, lowest.bounds, task);
  TreeArrays tree = make_tree(std::move(lowest), partition.leaf_begin, points, task);
  arrays.groups = std::move(tree.groups);
  arrays.mean_radii = std::move(tree.mean_radii);
  task.advance(1);
  graph.positions.visit([&](const auto& xyz) {
    arrays.positions = permute_positions(xyz, std::span<const VertexId>(partition.permutation), task);
  });
  pad(links.adjacency);
  pad(links.cross_edges);
  pad(partition.permutation);
  links.links.shrink_to_fit();
  arrays.permutation = std::move(partition.permutation);
  arrays.slot = std::move(partition.slot);
  arrays.leaf_begin = std::move(partition.leaf_begin);
  arrays.adjacency = std::move(links.adjacency);
  arrays.links = std::move(links.links);
  arrays.cross_edges = std::move(links.cross_edges);
  task.advance(1);
  return arrays;
}

}  // namespace meshhood
