// SPDX-License-Identifier: MIT
// Verifies the definitions of sec. 3.1 on a finished index, one by one. The expected values are computed from the mesh
// again; of the code that builds the index, only the distance is used. docs/paper.md lists the invariants I1 to I8.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/paper.h"

#include "base/lists.h"
#include "paper/hierarchy.h"
#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood::inline v0_1::paper {
namespace {

constexpr std::size_t kMostFaults = 16;
constexpr VertexId kNoPosition = static_cast<VertexId>(-1);

template <class Real>
class Check {
 public:
  Check(const Hierarchy<Real>& hierarchy, const GraphView& graph) : hierarchy_(hierarchy), graph_(graph) {}

  /// Each test relies on the structure that the tests before it have verified, so a fault there ends the check.
  std::vector<std::string> run() {
    if (!vertices_agree()) return std::move(faults_);
    for (level_ = 0; level_ < hierarchy_.levels.size(); ++level_) {
      if (!is_partition() || !families_agree() || !siblings_are_edges()) break;
      clusters_are_connected();
      spheres_enclose();
      averages_agree();
      level_shrinks();
    }
    return std::move(faults_);
  }

 private:
  [[nodiscard]] const Level<Real>& level() const { return hierarchy_.levels[level_]; }
  [[nodiscard]] const Level<Real>& below() const { return hierarchy_.levels[level_ - 1]; }

  bool fault(std::string text) {
    if (faults_.size() < kMostFaults) faults_.push_back(std::move(text));
    return false;
  }

  bool level_fault(const std::string& text) { return fault("level " + std::to_string(level().number) + ": " + text); }

  bool cluster_fault(std::size_t cluster, const std::string& text) {
    return fault("level " + std::to_string(level().number) + ", cluster " + std::to_string(cluster) + ": " + text);
  }

  /// The index order is a permutation of the vertices of the mesh, with their positions.
  bool vertices_agree() {
    const auto& vertices = hierarchy_.vertices;
    if (vertices.size() != graph_.positions.size()) {
      return fault(std::to_string(vertices.size()) + " vertices in the index, but the mesh has " +
                   std::to_string(graph_.positions.size()));
    }
    position_.assign(vertices.size(), kNoPosition);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const VertexId v = vertices[i];
      if (v >= vertices.size() || position_[v] != kNoPosition) {
        return fault("index order, position " + std::to_string(i) + ": vertex " + std::to_string(v) +
                     " is out of range or occurs twice");
      }
      position_[v] = static_cast<VertexId>(i);
      if (!same_position(i, v)) fault("vertex " + std::to_string(v) + ": its position differs from that of the mesh");
    }
    return faults_.empty();
  }

  [[nodiscard]] bool same_position(std::size_t i, VertexId v) const {
    const Point kept = point<Real>(hierarchy_.positions, i);
    const Point given = point(graph_.positions, v);
    return kept.x == given.x && kept.y == given.y && kept.z == given.z;
  }

  /// I1: the ranges of the clusters are consecutive and not empty, from the first vertex to the last.
  bool is_partition() {
    const std::vector<VertexId>& first = level().first_vertex;
    if (first.empty() || first.front() != 0 || first.back() != hierarchy_.vertices.size()) {
      return level_fault("its clusters do not cover all vertices");
    }
    cluster_at_.resize(hierarchy_.vertices.size());
    for (std::size_t c = 0; c < level().size(); ++c) {
      if (first[c] >= first[c + 1] || first[c + 1] > cluster_at_.size()) return cluster_fault(c, "it has no vertices");
      std::fill(cluster_at_.begin() + first[c], cluster_at_.begin() + first[c + 1], static_cast<ClusterId>(c));
    }
    return true;
  }

  /// I2: a vertex refers to its lowest cluster; a parent is the union of its children, and they refer to it.
  bool families_agree() { return level_ == 0 ? lowest_clusters_agree() : children_agree(); }

  bool lowest_clusters_agree() {
    for (std::size_t i = 0; i < cluster_at_.size(); ++i) {
      const VertexId v = hierarchy_.vertices[i];
      if (hierarchy_.lowest_cluster[v] != cluster_at_[i]) {
        cluster_fault(cluster_at_[i], "its vertex " + std::to_string(v) + " refers to another cluster");
      }
    }
    return faults_.empty();
  }

  bool children_agree() {
    const std::vector<ClusterId>& first = level().first_child;
    if (first.size() != level().size() + 1 || first.front() != 0 || first.back() != below().size() ||
        below().parent.size() != below().size() || level().number != below().number + 1) {
      return level_fault("its children are not the clusters of the level below");
    }
    for (std::size_t c = 0; c < level().size(); ++c) {
      if (first[c] >= first[c + 1] || first[c + 1] > below().size()) return cluster_fault(c, "it has no children");
      if (below().first_vertex[first[c]] != level().first_vertex[c] ||
          below().first_vertex[first[c + 1]] != level().first_vertex[c + 1]) {
        cluster_fault(c, "its vertices are not those of its children");
      }
      const auto begin = below().parent.begin();
      if (std::any_of(begin + first[c], begin + first[c + 1], [&](ClusterId parent) { return parent != c; })) {
        cluster_fault(c, "a child refers to another parent");
      }
    }
    return faults_.empty();
  }

