// SPDX-License-Identifier: MIT
// The definitions of sec. 3.1, verified one by one on a finished index. What is checked here is read off the mesh anew;
// nothing that built the index is called, but for the distance.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/paper.h"

#include "distance.h"
#include "paper/hierarchy.h"
#include "text.h"

namespace meshhood::paper {
namespace {

constexpr std::size_t kMostFaults = 16;

template <class Real>
class Check {
 public:
  Check(const Hierarchy<Real>& hierarchy, const GraphView& graph) : hierarchy_(hierarchy), graph_(graph) {}

  /// Each test may rely on the structure that those before it have found sound, so the first that fails ends the check.
  std::vector<std::string> run() {
    if (!vertices_agree()) return std::move(faults_);
    for (std::size_t l = 0; l < hierarchy_.levels.size(); ++l) {
      if (!level_is_partition(l) || !links_agree(l) || !siblings_are_edges(l)) return std::move(faults_);
      clusters_are_connected(l);
      spheres_enclose(l);
      averages_agree(l);
      level_shrinks(l);
    }
    return std::move(faults_);
  }

 private:
  using LevelOf = Level<Real>;

  [[nodiscard]] const LevelOf& level(std::size_t l) const { return hierarchy_.levels[l]; }

  /// Notes `fault` unless `holds`; returns `holds`.
  bool expect(bool holds, const std::string& fault) {
    if (!holds && faults_.size() < kMostFaults) faults_.push_back(fault);
    return holds;
  }

  [[nodiscard]] std::string name(std::size_t l, std::size_t cluster) const {
    return "level " + std::to_string(level(l).number) + ", cluster " + std::to_string(cluster) + ": ";
  }

  /// The index order is a permutation of the vertices of the mesh, and carries their positions.
  bool vertices_agree() {
    const auto& vertices = hierarchy_.vertices;
    if (!expect(vertices.size() == graph_.positions.size(), std::to_string(vertices.size()) +
                                                                " vertices in the index, but the mesh has " +
                                                                std::to_string(graph_.positions.size()))) {
      return false;
    }
    place_.assign(vertices.size(), kUnplaced);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const VertexId v = vertices[i];
      const bool valid = v < vertices.size() && place_[v] == kUnplaced;
      if (!expect(valid, "index order, place " + std::to_string(i) + ": vertex " + std::to_string(v) +
                             " is out of range or stands there twice")) {
        return false;
      }
      place_[v] = static_cast<VertexId>(i);
      expect(same_position(i, v), "vertex " + std::to_string(v) + ": its position is not that of the mesh");
    }
    return faults_.empty();
  }

  [[nodiscard]] bool same_position(std::size_t i, VertexId v) const {
    return graph_.positions.visit([&](auto xyz) {
      const Point mine = point<Real>(hierarchy_.positions, i);
      const Point theirs = point(xyz, v);
      return mine.x == theirs.x && mine.y == theirs.y && mine.z == theirs.z;
    });
  }

  /// I1: the ranges of the clusters follow each other, none empty, from the first vertex to the last.
  bool level_is_partition(std::size_t l) {
    const std::vector<VertexId>& first = level(l).first_vertex;
    bool holds = expect(!first.empty() && first.front() == 0 && first.back() == hierarchy_.vertices.size(),
                        "level " + std::to_string(level(l).number) + ": its clusters do not span all vertices");
    for (std::size_t c = 0; holds && c < level(l).size(); ++c) {
      holds = expect(first[c] < first[c + 1], name(l, c) + "no vertices");
    }
    if (!holds) return false;
    cluster_at_.assign(hierarchy_.vertices.size(), 0);
    for (std::size_t c = 0; c < level(l).size(); ++c) {
      std::fill(cluster_at_.begin() + first[c], cluster_at_.begin() + first[c + 1], static_cast<ClusterId>(c));
    }
    return true;
  }

  /// I2: vertices name their lowest cluster; a parent has exactly the vertices of its children, which name it.
  bool links_agree(std::size_t l) {
    if (l == 0) {
      for (std::size_t i = 0; i < cluster_at_.size(); ++i) {
        expect(hierarchy_.lowest_cluster[hierarchy_.vertices[i]] == cluster_at_[i],
               name(0, cluster_at_[i]) + "vertex " + std::to_string(hierarchy_.vertices[i]) + " names another cluster");
      }
      return faults_.empty();
    }
    const LevelOf& below = level(l - 1);
    const std::vector<ClusterId>& first = level(l).first_child;
    if (!expect(first.size() == level(l).size() + 1 && first.front() == 0 && first.back() == below.size() &&
                    below.parent.size() == below.size() && level(l).number == below.number + 1,
                "level " + std::to_string(level(l).number) + ": its children are not the level below")) {
      return false;
    }
    for (std::size_t c = 0; c < level(l).size(); ++c) {
      if (!expect(first[c] < first[c + 1] && first[c + 1] <= below.size(), name(l, c) + "no children")) return false;
      expect(below.first_vertex[first[c]] == level(l).first_vertex[c] &&
                 below.first_vertex[first[c + 1]] == level(l).first_vertex[c + 1],
             name(l, c) + "its vertices are not those of its children");
      for (ClusterId child = first[c]; child < first[c + 1]; ++child) {
        expect(below.parent[child] == c, name(l - 1, child) + "names another parent");
      }
    }
    return faults_.empty();
  }

