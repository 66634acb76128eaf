// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <memory>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/index.h"

#include "index/column.h"
#include "index/index_access.h"
#include "index/layout.h"
#include "index/leaves.h"
#include "index/links.h"
#include "index/tree.h"

namespace meshhood {
namespace {

// In a mesh smaller than the inverse, squares of distances underflow, and so does what columns say of them.
constexpr double kLargestScaleWithColumns = 0x1p480;

/// The vertices in index order, in the frame.
std::vector<Point> place_points(const PositionsView& positions, const Frame& frame,
                                std::span<const VertexId> permutation) {
  return positions.visit([&](auto xyz) {
    std::vector<Point> points;
    points.reserve(permutation.size());
    for (const VertexId v : permutation) points.push_back(frame.place(point(xyz, v)));
    return points;
  });
}

/// The positions in index order.
template <class Real>
std::vector<Real> permute_positions(std::span<const Real> xyz, std::span<const VertexId> permutation) {
  std::vector<Real> permuted(xyz.size() + 3 * kLeafCapacity);
  auto out = permuted.begin();
  for (const VertexId v : permutation) out = std::copy_n(xyz.begin() + 3 * std::ptrdiff_t{v}, 3, out);
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
    out.bounds.push_back(enclosing_sphere(points_.subspan(begin, size)));
    if (!with_columns_) {
      out.columns.push_back(kNoColumn);
      return;
    }
    edges_.clear();
    gather_edges_within(begin, size);
    gather_edges_out(leaf);
    out.columns.push_back(leaf_column(points_, begin, size, edges_, centre_of(out.bounds.back())));
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

std::vector<Leaf> make_leaf_records(const LeafPartition& partition, const Links& links,
                                    std::span<const FrameSphere> bounds) {
  std::vector<Leaf> leaves;
  leaves.reserve(bounds.size() + 1);
  std::uint32_t first_link = 0;
  for (std::size_t leaf = 0; leaf < bounds.size(); ++leaf) {
    const VertexId first = partition.leaf_begin[leaf];
    const auto size = static_cast<std::uint8_t>(partition.leaf_begin[leaf + 1] - first);
    leaves.push_back({bounds[leaf], first, first_link, size, is_connected(&links.adjacency[first], size)});
    first_link = links.link_end[leaf];
  }
  leaves.push_back({{}, static_cast<VertexId>(partition.permutation.size()), first_link, 0, false});
  return leaves;
}

template <class T>
void pad(std::vector<T>& values) {
  values.resize(values.size() + kLeafCapacity);
  values.shrink_to_fit();
}

}  // namespace

Index build(const MeshView& mesh, const BuildOptions& options) {
  const Adjacency graph = adjacency(mesh);
  return IndexAccess::build_valid({mesh.positions, graph.view()}, options);
}

Index build(const GraphView& graph, const BuildOptions& options) {
  validate(graph);
  return IndexAccess::build_valid(graph, options);
}

Index IndexAccess::build_valid(const GraphView& graph, const BuildOptions& /*options*/) {
  auto storage = std::make_unique<IndexStorage>();
  storage->frame = make_frame(graph.positions);
  LeafPartition partition = make_leaves(graph, storage->frame);
  Links links = make_links(graph.adjacency, partition);

  const std::vector<Point> points = place_points(graph.positions, storage->frame, partition.permutation);
  NodeList lowest;
  LeafMeasure measure(partition.leaf_begin, links, points, storage->frame.scale <= kLargestScaleWithColumns);
  for (std::size_t leaf = 0; leaf + 1 < partition.leaf_begin.size(); ++leaf) measure.measure(leaf, lowest);

  storage->leaves = make_leaf_records(partition, links, lowest.bounds);
  storage->tree = make_tree(std::move(lowest), partition.leaf_begin, points);
  graph.positions.visit(
      [&](auto xyz) { storage->positions = permute_positions(xyz, std::span<const VertexId>(partition.permutation)); });
  pad(links.adjacency);
  pad(links.crossings);
  pad(partition.permutation);
  links.links.shrink_to_fit();
  storage->permutation = std::move(partition.permutation);
  storage->place = std::move(partition.place);
  storage->leaf_begin = std::move(partition.leaf_begin);
  storage->adjacency = std::move(links.adjacency);
  storage->links = std::move(links.links);
  storage->crossings = std::move(links.crossings);
  return make(std::move(storage));
}

}  // namespace meshhood