  /// I5: the siblings are exactly the clusters that an edge of the mesh joins to this one.
  bool siblings_are_edges() {
    const AdjacencyView siblings = level().siblings.view();
    if (siblings.size() != level().size())
      return level_fault("the number of sibling rows differs from the number of clusters");
    if (siblings.offsets.front() != 0 || siblings.offsets.back() != siblings.neighbors.size() ||
        !std::is_sorted(siblings.offsets.begin(), siblings.offsets.end())) {
      return level_fault("the sibling rows are not in order");
    }
    std::vector<ClusterId> joined;
    for (std::size_t c = 0; c < level().size(); ++c) {
      clusters_joined_to(c, joined);
      const auto row = siblings[c];
      if (!std::equal(row.begin(), row.end(), joined.begin(), joined.end())) {
        cluster_fault(c, "its siblings are not the clusters that an edge of the mesh joins to it");
      }
    }
    return faults_.empty();
  }

  void clusters_joined_to(std::size_t c, std::vector<ClusterId>& joined) const {
    joined.clear();
    for (std::size_t i = level().first_vertex[c]; i < level().first_vertex[c + 1]; ++i) {
      for (const VertexId w : graph_.adjacency[hierarchy_.vertices[i]]) {
        if (cluster_at_[position_[w]] != c) joined.push_back(cluster_at_[position_[w]]);
      }
    }
    sort_out(joined);
  }

  /// I3, and so I6: vertices that are connected on the mesh lie in one component.
  void clusters_are_connected() {
    std::vector<bool> reached(hierarchy_.vertices.size(), false);
    std::vector<VertexId> queue;
    for (std::size_t c = 0; c < level().size(); ++c) {
      const VertexId first = level().first_vertex[c];
      reached[first] = true;
      queue.assign(1, first);
      for (std::size_t head = 0; head < queue.size(); ++head) {
        for (const VertexId w : graph_.adjacency[hierarchy_.vertices[queue[head]]]) {
          const VertexId i = position_[w];
          if (cluster_at_[i] != c || reached[i]) continue;
          reached[i] = true;
          queue.push_back(i);
        }
      }
      if (queue.size() != level().first_vertex[c + 1] - std::size_t{first}) cluster_fault(c, "it is not connected");
    }
  }

  /// I4, with the distances of the query; the sphere of a single vertex has radius 0.
  void spheres_enclose() {
    if (level().spheres.size() != level().size()) {
      level_fault("the number of spheres differs from the number of clusters");
      return;
    }
    for (std::size_t c = 0; c < level().size(); ++c) {
      const Sphere<Real>& sphere = level().spheres[c];
      const auto radius = static_cast<double>(sphere.radius);
      const std::size_t first = level().first_vertex[c];
      const std::size_t end = level().first_vertex[c + 1];
      const bool fits = end - first == 1 ? radius == 0 : std::isfinite(radius) && radius >= 0;
      if (!fits) cluster_fault(c, std::to_string(end - first) + " vertices, but radius " + to_text(radius));
      for (std::size_t i = first; i < end; ++i) {
        const double d2 = squared_distance(center_of(sphere), point<Real>(hierarchy_.positions, i));
        if (std::sqrt(d2) <= radius) continue;
        cluster_fault(c, "its vertex " + std::to_string(hierarchy_.vertices[i]) + " lies outside its sphere");
      }
    }
  }

  /// I8: the mean radius is that of the spheres.
  void averages_agree() {
    double sum = 0;
    for (const Sphere<Real>& sphere : level().spheres) sum += static_cast<double>(sphere.radius);
    const double mean = level().size() == 0 ? 0.0 : sum / static_cast<double>(level().size());
    if (std::isfinite(mean) && level().mean_radius == mean) return;
    level_fault("mean radius " + to_text(level().mean_radius) + ", but the spheres give " + to_text(mean));
  }

  /// I7: a cluster with siblings has at least two children. So of the clusters with siblings, each level has at most
  /// half as many as the one below.
  void level_shrinks() {
    if (level_ == 0) return;
    for (std::size_t c = 0; c < level().size(); ++c) {
      if (level().first_child[c + 1] - level().first_child[c] > 1 || level().siblings.view()[c].empty()) continue;
      cluster_fault(c, "it has a single child although it has siblings");
    }
  }

  const Hierarchy<Real>& hierarchy_;
  const GraphView& graph_;
  std::size_t level_ = 0;              // the level under test, counted from the lowest one kept
  std::vector<VertexId> position_;     // by vertex: its position in the index order
  std::vector<ClusterId> cluster_at_;  // by position: its cluster on the level under test
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> Index::check(const GraphView& graph) const {
  validate(graph);
  return std::visit([&]<class Real>(const Hierarchy<Real>& hierarchy) { return Check<Real>(hierarchy, graph).run(); },
                    storage_->hierarchy);
}

std::vector<std::string> Index::check(const MeshView& mesh) const {
  const Adjacency graph = adjacency(mesh);
  return check(GraphView{mesh.positions, graph.view()});
}

}  // namespace meshhood::inline v0_1::paper
