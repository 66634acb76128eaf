// SPDX-License-Identifier: MIT
#include "exact/build/node_parts.h"

#include <algorithm>

namespace meshhood {

void NodeParts::Part::remove(std::uint32_t node) {
  std::uint32_t* const end = nodes_.data() + size_;
  size_ = static_cast<std::size_t>(std::remove(nodes_.data(), end, node) - nodes_.data());
}

void NodeParts::add(std::span<const std::uint32_t> nodes) {
  for (const std::uint32_t node : nodes) part_of_[node] = static_cast<std::uint32_t>(parts_.size());
  Part& part = parts_.emplace_back();
  for (const std::uint32_t node : nodes) part.add(node);
}

void NodeParts::move(std::uint32_t node, std::uint32_t part) {
  parts_[part_of_[node]].remove(node);
  parts_[part].add(node);
  part_of_[node] = part;
}

std::uint32_t NodeParts::best_part_for(std::span<const std::uint32_t> nodes, double limit) const {
  std::uint32_t best = kNoPart;
  double least = limit;
  for (const std::uint32_t node : nodes) {
    for (const std::uint32_t other : (*graph_)[node]) {
      const std::uint32_t part = part_of_[other];
      if (part == part_of_[node] || part == best || parts_[part].nodes().size() + nodes.size() > kFanOut) continue;
      const double radius = ball_of(*graph_, nodes, parts_[part].nodes()).radius;
      if (radius > least || (radius == least && part > best)) continue;
      least = radius;
      best = part;
    }
  }
  return best;
}

double NodeParts::mean_full_radius() const {
  double sum = 0;
  std::size_t count = 0;
  for (const Part& part : parts_) {
    if (part.nodes().size() < kFanOut) continue;
    sum += ball_of(*graph_, part.nodes()).radius;
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::infinity() : sum / static_cast<double>(count);
}

double NodeParts::fill() const {
  std::size_t nodes = 0;
  std::size_t places = 0;
  for (const Part& part : parts_) {
    nodes += part.nodes().size();
    places += part.nodes().empty() ? 0 : kFanOut;
  }
  return places == 0 ? 1 : static_cast<double>(nodes) / static_cast<double>(places);
}

NodeGroups NodeParts::groups() const {
  NodeGroups groups;
  for (const Part& part : parts_) {
    if (!part.nodes().empty()) groups.add(part.nodes());
  }
  return groups;
}

}  // namespace meshhood
