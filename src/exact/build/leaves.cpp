// SPDX-License-Identifier: MIT
// A kd tree divides space into cells of 30 vertices. The mesh may pass through a cell in several connected components;
// each becomes a leaf of its own if it is large enough, else it is merged into a neighboring leaf that has room.
// The leaves are then grouped by their links, which decides their order. The edges are sorted once, by cell; what
// follows finds them there.
#include "exact/build/leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/build/cells.h"
#include "exact/build/links.h"
#include "exact/layout.h"

namespace meshhood::inline v0_1 {
namespace {

// A chunk of this size takes much longer than passing it to a thread.
constexpr std::size_t kLeavesPerTask = 64;

/// The data from which the leaves are made.
struct Material {
  Cells cells;
  Links links;  // of the cells
  CellComponents components;
  MergedComponents leaves;

  [[nodiscard]] std::uint32_t leaf_at(std::size_t cell, unsigned lane) const {
    return leaves.leaf_of[components.at(cell, lane)];
  }
};

/// Calls `f(point)` for the vertices of a leaf.
template <class F>
void for_each_point(const Material& mesh, std::size_t leaf, F&& f) {
  for (const CellComponent& part : mesh.leaves[leaf]) {
    for_each_lane(part.lanes, [&](unsigned lane) { f(mesh.cells.begin[part.cell] + lane); });
  }
}

Point position_of(const KdPoint& p) {
  return {static_cast<double>(p.at[0]), static_cast<double>(p.at[1]), static_cast<double>(p.at[2])};
}

/// Returns the mean of the vertices of a leaf, and the distance of the farthest from it.
NodeBall measure_leaf(const Material& mesh, std::size_t leaf) {
  NodeBall ball{{0, 0, 0}, 0};
  std::size_t size = 0;
  for_each_point(mesh, leaf, [&](std::size_t i) {
    ball.center = ball.center + position_of(mesh.cells.points[i]);
    ++size;
  });
  ball.center = 1 / static_cast<double>(size) * ball.center;
  for_each_point(mesh, leaf, [&](std::size_t i) {
    ball.radius = std::max(ball.radius, squared_distance(ball.center, position_of(mesh.cells.points[i])));
  });
  ball.radius = std::sqrt(ball.radius);
  return ball;
}

/// Appends the other leaves that an edge joins to this one.
void append_neighbors(const Material& mesh, std::size_t leaf, std::vector<std::uint32_t>& out) {
  const std::size_t before = out.size();
  const auto add = [&](std::uint32_t other) {
    // Most edges between two leaves follow each other.
    if (other != leaf && (out.size() == before || out.back() != other)) out.push_back(other);
  };
  for (const CellComponent& part : mesh.leaves[leaf]) {
    for (const Link& link : mesh.links.links_of(part.cell)) {
      if ((link.boundary & part.lanes) == 0) continue;
      if (mesh.components[link.leaf].size() == 1) {
        add(mesh.leaf_at(link.leaf, 0));
        continue;
      }
      for (const CrossEdge& edge : mesh.links.cross_edges_of(link)) {
        if ((part.lanes >> edge.from & 1U) != 0) add(mesh.leaf_at(link.leaf, edge.to));
      }
    }
  }
}

/// Returns the leaves and the links between them, by which they are grouped.
NodeGraph graph_of_leaves(const Material& mesh, TaskContext& task) {
  return make_graph(
      mesh.leaves.size(), [&](std::size_t leaf) { return measure_leaf(mesh, leaf); },
      [&](std::size_t leaf, std::vector<std::uint32_t>& out) { append_neighbors(mesh, leaf, out); }, task);
}

/// Finds the order of the vertices of each leaf, and for each vertex in kd order its slot.
class Placing {
 public:
  Placing(const Material& mesh, LeafPartition& result) : mesh_(mesh), result_(result), slot_(mesh.cells.points.size()) {
    const std::span<const std::uint32_t> order = result.forest.leaves;
    result.leaf_begin.assign(order.size() + 1, 0);
    for (std::size_t place = 0; place < order.size(); ++place) {
      result.leaf_begin[place + 1] = result.leaf_begin[place];
      if (order[place] != kNoNode) result.leaf_begin[place + 1] += size_of(order[place]);
    }
    result.slot.resize(slot_.size());
    result.permutation.reserve(slot_.size() + kLeafCapacity);  // and the padding of an index
    result.permutation.resize(slot_.size());
  }

  RawVector<std::uint32_t> run(TaskContext& task) {
    task.parallel_for(result_.forest.leaves.size(), kLeavesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t place = begin; place < end; ++place) {
        if (result_.forest.leaves[place] != kNoNode) number_vertices(place);
      }
    });
    return std::move(slot_);
  }

 private:
  [[nodiscard]] VertexId size_of(std::size_t leaf) const {
    std::size_t size = 0;
    for (const CellComponent& part : mesh_.leaves[leaf]) size += count_of(part.lanes);
    return static_cast<VertexId>(size);
  }

  /// Gives the vertices of a leaf its lanes in the order of the caller's vertices, so that neighbors stay neighbors.
  void number_vertices(std::size_t place) {
    std::array<std::pair<VertexId, std::uint32_t>, kLeafCapacity> members;
    std::size_t size = 0;
    const std::uint32_t leaf = result_.forest.leaves[place];
    for_each_point(mesh_, leaf,
                   [&](std::size_t i) { members[size++] = {mesh_.cells.points[i].id, static_cast<std::uint32_t>(i)}; });
    // The vertices of one cell ascend.
    if (mesh_.leaves[leaf].size() > 1) std::sort(members.begin(), members.begin() + size);
    for (std::size_t lane = 0; lane < size; ++lane) {
      const auto [vertex, i] = members[lane];
      result_.permutation[result_.leaf_begin[place] + lane] = vertex;
      slot_[i] = result_.slot[vertex] = static_cast<std::uint32_t>(place * kLeafCapacity + lane);
    }
  }

