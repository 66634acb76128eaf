// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "paper/draft.h"
#include "support/families.h"
#include "support/oracle.h"

namespace meshhood::test {

using paper::ClusterId;
using paper::DraftLevel;
using paper::Partition;

/// The base level of `mesh`: one cluster for each vertex, siblings along the edges.
inline DraftLevel base_level(const TestMesh& mesh) {
  DraftLevel level;
  level.own_siblings = adjacency(mesh.view());
  level.siblings = level.own_siblings.view();
  level.vertex_count.assign(mesh.size(), 1);
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    level.position_sum.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
  }
  return level;
}

/// The base level of points on a line with these edges.
inline DraftLevel level_on_line(const std::vector<double>& xs,
                                const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges) {
  TestMesh mesh;
  for (const double x : xs) mesh.add_vertex(x, 0, 0);
  for (const auto& [v, w] : edges) mesh.add_face({v, w});
  return base_level(mesh.finish(false));
}

inline DraftLevel path_level(std::size_t size) {
  std::vector<double> xs;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t i = 0; i < size; ++i) {
    xs.push_back(i);
    if (i > 0) edges.emplace_back(i - 1, i);
  }
  return level_on_line(xs, edges);
}

inline DraftLevel star_level(std::uint32_t leaves) {
  std::vector<double> xs{0};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t i = 1; i <= leaves; ++i) {
    xs.push_back(i);
    edges.emplace_back(0, i);
  }
  return level_on_line(xs, edges);
}

/// The children of each cluster, without those whose parent is out of range.
inline std::vector<std::vector<std::uint32_t>> children_of(const Partition& partition) {
  std::vector<std::vector<std::uint32_t>> children(partition.clusters);
  for (std::uint32_t c = 0; c < partition.parent.size(); ++c) {
    if (partition.parent[c] < partition.clusters) children[partition.parent[c]].push_back(c);
  }
  return children;
}

inline std::vector<std::set<std::uint32_t>> sibling_sets(const DraftLevel& level) {
  std::vector<std::set<std::uint32_t>> sets;
  sets.reserve(level.size());
  for (std::size_t c = 0; c < level.size(); ++c) {
    sets.emplace_back(level.siblings[c].begin(), level.siblings[c].end());
  }
  return sets;
}

/// Whether each cluster of `level` has exactly one parent, each parent has children, and the children of each parent
/// are connected.
inline bool is_connected_partition(const DraftLevel& level, const Partition& partition) {
  const auto siblings = sibling_sets(level);
  const auto children = children_of(partition);
  std::size_t total = 0;
  for (std::size_t p = 0; p < children.size(); ++p) {
    if (children[p].empty()) return false;
    const auto in_cluster = [&](std::uint32_t c) { return partition.parent[c] == p; };
    if (connected(siblings, children[p].front(), in_cluster) != children[p]) return false;
    total += children[p].size();
  }
  return total == level.size() && partition.parent.size() == level.size();
}

/// Calls `f(mesh, level)` on `count` small meshes of all families, without those that have no vertex.
template <class F>
std::size_t for_each_small_level(std::size_t count, F&& f) {
  const std::vector<Family> all = families();
  std::size_t levels = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const TestMesh mesh = make_mesh(all[i % all.size()], i, 10 + i % 90);
    if (mesh.size() == 0) continue;
    f(mesh, base_level(mesh));
    ++levels;
  }
  return levels;
}

}  // namespace meshhood::test
