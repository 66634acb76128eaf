// SPDX-License-Identifier: MIT
// Runs the steps that build the exact index.
#include <algorithm>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/index.h"

#include "base/adjacency.h"
#include "base/validate.h"
#include "exact/build/forest.h"
#include "exact/build/leaves.h"
#include "exact/build/links.h"
#include "exact/build/tree.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

// A chunk of this size takes much longer than passing it to a thread.
constexpr std::size_t kLeafGrain = 64;

/// Makes the leaves without their bounding spheres.
std::vector<Leaf> make_leaf_records(const LeafPartition& partition, TaskContext& task) {
  const Links& links = partition.links;
  const std::size_t count = partition.leaf_begin.size() - 1;
  std::vector<Leaf> leaves(count + 1);
  task.parallel_for(count, kLeafGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      const std::uint32_t first = partition.leaf_begin[leaf];
      const auto size = static_cast<std::uint8_t>(partition.leaf_begin[leaf + 1] - first);
      leaves[leaf] = {{},
                      first,
                      leaf == 0 ? 0 : links.link_end[leaf - 1],
                      size,
                      size > 0 && is_connected(&links.adjacency[first], size)};
    }
  });
  leaves.back() = {
      {}, static_cast<std::uint32_t>(partition.permutation.size()), count == 0 ? 0 : links.link_end.back(), 0, false};
  return leaves;
}

/// Completes the records of the groups, and adds the links between nodes.
void add_forest(LeafPartition& partition, IndexData& arrays, TaskContext& task) {
  const Links& links = partition.links;
  arrays.levels = std::move(partition.forest.levels);
  arrays.records = std::move(partition.forest.records);
  arrays.parents = std::move(partition.forest.parents);
  set_vertices(partition.leaf_begin, arrays.levels, arrays.records);
  std::vector<std::uint32_t> first_link{0};
  first_link.insert(first_link.end(), links.link_end.begin(), links.link_end.end());
  arrays.node_links = make_node_links(first_link, links.links, arrays.levels, arrays.parents, arrays.records, task);
}

/// Adds the entries that a kernel may read beyond the end. There is room for them.
template <class Vector>
void pad(Vector& values) {
  assert(values.capacity() >= values.size() + kLeafCapacity);
  values.resize(values.size() + kLeafCapacity, typename Vector::value_type{});
}

Index finish(IndexData arrays, TaskContext& task) {
  task.report_progress();
  return IndexAccess::make(std::move(arrays));
}

}  // namespace

Index build(const MeshView& mesh, const Run& run) {
  TaskContext task(run.threads, run.progress, IndexAccess::kBuildSteps);
  return finish(IndexAccess::build_arrays(mesh, task), task);
}

Index build(const GraphView& graph, const Run& run) {
  TaskContext task(run.threads, run.progress, IndexAccess::kBuildSteps);
  validate(graph);
  return finish(IndexAccess::build_arrays(graph.positions, EdgeSource(graph.adjacency), task), task);
}

IndexData IndexAccess::build_arrays(const MeshView& mesh, TaskContext& task) {
  validate(mesh, task);
  check_corner_count(mesh.faces);
  return build_arrays(mesh.positions, EdgeSource(mesh.faces), task);
}

IndexData IndexAccess::build_arrays(const PositionsView& positions, const EdgeSource& edges, TaskContext& task) {
  IndexData arrays;
  arrays.frame = make_frame(positions, task);
  LeafPartition partition = make_leaves(positions, edges, arrays.frame, task);
  arrays.leaves = make_leaf_records(partition, task);
  add_forest(partition, arrays, task);
  task.advance(1);
  Links& links = partition.links;
  pad(links.adjacency);
  pad(links.cross_edges);
  pad(partition.permutation);
  arrays.permutation = std::move(partition.permutation);
  arrays.slot = std::move(partition.slot);
  arrays.leaf_begin = std::move(partition.leaf_begin);
  arrays.adjacency = std::move(links.adjacency);
  arrays.links = std::move(links.links);
  arrays.cross_edges = std::move(links.cross_edges);
  make_geometry(positions, view_of(arrays), arrays, task);
  return arrays;
}

}  // namespace meshhood::inline v0_1