  const Material& mesh_;
  LeafPartition& result_;
  RawVector<std::uint32_t> slot_;
};

/// Turns the links of cells into those of leaves.
class LeafLinker {
 public:
  /// `slot` has the slots of the vertices in kd order.
  LeafLinker(const Material& mesh, std::span<const std::uint32_t> slot, const LeafPartition& leaves)
      : mesh_(mesh), slot_(slot), leaves_(leaves) {}

  Links run(TaskContext& task) const {
    const std::size_t places = leaves_.forest.leaves.size();
    RawVector<LaneMask> adjacency;
    adjacency.reserve(slot_.size() + kLeafCapacity);  // and the padding of an index
    adjacency.resize(slot_.size());
    std::vector<Links> runs((places + kLeavesPerTask - 1) / kLeavesPerTask);
    std::vector<LinkCollector> collectors(std::min<std::size_t>(task.threads(), runs.size()), LinkCollector(places));
    task.parallel_for(places, kLeavesPerTask, [&](unsigned thread, std::size_t begin, std::size_t end) {
      for (std::size_t place = begin; place < end; ++place) {
        LinkCollector& exits = collectors[thread];
        exits.begin();
        link(place, adjacency.data() + leaves_.leaf_begin[place], exits);
        exits.finish(runs[begin / kLeavesPerTask]);
      }
    });
    Links result = join_runs(runs);
    result.adjacency = std::move(adjacency);
    return result;
  }

 private:
  void link(std::size_t place, LaneMask* adjacency, LinkCollector& exits) const {
    const std::uint32_t leaf = leaves_.forest.leaves[place];
    if (leaf == kNoNode) return;
    const std::size_t size = leaves_.leaf_begin[place + 1] - leaves_.leaf_begin[place];
    join_within_cells(leaf, std::span(adjacency, size));
    for (const CellComponent& part : mesh_.leaves[leaf]) {
      const std::size_t begin = mesh_.cells.begin[part.cell];
      for (const Link& link : mesh_.links.links_of(part.cell)) {
        if ((link.boundary & part.lanes) == 0) continue;
        const std::size_t other = mesh_.cells.begin[link.leaf];
        for (const CrossEdge& edge : mesh_.links.cross_edges_of(link)) {
          if ((part.lanes >> edge.from & 1U) == 0) continue;
          const unsigned from = lane_of(slot_[begin + edge.from]);
          const std::uint32_t to = slot_[other + edge.to];
          if (leaf_of(to) == place) {
            adjacency[from] |= LaneMask{1} << lane_of(to);
          } else {
            exits.add(from, to);
          }
        }
      }
    }
  }

  /// Sets the edges of a leaf that lie within cells.
  void join_within_cells(std::size_t leaf, std::span<LaneMask> adjacency) const {
    const std::span<const CellComponent> parts = mesh_.leaves[leaf];
    const std::uint32_t first = parts.front().cell;
    if (parts.size() == 1 && mesh_.cells.size_of(first) == adjacency.size()) {
      // The vertices of a whole cell have their lanes already, as both are in the order of the caller's vertices.
      std::copy_n(mesh_.links.adjacency.begin() + mesh_.cells.begin[first], adjacency.size(), adjacency.begin());
      return;
    }
    std::fill(adjacency.begin(), adjacency.end(), LaneMask{0});
    for (const CellComponent& part : parts) {
      const std::size_t begin = mesh_.cells.begin[part.cell];
      for_each_lane(part.lanes, [&](unsigned from) {
        LaneMask& row = adjacency[lane_of(slot_[begin + from])];
        for_each_lane(mesh_.links.adjacency[begin + from],
                      [&](unsigned to) { row |= LaneMask{1} << lane_of(slot_[begin + to]); });
      });
    }
  }

  const Material& mesh_;
  std::span<const std::uint32_t> slot_;
  const LeafPartition& leaves_;
};

}  // namespace

void check_leaf_count(std::size_t leaves) {
  if (leaves <= kMaxLeaves) return;
  raise(ErrorCode::TooLarge,
        std::to_string(leaves) + " leaves in the index, but the limit is " + std::to_string(kMaxLeaves));
}

LeafPartition make_leaves(const PositionsView& positions, const EdgeSource& edges, const Frame& frame,
                          TaskContext& task) {
  Material mesh;
  mesh.cells = make_cells(positions, frame, task);
  task.advance(1);
  mesh.links = make_links(edges, mesh.cells.slot, mesh.cells.begin, task);
  task.advance(1);
  mesh.components = split_cells(mesh.cells, mesh.links, task);
  mesh.leaves = merge_small(mesh.components, mesh.links, task);

  LeafPartition result;
  result.forest = make_forest(graph_of_leaves(mesh, task), task);
  check_leaf_count(result.forest.leaves.size());
  const RawVector<std::uint32_t> slot = Placing(mesh, result).run(task);
  result.links = LeafLinker(mesh, slot, result).run(task);
  task.advance(1);
  return result;
}

}  // namespace meshhood::inline v0_1
