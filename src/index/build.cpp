// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <memory>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/index.h"

#include "adjacency.h"
#include "index/column.h"
#include "index/index_access.h"
#include "index/layout.h"
#include "index/leaves.h"
#include "index/links.h"
#include "index/tree.h"
#include "parallel.h"

namespace meshhood {
namespace {

// In a mesh smaller than the inverse, squares of distances underflow, and so does what columns say of them.
constexpr double kLargestScaleWithColumns = 0x1p480;

// So many vertices, or leaves, keep a thread busy long enough.
constexpr std::size_t kVertexGrain = 8192;
constexpr std::size_t kLeafGrain = 64;

/// The vertices in index order, in the frame.
std::vector<Point> place_points(const PositionsView& positions, const Frame& frame,
                                std::span<const VertexId> permutation, Work& work) {
  return positions.visit([&](auto xyz) {
    std::vector<Point> points(permutation.size());
    work.parallel_for(points.size(), kVertexGrain, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) points[i] = frame.place(point(xyz, permutation[i]));
    });
    return points;
  });
}

/// The positions in index order.
template <class Real>
std::vector<Real> permute_positions(std::span<const Real> xyz, std::span<const VertexId> permutation, Work& work) {
  std::vector<Real> permuted(xyz.size() + 3 * kLeafCapacity);
  work.parallel_for(permutation.size(), kVertexGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::copy_n(xyz.data() + 3 * std::size_t{permutation[i]}, 3, permuted.data() + 3 * i);
    }
  });
  return permuted;
}

/// What the tree says of each leaf.
class LeafMeasure {
 public:
  LeafMeasure(std::span<const VertexId> leaf_begin, const Links& links, std::span<const Point> points,
              bool with_columns)
      : leaf_begin_(leaf_begin), links_(links), points_(points), with_columns_(with_columns) {}

  void measure(std::size_t leaf, NodeList& out) {
    const std::size_t begin = leaf_begin_[leaf];
    const std::size_t size = leaf_begin_[leaf + 1] - begin;
    out.bounds[leaf] = enclosing_sphere(points_.subspan(begin, size));
    out.columns[leaf] = kNoColumn;
    if (!with_columns_) return;
    edges_.clear();
    gather_edges_within(begin, size);
    gather_edges_out(leaf);
    out.columns[leaf] = leaf_column(points_, begin, size, edges_, centre_of(out.bounds[leaf]));
  }

 private:
  void gather_edges_within(std::size_t begin, std::size_t size) {
    for (std::uint32_t lane = 0; lane < size; ++lane) {
      for (Lanes left = links_.adjacency[begin + lane]; left != 0; left &= left - 1) {
        edges_.push_back(
            {lane, static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(std::countr_zero(left))});
      }
    }
  }

  void gather_edges_out(std::size_t leaf) {
    for (std::size_t i = leaf == 0 ? 0 : links_.link_end[leaf - 1]; i < links_.link_end[leaf]; ++i) {
      const std::uint32_t other = leaf_begin_[links_.links[i].leaf];
      for (std::size_t k = links_.links[i].first_crossing; k < links_.links[i + 1].first_crossing; ++k) {
        edges_.push_back({links_.crossings[k].mine, other + links_.crossings[k].other});
      }
    }
  }

  std::span<const VertexId> leaf_begin_;
  const Links& links_;
  std::span<const Point> points_;
  bool with_columns_;
  std::vector<LeafEdge> edges_;
};

NodeList measure_leaves(std::span<const VertexId> leaf_begin, const Links& links, std::span<const Point> points,
                        bool with_columns, Work& work) {
  NodeList result(leaf_begin.size() - 1);
  work.parallel_for(result.bounds.size(), kLeafGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    LeafMeasure measure(leaf_begin, links, points, with_columns);
    for (std::size_t leaf = begin; leaf < end; ++leaf) measure.measure(leaf, result);
  });
  return result;
}

std::vector<Leaf> make_leaf_records(const LeafPartition& partition, const Links& links,
                                    std::span<const FrameSphere> bounds, Work& work) {
  std::vector<Leaf> leaves(bounds.size() + 1);
  work.parallel_for(bounds.size(), kLeafGrain, [&](unsigned, std::size_t begin, std::size_t end) {
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

Index finish(IndexArrays arrays, Work& work) {
  work.report();
  return IndexAccess::make(std::move(arrays));
}

}  // namespace

Index build(const MeshView& mesh, const BuildOptions& options) {
  Work work(options.threads, options.progress, IndexAccess::kBuildSteps);
  const Adjacency graph = adjacency(mesh, work);
  return finish(IndexAccess::build_valid({mesh.positions, graph.view()}, work), work);
}

Index build(const GraphView& graph, const BuildOptions& options) {
  Work work(options.threads, options.progress, IndexAccess::kBuildSteps);
  validate(graph);
  return finish(IndexAccess::build_valid(graph, work), work);
}

IndexArrays IndexAccess::build_valid(const GraphView& graph, Work& work) {
  work.advance(1);
  IndexArrays arrays;
  arrays.frame = make_frame(graph.positions);
  LeafPartition partition = make_leaves(graph, arrays.frame, work);
  work.advance(1);
  Links links = make_links(graph.adjacency, partition, work);
  work.advance(1);
  const std::vector<Point> points = place_points(graph.positions, arrays.frame, partition.permutation, work);
  NodeList lowest =
      measure_leaves(partition.leaf_begin, links, points, arrays.frame.scale <= kLargestScaleWithColumns, work);
  work.advance(1);
  arrays.leaves = make_leaf_records(partition, links, lowest.bounds, work);
  TreeArrays tree = make_tree(std::move(lowest), partition.leaf_begin, points, work);
  arrays.groups = std::move(tree.groups);
  arrays.mean_radii = std::move(tree.mean_radii);
  work.advance(1);
  graph.positions.visit([&](auto xyz) {
    arrays.positions = permute_positions(xyz, std::span<const VertexId>(partition.permutation), work);
  });
  pad(links.adjacency);
  pad(links.crossings);
  pad(partition.permutation);
  links.links.shrink_to_fit();
  arrays.permutation = std::move(partition.permutation);
  arrays.place = std::move(partition.place);
  arrays.leaf_begin = std::move(partition.leaf_begin);
  arrays.adjacency = std::move(links.adjacency);
  arrays.links = std::move(links.links);
  arrays.crossings = std::move(links.crossings);
  work.advance(1);
  return arrays;
}

}  // namespace meshhood
