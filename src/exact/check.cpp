// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/index.h"

#include "exact/build/forest.h"
#include "exact/build/links.h"
#include "exact/build/tree.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/neighbors.h"
#include "exact/node_search.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kMaxFaults = 16;

/// Collects faults, up to a limit.
class Faults {
 public:
  /// Calls `text()` only if there is a fault to describe.
  template <class Text>
  void expect(bool holds, Text&& text) {
    if (!holds && found_.size() < kMaxFaults) found_.push_back(text());
  }

  [[nodiscard]] bool none() const { return found_.empty(); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(found_); }

 private:
  std::vector<std::string> found_;
};

std::string leaf_name(std::size_t leaf) { return "leaf " + std::to_string(leaf); }
std::string group_name(std::size_t group) { return "group " + std::to_string(group); }
std::string node_name(std::size_t node) { return "node " + std::to_string(node); }

/// Compares an index with the mesh that it should be built from.
class Check {
 public:
  Check(const IndexView& index, const GraphView& graph) : index_(index), graph_(graph) {}

  std::vector<std::string> run() {
    check_numbering();
    // The other checks look up vertices by their numbers.
    if (!faults_.none()) return faults_.take();
    check_positions();
    check_boundaries();
    check_edges();
    check_connected();
    check_forest();
    check_spheres();
    return faults_.take();
  }

 private:
  [[nodiscard]] std::size_t leaf_end(std::size_t leaf) const { return index_.leaf_begin[leaf + 1]; }
  [[nodiscard]] bool exists(std::size_t leaf) const { return leaf % kFanOut < index_.records[leaf / kFanOut].nodes; }

  void check_numbering() {
    const std::size_t vertices = graph_.positions.size();
    faults_.expect(index_.vertex_count() == vertices, [&] {
      return "the index has " + std::to_string(index_.vertex_count()) + " vertices, but the mesh has " +
             std::to_string(vertices);
    });
    if (!faults_.none()) return;
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      const std::size_t begin = index_.leaf_begin[leaf];
      const std::size_t end = leaf_end(leaf);
      const Leaf& record = index_.leaves[leaf];
      faults_.expect(
          begin <= end && end - begin <= kLeafCapacity && (begin < end) == exists(leaf) && record.first == begin &&
              record.size == end - begin,
          [&] { return leaf_name(leaf) + ": does not hold 1 to 32 vertices, or its record differs from leaf_begin"; });
      for (std::size_t v = begin; v < end && faults_.none(); ++v) {
        const VertexId old = index_.id(v);
        faults_.expect(old < vertices && index_.slot[old] == leaf * kLeafCapacity + (v - begin), [&] {
          return leaf_name(leaf) + ": vertex " + std::to_string(old) + " does not have the slot of its position";
        });
      }
    }
    const std::size_t numbered = index_.leaf_begin.back();
    faults_.expect(numbered == vertices, [&] {
      return "the leaves hold " + std::to_string(numbered) + " vertices, but the mesh has " + std::to_string(vertices);
    });
  }

  void check_positions() {
    for (std::size_t v = 0; v < index_.vertex_count(); ++v) {
      const Point mine = index_.position_of(static_cast<VertexId>(v));
      const Point given = point(graph_.positions, v);
      faults_.expect(mine.x == given.x && mine.y == given.y && mine.z == given.z,
                     [&] { return "vertex " + std::to_string(v) + ": its position differs from the mesh"; });
    }
  }

  void check_edges() {
    std::vector<std::vector<VertexId>> rows(index_.vertex_count());
    for_each_edge(index_, [&](std::size_t from, std::size_t to) { rows[index_.id(from)].push_back(index_.id(to)); });
    for (std::size_t v = 0; v < rows.size(); ++v) {
      std::sort(rows[v].begin(), rows[v].end());
      const auto given = graph_.adjacency[v];
      faults_.expect(std::equal(rows[v].begin(), rows[v].end(), given.begin(), given.end()),
                     [&] { return "vertex " + std::to_string(v) + ": its neighbors differ from the mesh"; });
    }
  }

  void check_boundaries() {
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      for (const Link& link : index_.links_of(leaf)) {
        LaneMask boundary = 0;
        for (const CrossEdge& edge : index_.cross_edges_of(link)) boundary |= LaneMask{1} << edge.from;
        faults_.expect(boundary == link.boundary, [&] {
          return leaf_name(leaf) + ": the boundary of its link to leaf " + std::to_string(link.leaf) +
                 " does not match the cross edges";
        });
      }
    }
  }

  void check_connected() {
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      const Leaf& record = index_.leaves[leaf];
      faults_.expect(
          record.connected == (record.size > 0 && is_connected(&index_.adjacency[record.first], record.size)),
          [&] { return leaf_name(leaf) + ": its mark as connected or not is wrong"; });
    }
  }

  void check_forest() {
    std::vector<std::uint32_t> first_link;
    for (const Leaf& leaf : index_.leaves) first_link.push_back(leaf.first_link);
    std::vector<GroupRecord> expected(index_.records.begin(), index_.records.end());
    set_vertices(index_.leaf_begin, index_.levels, expected);
    TaskContext task;
    const auto links = make_node_links(first_link, index_.links, index_.levels, index_.parents, expected, task);
    const auto is_same = [](const NodeLink& a, const NodeLink& b) { return a.node() == b.node() && a.mine == b.mine; };
    const bool same_links = std::ranges::equal(links, index_.node_links, is_same);
    faults_.expect(same_links, [] { return std::string("the links between nodes are not those of the leaves"); });
    for (std::size_t group = 0; group < expected.size(); ++group) {
      const GroupRecord& found = index_.records[group];
      faults_.expect(found.begin == expected[group].begin && found.linked == expected[group].linked,
                     [&] { return group_name(group) + ": its vertices or links are not those of its leaves"; });
      const NodeSet all = first_nodes(found.nodes);
      faults_.expect(index_.parents[group] == kNoNode || reachable_nodes(found.linked, 1, all) == all,
                     [&] { return group_name(group) + ": it has a parent, but its nodes are not connected by links"; });
    }
  }

  void check_spheres() {
    for (std::size_t v = 0; v < index_.vertex_count(); ++v) {
      const Point p = index_.frame.to_frame(index_.position_of(static_cast<VertexId>(v)));
      NodeId node = leaf_of(index_.slot[v]);
      faults_.expect(encloses(index_.leaves[node].bounds, p), [&] {
        return leaf_name(node) + ": vertex " + std::to_string(v) + " lies outside the bounding sphere";
      });
      for (; node != kNoNode; node = index_.parents[node / kFanOut]) {
        const Group& group = index_.groups[node / kFanOut];
        const std::size_t i = node % kFanOut;
        faults_.expect(encloses({group.x[i], group.y[i], group.z[i], group.radius[i]}, p), [&] {
          return node_name(node) + ": vertex " + std::to_string(v) + " lies outside the bounding sphere";
        });
      }
    }
  }

  static bool encloses(const FrameSphere& sphere, const Point& p) {
    return std::sqrt(squared_distance(center_of(sphere), p)) <= static_cast<double>(sphere.radius);
  }

  const IndexView& index_;
  GraphView graph_;
  Faults faults_;
};

}  // namespace

std::vector<std::string> Index::check(const MeshView& mesh) const {
  const Adjacency graph = adjacency(mesh);
  return Check(IndexAccess::whole(*this, "checked"), {mesh.positions, graph.view()}).run();
}

std::vector<std::string> Index::check(const GraphView& graph) const {
  validate(graph);
  return Check(IndexAccess::whole(*this, "checked"), graph).run();
}

}  // namespace meshhood::inline v0_1
