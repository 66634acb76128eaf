// SPDX-License-Identifier: MIT
// Nodes that are divided into connected parts, as `dissolve_small_parts` changes them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/build/node_parts.h"

namespace meshhood::test {

struct DividedNodes {
  NodeGraph graph;
  std::vector<std::vector<std::uint32_t>> parts;  // connected, of up to eight nodes

  [[nodiscard]] NodeParts node_parts() const {
    NodeParts result(graph);
    for (const auto& part : parts) result.add(part);
    return result;
  }
};

using NodeLinks = std::vector<std::set<std::uint32_t>>;  // by node

/// A number of any size that a level may hold: all equal, small integers, denormal, at the limit of coordinates.
/// `draw.below(n)` gives a number below `n`.
template <class Draw>
double draw_extent(Draw& draw, std::size_t kind) {
  const auto number = static_cast<double>(draw.below(9));
  switch (kind) {
    case 0: return 1;
    case 1: return number;
    case 2: return std::ldexp(number, -1074);
    case 3: return std::ldexp(number, 496);
    default: return std::ldexp(number, static_cast<int>(draw.below(1000)) - 504);
  }
}

/// Links of a chain, of a star, in small components, or anywhere.
template <class Draw>
NodeLinks draw_links(Draw& draw, std::size_t nodes) {
  NodeLinks links(nodes);
  const auto link = [&](std::size_t a, std::size_t b) {
    if (a == b) return;
    links[a].insert(static_cast<std::uint32_t>(b));
    links[b].insert(static_cast<std::uint32_t>(a));
  };
  const std::size_t kind = draw.below(5);
  for (std::size_t node = 1; node < nodes; ++node) {
    switch (kind) {
      case 0: break;
      case 1: link(node - 1, node); break;
      case 2: link(0, node); break;
      case 3: link(node, node - node % 5); break;
      default: link(node, draw.below(node)); break;
    }
  }
  for (std::size_t more = draw.below(2 * nodes); more > 0; --more) link(draw.below(nodes), draw.below(nodes));
  return links;
}

/// Up to 64 nodes of any place and size.
template <class Draw>
NodeGraph draw_node_graph(Draw& draw) {
  NodeGraph graph;
  const NodeLinks links = draw_links(draw, 1 + draw.below(64));
  const std::size_t kind = draw.below(5);
  auto& [offsets, neighbors] = graph.neighbors;
  for (const auto& row : links) {
    const auto signed_extent = [&] { return (draw.below(2) == 0 ? 1 : -1) * draw_extent(draw, kind); };
    const double x = signed_extent();
    const double y = signed_extent();
    graph.balls.push_back({{x, y, signed_extent()}, draw_extent(draw, kind)});
    neighbors.insert(neighbors.end(), row.begin(), row.end());
    offsets.push_back(static_cast<std::uint32_t>(neighbors.size()));
  }
  return graph;
}

/// Connected parts that grow along links to sizes drawn at random.
template <class Draw>
DividedNodes draw_divided_nodes(Draw& draw) {
  DividedNodes result{draw_node_graph(draw), {}};
  std::vector<bool> taken(result.graph.size());
  for (std::uint32_t first = 0; first < result.graph.size(); ++first) {
    if (taken[first]) continue;
    taken[first] = true;
    std::vector<std::uint32_t> part{first};
    const std::size_t most = 1 + draw.below(kFanOut);
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const std::uint32_t next : result.graph[part[i]]) {
        if (taken[next] || part.size() == most) continue;
        taken[next] = true;
        part.push_back(next);
      }
    }
    result.parts.push_back(std::move(part));
  }
  return result;
}

[[nodiscard]] inline bool are_connected(const NodeGraph& graph, std::span<const std::uint32_t> nodes) {
  std::vector<std::uint32_t> reached(nodes.begin(), nodes.begin() + std::min<std::ptrdiff_t>(1, std::ssize(nodes)));
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const std::uint32_t next : graph[reached[i]]) {
      const bool is_new = std::ranges::find(reached, next) == reached.end();
      if (is_new && std::ranges::find(nodes, next) != nodes.end()) reached.push_back(next);
    }
  }
  return reached.size() == nodes.size();
}

/// What is wrong with the parts that `dissolve_small_parts` has made of `before`; empty if nothing is.
[[nodiscard]] inline std::string fault_of(const DividedNodes& before, const NodeParts& after) {
  // A part may be computed from its nodes in another order.
  const double widest = 1.5 * before.node_parts().mean_full_radius() * (1 + 1e-12);
  std::size_t nodes = 0;
  for (std::uint32_t part = 0; part < after.size(); ++part) {
    const std::vector<std::uint32_t>& old = before.parts[part];
    nodes += after[part].size();
    const auto is_here = [&](std::uint32_t node) { return after.part_of(node) == part; };
    if (after[part].size() > kFanOut) return "a part has more than eight nodes";
    if (!std::ranges::all_of(after[part], is_here)) return "a node is in a part other than its own";
    if (!are_connected(before.graph, after[part])) return "a part is not connected";
    const auto stayed = std::ranges::count_if(old, is_here);
    if (stayed != 0 && stayed != std::ssize(old)) return "a part is half dissolved";
    const bool has_grown = after[part].size() > old.size();
    if (has_grown && ball_of(before.graph, after[part]).radius > widest) return "a part is too wide";
  }
  return nodes == before.graph.size() ? "" : "a node is in no part, or in two";
}

}  // namespace meshhood::test
