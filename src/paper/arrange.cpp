// SPDX-License-Identifier: MIT
// Makes the index order: from the highest level down, the children of each cluster get consecutive numbers. The
// vertices of each cluster then form one range (sec. 3: "precomputed groups of vertices contiguously stored").
#include <algorithm>
#include <numeric>
#include <utility>

#include "base/packed_positions.h"
#include "paper/draft.h"
#include "paper/hierarchy.h"

namespace meshhood::inline v0_1::paper {
namespace {

/// The new numbers of the clusters of a level: a permutation and its inverse.
struct Numbering {
  std::vector<ClusterId> old_id;  // by new number
  std::vector<ClusterId> new_id;  // by old number

  explicit Numbering(std::vector<ClusterId> order) : old_id(std::move(order)), new_id(old_id.size()) {
    for (std::size_t i = 0; i < old_id.size(); ++i) new_id[old_id[i]] = static_cast<ClusterId>(i);
  }
};

Numbering identity(std::size_t size) {
  std::vector<ClusterId> order(size);
  std::iota(order.begin(), order.end(), ClusterId{0});
  return Numbering(std::move(order));
}

/// Numbers the clusters of a level in the new order of their parents; the children of one keep their order.
Numbering number_below(const Numbering& above, const std::vector<ClusterId>& parent) {
  std::vector<ClusterId> new_parent(parent.size());
  for (std::size_t c = 0; c < parent.size(); ++c) new_parent[c] = above.new_id[parent[c]];
  return Numbering(child_lists(new_parent, above.old_id.size()).elements);
}

/// Returns the numberings, that of the base level first.
std::vector<Numbering> number_levels(const std::vector<std::vector<ClusterId>>& parents, std::size_t highest_size) {
  std::vector<Numbering> levels{identity(highest_size)};
  for (std::size_t l = parents.size(); l-- > 0;) levels.push_back(number_below(levels.back(), parents[l]));
  std::reverse(levels.begin(), levels.end());
  return levels;
}

/// Returns for each vertex its cluster on the level `lowest`.
std::vector<ClusterId> drop_lower(const std::vector<std::vector<ClusterId>>& parents, std::size_t vertices,
                                  std::size_t lowest) {
  std::vector<ClusterId> cluster(vertices);
  std::iota(cluster.begin(), cluster.end(), ClusterId{0});
  for (std::size_t l = 0; l < lowest; ++l) {
    for (ClusterId& c : cluster) c = parents[l][c];
  }
  return cluster;
}

/// Returns where the members of each cluster begin in the new order, and where they all end. `cluster` has the old
/// number of the cluster of each member.
std::vector<ClusterId> first_members(const std::vector<ClusterId>& cluster, const Numbering& numbering) {
  std::vector<ClusterId> first(numbering.old_id.size() + 1, 0);
  for (const ClusterId c : cluster) ++first[numbering.new_id[c] + std::size_t{1}];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

Adjacency renumber(const AdjacencyView& siblings, const Numbering& numbering) {
  Adjacency result;
  result.offsets.reserve(siblings.size() + 1);
  result.neighbors.reserve(siblings.neighbors.size());
  result.offsets.push_back(0);
  for (const ClusterId cluster : numbering.old_id) {
    const auto row_begin = static_cast<std::ptrdiff_t>(result.neighbors.size());
    for (const ClusterId sibling : siblings[cluster]) result.neighbors.push_back(numbering.new_id[sibling]);
    std::sort(result.neighbors.begin() + row_begin, result.neighbors.end());
    result.offsets.push_back(static_cast<EdgeOffset>(result.neighbors.size()));
  }
  return result;
}

/// `members` states where the members of each cluster begin: vertices on the lowest level, children above.
template <class Real>
Level<Real> fill_level(std::size_t number, std::vector<ClusterId> members, Adjacency siblings, bool is_lowest) {
  Level<Real> level;
  level.number = static_cast<int>(number);
  (is_lowest ? level.first_vertex : level.first_child) = std::move(members);
  level.siblings = std::move(siblings);
  return level;
}

}  // namespace

template <class Real>
Hierarchy<Real> arrange(std::span<const Real> xyz, const std::vector<std::vector<ClusterId>>& parents,
                        const std::vector<AdjacencyView>& siblings, std::size_t lowest) {
  std::vector<Numbering> levels = number_levels(parents, siblings.back().size());
  Hierarchy<Real> result;
  for (std::size_t l = lowest; l < levels.size(); ++l) {
    const bool is_lowest = l == lowest;
    const auto members = is_lowest ? first_members(drop_lower(parents, xyz.size() / 3, lowest), levels[l])
                                   : first_members(parents[l - 1], levels[l]);
    result.levels.push_back(fill_level<Real>(l, members, renumber(siblings[l], levels[l]), is_lowest));
  }
  result.vertices = std::move(levels.front().old_id);
  result.positions = rows_of(xyz, std::span<const VertexId>(result.vertices));
  derive(result);
  return result;
}

template Hierarchy<float> arrange(std::span<const float> xyz, const std::vector<std::vector<ClusterId>>& parents,
                                  const std::vector<AdjacencyView>& siblings, std::size_t lowest);
template Hierarchy<double> arrange(std::span<const double> xyz, const std::vector<std::vector<ClusterId>>& parents,
                                   const std::vector<AdjacencyView>& siblings, std::size_t lowest);

}  // namespace meshhood::inline v0_1::paper
