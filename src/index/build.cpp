// SPDX-License-Identifier: MIT
#include <algorithm>
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

/// The positions leaf by leaf, all x first, then y, then z.
template <class Real>
std::vector<Real> pack_positions(std::span<const Real> xyz, const LeafPartition& leaves) {
  std::vector<Real> packed(xyz.size() + kLeafCapacity);
  auto out = packed.begin();
  for (std::size_t leaf = 0; leaf + 1 < leaves.leaf_begin.size(); ++leaf) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t v = leaves.leaf_begin[leaf]; v < leaves.leaf_begin[leaf + 1]; ++v) {
        *out++ = xyz[3 * std::size_t{leaves.permutation[v]} + axis];
      }
    }
  }
  return packed;
}

/// What the tree says of each leaf.
class LeafMeasure {
 public:
  LeafMeasure(const LeafPartition& leaves, const AdjacencyView& adjacency, std::span<const Point> points,
              bool with_columns)
      : leaves_(leaves), adjacency_(adjacency), points_(points), with_columns_(with_columns) {}

  void measure(std::size_t leaf, NodeList& out) {
    const std::size_t begin = leaves_.leaf_begin[leaf];
    const std::size_t end = leaves_.leaf_begin[leaf + 1];
    out.bounds.push_back(enclosing_sphere(points_.subspan(begin, end - begin)));
    if (!with_columns_) {
      out.columns.push_back(kNoColumn);
      return;
    }
    gather(begin, end);
    out.columns.push_back(leaf_column({points_, begin, end, neighbors_, degrees_}, centre_of(out.bounds.back())));
  }

 private:
  void gather(std::size_t begin, std::size_t end) {
    neighbors_.clear();
    degrees_.clear();
    for (std::size_t v = begin; v < end; ++v) {
      const auto row = adjacency_[leaves_.permutation[v]];
      degrees_.push_back(static_cast<std::uint32_t>(row.size()));
      for (const VertexId w : row) {
        const std::uint32_t place = leaves_.place[w];
        neighbors_.push_back(leaves_.leaf_begin[place / kLeafCapacity] + place % kLeafCapacity);
      }
    }
  }

  const LeafPartition& leaves_;
  AdjacencyView adjacency_;
  std::span<const Point> points_;
  bool with_columns_;
  std::vector<std::uint32_t> neighbors_;
  std::vector<std::uint32_t> degrees_;
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
  LeafMeasure measure(partition, graph.adjacency, points, storage->frame.scale <= kLargestScaleWithColumns);
  for (std::size_t leaf = 0; leaf + 1 < partition.leaf_begin.size(); ++leaf) measure.measure(leaf, lowest);

  storage->leaves = make_leaf_records(partition, links, lowest.bounds);
  storage->tree = make_tree(std::move(lowest), partition.leaf_begin, points);
  graph.positions.visit([&](auto xyz) { storage->positions = pack_positions(xyz, partition); });
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