  /// I5: the siblings are the pairs of clusters that an edge of the mesh joins, each from both sides.
  bool siblings_are_edges(std::size_t l) {
    const AdjacencyView siblings = level(l).siblings.view();
    if (!expect(siblings.size() == level(l).size(), "level " + std::to_string(level(l).number) + ": " +
                                                        std::to_string(siblings.size()) + " rows of siblings")) {
      return false;
    }
    std::vector<ClusterId> joined;
    for (std::size_t c = 0; c < level(l).size(); ++c) {
      joined.clear();
      for (std::size_t i = level(l).first_vertex[c]; i < level(l).first_vertex[c + 1]; ++i) {
        for (const VertexId w : graph_.adjacency[hierarchy_.vertices[i]]) {
          if (cluster_at_[place_[w]] != c) joined.push_back(cluster_at_[place_[w]]);
        }
      }
      std::sort(joined.begin(), joined.end());
      joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
      const auto row = siblings[c];
      expect(std::equal(row.begin(), row.end(), joined.begin(), joined.end()),
             name(l, c) + "its siblings are not the clusters that an edge joins it to");
    }
    return faults_.empty();
  }

  /// I3 and I6: what is connected on the mesh lies in one component of it.
  void clusters_are_connected(std::size_t l) {
    std::vector<bool> reached(hierarchy_.vertices.size(), false);
    std::vector<VertexId> queue;
    for (std::size_t c = 0; c < level(l).size(); ++c) {
      const VertexId first = level(l).first_vertex[c];
      reached[first] = true;
      queue.assign(1, first);
      for (std::size_t head = 0; head < queue.size(); ++head) {
        for (const VertexId w : graph_.adjacency[hierarchy_.vertices[queue[head]]]) {
          const VertexId i = place_[w];
          if (cluster_at_[i] != c || reached[i]) continue;
          reached[i] = true;
          queue.push_back(i);
        }
      }
      expect(queue.size() == level(l).first_vertex[c + 1] - std::size_t{first}, name(l, c) + "not connected");
    }
  }

  /// I4: under the arithmetic of the query; a base cluster is its vertex.
  void spheres_enclose(std::size_t l) {
    if (!expect(level(l).spheres.size() == level(l).size(),
                "level " + std::to_string(level(l).number) + ": not one sphere a cluster")) {
      return;
    }
    for (std::size_t c = 0; c < level(l).size(); ++c) {
      const Sphere<Real>& sphere = level(l).spheres[c];
      const auto radius = static_cast<double>(sphere.radius);
      const Point centre{static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z)};
      const VertexId first = level(l).first_vertex[c];
      const VertexId end = level(l).first_vertex[c + 1];
      expect(std::isfinite(radius) && radius >= 0, name(l, c) + "radius " + to_text(radius));
      if (end - first == 1) expect(radius == 0, name(l, c) + "a single vertex, but radius " + to_text(radius));
      for (std::size_t i = first; i < end; ++i) {
        const double distance = std::sqrt(squared_distance(centre, point<Real>(hierarchy_.positions, i)));
        expect(distance <= radius,
               name(l, c) + "vertex " + std::to_string(hierarchy_.vertices[i]) + " lies outside its sphere");
      }
    }
  }

  /// I8.
  void averages_agree(std::size_t l) {
    double sum = 0;
    for (const Sphere<Real>& sphere : level(l).spheres) sum += static_cast<double>(sphere.radius);
    const double mean = level(l).size() == 0 ? 0.0 : sum / static_cast<double>(level(l).size());
    expect(std::isfinite(level(l).mean_radius) && level(l).mean_radius == mean,
           "level " + std::to_string(level(l).number) + ": mean radius " + to_text(level(l).mean_radius) +
               ", but the spheres give " + to_text(mean));
  }

  /// I7: each level halves what the one below it has in every component, until the component is a single cluster.
  void level_shrinks(std::size_t l) {
    if (l == 0) return;
    for (std::size_t c = 0; c < level(l).size(); ++c) {
      const bool single_child = level(l).first_child[c + 1] - level(l).first_child[c] == 1;
      expect(!single_child || level(l).siblings.view()[c].empty(), name(l, c) + "a single child, but siblings");
    }
  }

  static constexpr VertexId kUnplaced = static_cast<VertexId>(-1);

  const Hierarchy<Real>& hierarchy_;
  const GraphView& graph_;
  std::vector<VertexId> place_;        // by vertex: its place in the index order
  std::vector<ClusterId> cluster_at_;  // by place: its cluster on the level under test
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

}  // namespace meshhood::paper
