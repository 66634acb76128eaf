// SPDX-License-Identifier: MIT
#include "exact/build/connected_parts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "exact/node_search.h"

namespace meshhood {
namespace {

constexpr std::uint32_t kNoPlace = std::numeric_limits<std::uint32_t>::max();

/// Divides cells of eight nodes into their connected parts.
class CellSplitter {
 public:
  CellSplitter(const NodeGraph& graph, std::span<const KdPoint> order)
      : graph_(&graph), order_(order), place_(graph.size(), kNoPlace) {
    for (std::size_t i = 0; i < order.size(); ++i) place_[order[i].id] = static_cast<std::uint32_t>(i);
  }

  /// Adds the parts of the cell that begins at a place of the order.
  void split(std::size_t begin, NodeParts& parts) {
    const auto size = static_cast<unsigned>(std::min<std::size_t>(kFanOut, order_.size() - begin));
    const std::array<NodeSet, kFanOut> linked = links_within(begin, size);
    for (unsigned left = first_nodes(size); left != 0;) {
      const NodeSet found = reachable_nodes(linked, static_cast<NodeSet>(left & -left), first_nodes(size));
      left &= ~unsigned{found};
      nodes_.clear();
      for_each_node(found, [&](unsigned i) { nodes_.push_back(order_[begin + i].id); });
      parts.add(nodes_);
    }
  }

 private:
  [[nodiscard]] std::array<NodeSet, kFanOut> links_within(std::size_t begin, unsigned size) const {
    std::array<NodeSet, kFanOut> linked{};
    for (unsigned i = 0; i < size; ++i) {
      for (const std::uint32_t other : (*graph_)[order_[begin + i].id]) {
        // A place before the cell wraps around to a large number.
        const std::size_t place = std::size_t{place_[other]} - begin;
        if (place < size) linked[i] |= node_at(static_cast<unsigned>(place));
      }
    }
    return linked;
  }

  const NodeGraph* graph_;
  std::span<const KdPoint> order_;
  std::vector<std::uint32_t> place_;  // by node: its place in the order
  std::vector<std::uint32_t> nodes_;
};

/// Joins small parts with linked ones that have room, the smallest first: a single node has the fewest parts to join.
void join_small_parts(NodeParts& parts) {
  // The largest radius of a joined part, divided by that of a full one. Chosen: joining a part of one or two nodes
  // gains more.
  constexpr double kSmallStretch = 2.5;
  constexpr double kLargeStretch = 1.5;
  const double full = parts.mean_full_radius();
  std::vector<std::uint32_t> nodes;
  for (std::size_t size = 1; size <= kFanOut / 2; ++size) {
    const double limit = (size <= 2 ? kSmallStretch : kLargeStretch) * full;
    for (std::uint32_t part = 0; part < parts.size(); ++part) {
      if (parts[part].size() != size) continue;
      nodes.assign(parts[part].begin(), parts[part].end());
      const std::uint32_t other = parts.best_part_for(nodes, limit);
      if (other == NodeParts::kNoPart) continue;
      for (const std::uint32_t node : nodes) parts.move(node, other);  // mutant: small-parts-stay-alone
    }
  }
}

}  // namespace

NodeParts connected_parts(const NodeGraph& graph, std::span<const KdPoint> order) {
  NodeParts parts(graph);
  CellSplitter splitter(graph, order);
  for (std::size_t begin = 0; begin < order.size(); begin += kFanOut) splitter.split(begin, parts);
  join_small_parts(parts);
  return parts;
}

}  // namespace meshhood
