// SPDX-License-Identifier: MIT
// The order of the index. From the highest level down, the children of a cluster are numbered one after the other; on
// the base level this puts the vertices of every cluster of every level side by side in memory (sec. 3: "precomputed
// groups of vertices contiguously stored").
#include "paper/arrange.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "paper/group.h"

namespace meshhood::paper {
namespace {

/// order[i]: the cluster of a level that comes at place `i`; place: the inverse.
struct Order {
  std::vector<ClusterId> order;
  std::vector<ClusterId> place;
};

Order identity(std::size_t size) {
  Order result{std::vector<ClusterId>(size), std::vector<ClusterId>(size)};
  std::iota(result.order.begin(), result.order.end(), ClusterId{0});
  result.place = result.order;
  return result;
}

/// The clusters of a level in the order of their parents, and by number among the children of one.
Order below(const Order& parents, const std::vector<ClusterId>& parent) {
  std::vector<ClusterId> parent_place(parent.size());
  for (std::size_t c = 0; c < parent.size(); ++c) parent_place[c] = parents.place[parent[c]];
  Order result{group(parent_place, parents.order.size()).members, std::vector<ClusterId>(parent.size())};
  for (std::size_t i = 0; i < result.order.size(); ++i) result.place[result.order[i]] = static_cast<ClusterId>(i);
  return result;
}

/// orders[l]: of level `l`, from the base level to the highest.
std::vector<Order> order_levels(const std::vector<std::vector<ClusterId>>& parents, std::size_t highest_size) {
  std::vector<Order> orders(parents.size() + 1);
  orders.back() = identity(highest_size);
  for (std::size_t l = parents.size(); l-- > 0;) orders[l] = below(orders[l + 1], parents[l]);
  return orders;
}

Adjacency rename(const AdjacencyView& siblings, const Order& order) {
  Adjacency result;
  result.offsets.reserve(siblings.size() + 1);
  result.neighbors.reserve(siblings.neighbors.size());
  result.offsets.push_back(0);
  for (const ClusterId cluster : order.order) {
    const auto row_begin = static_cast<std::ptrdiff_t>(result.neighbors.size());
    for (const ClusterId sibling : siblings[cluster]) result.neighbors.push_back(order.place[sibling]);
    std::sort(result.neighbors.begin() + row_begin, result.neighbors.end());
    result.offsets.push_back(static_cast<EdgeOffset>(result.neighbors.size()));
  }
  return result;
}

/// Where the parents of the clusters of a level come on the level above; the clusters in their new order.
std::vector<ClusterId> parent_places(const Order& level, const std::vector<ClusterId>& parent, const Order& above) {
  std::vector<ClusterId> result(level.order.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = above.place[parent[level.order[i]]];
  return result;
}

/// Where the children of each of `size` parents begin. parent: of the children in order, so ascending.
std::vector<ClusterId> first_children(const std::vector<ClusterId>& parent, std::size_t size) {
  std::vector<ClusterId> first(size + 1, 0);
  for (const ClusterId p : parent) ++first[p + std::size_t{1}];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

template <class Real>
std::vector<Real> permute(std::span<const Real> xyz, const std::vector<VertexId>& vertices) {
  std::vector<Real> result;
  result.reserve(xyz.size());
  for (const VertexId v : vertices) result.insert(result.end(), {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
  return result;
}

}  // namespace

PackedIds cluster_of_vertex(const std::vector<VertexId>& first_vertex, const std::vector<VertexId>& vertices) {
  const std::size_t clusters = first_vertex.size() - 1;
  PackedIds result(vertices.size(), clusters);
  for (std::size_t c = 0; c < clusters; ++c) {
    for (std::size_t i = first_vertex[c]; i < first_vertex[c + 1]; ++i) result.set(vertices[i], c);
  }
  return result;
}

template <class Real>
Hierarchy<Real> arrange(std::span<const Real> xyz, const std::vector<std::vector<ClusterId>>& parents,
                        const std::vector<AdjacencyView>& siblings, std::size_t lowest) {
  const std::vector<Order> orders = order_levels(parents, siblings.back().size());
  Hierarchy<Real> result;
  result.vertices = orders[0].order;
  result.positions = permute(xyz, result.vertices);

  std::vector<VertexId> first_vertex(result.vertices.size() + 1);
  std::iota(first_vertex.begin(), first_vertex.end(), VertexId{0});
  for (std::size_t l = 0; l < orders.size(); ++l) {
    Level<Real> level;
    level.number = static_cast<int>(l);
    if (l > 0) {
      std::vector<ClusterId> parent = parent_places(orders[l - 1], parents[l - 1], orders[l]);
      level.first_child = first_children(parent, orders[l].order.size());
      std::vector<VertexId> first(level.first_child.size());
      for (std::size_t c = 0; c < first.size(); ++c) first[c] = first_vertex[level.first_child[c]];
      first_vertex = std::move(first);
      if (l > lowest) result.levels.back().parent = std::move(parent);
    }
    if (l < lowest) continue;
    level.first_vertex = first_vertex;
    level.siblings = rename(siblings[l], orders[l]);
    result.levels.push_back(std::move(level));
  }
  result.levels.front().first_child = {};
  result.lowest_cluster = cluster_of_vertex(result.levels.front().first_vertex, result.vertices);
  return result;
}

template Hierarchy<float> arrange(std::span<const float> xyz, const std::vector<std::vector<ClusterId>>& parents,
                                  const std::vector<AdjacencyView>& siblings, std::size_t lowest);
template Hierarchy<double> arrange(std::span<const double> xyz, const std::vector<std::vector<ClusterId>>& parents,
                                   const std::vector<AdjacencyView>& siblings, std::size_t lowest);

}  // namespace meshhood::paper
