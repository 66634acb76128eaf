// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "exact/build/node_groups.h"

namespace meshhood::test {

/// Nodes on a line, at their numbers, and links between some of them.
[[nodiscard]] inline NodeGraph node_line(std::size_t nodes,
                                         const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links) {
  NodeGraph graph;
  for (std::uint32_t node = 0; node < nodes; ++node) {
    graph.balls.push_back({{static_cast<double>(node), 0, 0}, 0.5});
    for (const auto& [a, b] : links) {
      if (a == node) graph.neighbors.elements.push_back(b);
      if (b == node) graph.neighbors.elements.push_back(a);
    }
    graph.neighbors.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.elements.size()));
  }
  return graph;
}

/// Links between each two successive nodes from `first` to `last`.
[[nodiscard]] inline std::vector<std::pair<std::uint32_t, std::uint32_t>> chain(std::uint32_t first,
                                                                                std::uint32_t last) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  for (std::uint32_t node = first; node < last; ++node) links.emplace_back(node, node + 1);
  return links;
}

/// The nodes from `first` to `last`.
[[nodiscard]] inline std::vector<std::uint32_t> nodes_from(std::uint32_t first, std::uint32_t last) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t node = first; node <= last; ++node) nodes.push_back(node);
  return nodes;
}

}  // namespace meshhood::test
