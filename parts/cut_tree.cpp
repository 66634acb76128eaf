// SPDX-License-Identifier: MIT
#include "parts/cut_tree.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace meshhood::parts {
namespace {

double coordinate(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// What orders vertices along an axis. The order is total, so that equal positions are separated as well.
std::tuple<double, double, double, std::uint64_t> key_along(int axis, const Site& vertex) {
  const Point& p = vertex.position;
  return {coordinate(p, axis), coordinate(p, (axis + 1) % 3), coordinate(p, (axis + 2) % 3), vertex.id};
}

int longest_axis(std::span<const Site> sample) {
  BoundingBox box;
  for (const Site& vertex : sample) box.add(vertex.position);
  const std::array sides{box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
  return static_cast<int>(std::max_element(sides.begin(), sides.end()) - sides.begin());
}

}  // namespace

bool may_be_within(const BoundingBox& a, const BoundingBox& b, double squared_radius) {
  const Point gap{std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0}),
                  std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0}),
                  std::max({a.low.z - b.high.z, b.low.z - a.high.z, 0.0})};
  const double squared = squared_distance(gap, {0, 0, 0});
  return squared <= squared_radius && squared < kInfinity;  // to an empty box it is infinite
}

CutTree::CutTree(std::vector<Site> sample, std::size_t parts) {
  nodes_.reserve(2 * parts - 1);
  cut(sample, 0, parts);
}

void CutTree::cut(std::span<Site> sample, std::size_t first_part, std::size_t parts) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  if (parts == 1) {
    nodes_[node].second = static_cast<std::uint32_t>(first_part);
    return;
  }
  const int axis = longest_axis(sample);
  const std::size_t first_half = parts / 2;
  // In this order, so that the product cannot overflow: a sample is small.
  const std::size_t middle = sample.size() * first_half / parts;
  const auto pivot = sample.begin() + static_cast<std::ptrdiff_t>(middle);
  if (pivot != sample.end()) {
    std::ranges::nth_element(sample, pivot, {}, [axis](const Site& vertex) { return key_along(axis, vertex); });
    nodes_[node].pivot = *pivot;
  }
  nodes_[node].axis = axis;
  cut(sample.first(middle), first_part, first_half);
  nodes_[node].second = static_cast<std::uint32_t>(nodes_.size());
  cut(sample.subspan(middle), first_part + first_half, parts - first_half);
}

std::size_t CutTree::next(std::size_t node, const Site& vertex) const {
  const Node& here = nodes_[node];
  return key_along(here.axis, vertex) < key_along(here.axis, here.pivot) ? node + 1 : here.second;
}

std::size_t CutTree::owner(const Site& vertex) const {
  std::size_t node = 0;
  while (nodes_[node].axis >= 0) node = next(node, vertex);
  return nodes_[node].second;
}

void CutTree::add(const Site& vertex) {
  std::size_t node = 0;
  for (; nodes_[node].axis >= 0; node = next(node, vertex)) nodes_[node].box.add(vertex.position);
  nodes_[node].box.add(vertex.position);
}

}  // namespace meshhood::parts
