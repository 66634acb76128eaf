// SPDX-License-Identifier: MIT
#include "paper/file_levels.h"

#include "paper/arrange.h"
#include "paper/link.h"

namespace meshhood::paper {
namespace {

template <class Real>
void add_parents(const Level<Real>& level, Level<Real>& below) {
  below.parent.resize(below.size());
  for (std::size_t c = 0; c + 1 < level.first_child.size(); ++c) {
    for (std::size_t child = level.first_child[c]; child < level.first_child[c + 1]; ++child) {
      below.parent[child] = static_cast<ClusterId>(c);
    }
  }
}

template <class Real>
void add_first_vertices(Level<Real>& level, const Level<Real>& below) {
  level.first_vertex.reserve(level.first_child.size());
  for (const ClusterId child : level.first_child) level.first_vertex.push_back(below.first_vertex[child]);
}

}  // namespace

template <class Real>
void complete(Hierarchy<Real>& hierarchy) {
  for (std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
    Level<Real>& level = hierarchy.levels[l];
    if (l > 0) {
      add_parents(level, hierarchy.levels[l - 1]);
      add_first_vertices(level, hierarchy.levels[l - 1]);
    }
    level.mean_radius = mean_radius(level);
  }
  hierarchy.lowest_cluster = cluster_of_vertex(hierarchy.levels.front().first_vertex, hierarchy.vertices);
}

template void complete(Hierarchy<float>& hierarchy);
template void complete(Hierarchy<double>& hierarchy);

}  // namespace meshhood::paper
