// SPDX-License-Identifier: MIT
#include "exact/layout.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "base/vector.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns a sphere around at least one sphere.
FrameSphere enclosing(std::span<const FrameSphere> spheres) {
  assert(!spheres.empty());
  Point sum{0, 0, 0};
  for (const FrameSphere& sphere : spheres) sum = sum + center_of(sphere);
  const Point mean = 1 / static_cast<double>(spheres.size()) * sum;
  FrameSphere result{static_cast<float>(mean.x), static_cast<float>(mean.y), static_cast<float>(mean.z), 0};
  double radius = 0;
  for (const FrameSphere& sphere : spheres) {
    radius = std::max(radius, length(center_of(sphere) - center_of(result)) + static_cast<double>(sphere.radius));
  }
  result.radius = next_above(radius);
  return result;
}

FrameSphere enclosing(const Group& group, std::size_t nodes) {
  std::array<FrameSphere, kFanOut> spheres{};
  const std::size_t size = std::clamp<std::size_t>(nodes, 1, kFanOut);
  for (std::size_t i = 0; i < size; ++i) spheres[i] = sphere_of(group, i);
  return enclosing(std::span(spheres).first(size));
}

/// Makes the levels of a tree. There is a mean radius for each.
Tree make_levels(std::span<const std::uint32_t> levels, std::span<const GroupRecord> records,
                 std::span<const double> mean_radii) {
  Tree tree;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    TreeLevel next{levels[level], levels[level + 1] - levels[level], 0, 0, mean_radii[level]};
    for (const GroupRecord& record : records.subspan(next.first_group, next.groups)) {
      next.nodes += record.nodes;
      next.vertices += record.begin[std::min<std::size_t>(record.nodes, kFanOut)] - record.begin[0];
    }
    tree.push_back(next);
  }
  return tree;
}

/// Goes from the groups below to those above. Ranges that records not verified yet would place outside are empty.
std::vector<LeafGroupRange> make_leaf_groups(std::span<const std::uint32_t> levels,
                                             std::span<const GroupRecord> records) {
  if (levels.size() < 2) return {};
  const std::size_t leaf_end = levels[1];
  std::vector<LeafGroupRange> result((records.size() - std::min(leaf_end, records.size())) * kFanOut);
  const auto below = [&](std::size_t group) -> LeafGroupRange {
    if (group < leaf_end) return {static_cast<std::uint32_t>(group), static_cast<std::uint32_t>(group + 1)};
    const std::size_t first = (group - leaf_end) * kFanOut;
    const std::size_t last = first + std::clamp<std::size_t>(records[group].nodes, 1, kFanOut) - 1;
    return {result[first].begin, result[last].end};
  };
  for (std::size_t group = leaf_end; group < records.size(); ++group) {
    for (std::size_t i = 0; i < std::min<std::size_t>(records[group].nodes, kFanOut); ++i) {
      const std::size_t child = std::size_t{records[group].first_child} + i;
      if (child < group) result[(group - leaf_end) * kFanOut + i] = below(child);
    }
  }
  return result;
}

template <class T, class Allocator>
void borrow(std::span<const T>& span, const std::vector<T, Allocator>& array) {
  span = array;
}

void borrow(PositionsInOrder& span, const OrderedPositions& array) { span = view_of(array); }

}  // namespace

RootTree make_root_tree(std::span<const Group> groups, std::span<const GroupRecord> records,
                        std::span<const std::uint32_t> parents) {
  RootTree tree;
  std::vector<FrameSphere> level;
  for (std::size_t group = parents.size(); group-- > 0;) {
    if (parents[group] != kNoNode) continue;
    tree.groups.push_back(static_cast<std::uint32_t>(group));
    level.push_back(enclosing(groups[group], records[group].nodes));
  }
  while (!level.empty()) {
    std::vector<FrameSphere> above;
    for (std::size_t i = 0; level.size() > 1 && i < level.size(); i += kFanOut) {
      above.push_back(enclosing(std::span(level).subspan(i, std::min<std::size_t>(kFanOut, level.size() - i))));
    }
    tree.levels.push_back(std::move(level));
    level = std::move(above);
  }
  return tree;
}

void derive(IndexView& index) {
  index.tree = make_levels(index.levels, index.records, index.mean_radii);
  index.roots = make_root_tree(index.groups, index.records, index.parents);
  index.leaf_groups = make_leaf_groups(index.levels, index.records);
}

PositionsInOrder view_of(const OrderedPositions& positions) {
  return std::visit([](const auto& xyz) -> PositionsInOrder { return std::span(xyz); }, positions);
}

IndexView view_of(const IndexData& data) {
  IndexView view;
  view.frame = data.frame;
  for_each_array([](ArrayInfo, auto& span, const auto& array) { borrow(span, array); }, view, data);
  if (!view.groups.empty()) derive(view);
  return view;
}

std::shared_ptr<IndexView> make_view(IndexData data) {
  // Moving an array does not change its address.
  auto view = std::make_shared<IndexView>(view_of(data));
  view->owner = std::make_shared<const ConnectivityData>(static_cast<ConnectivityData&&>(data));
  view->geometry = std::make_shared<GeometryData>(static_cast<GeometryData&&>(data));
  return view;
}

void set_geometry(IndexView& view, std::shared_ptr<GeometryData> geometry) {
  IndexView next = view;
  next.frame = geometry->frame;
  borrow(next.positions, geometry->positions);
  borrow(next.leaves, geometry->leaves);
  borrow(next.groups, geometry->groups);
  borrow(next.mean_radii, geometry->mean_radii);
  derive(next);
  next.geometry = std::move(geometry);
  view = std::move(next);
}

}  // namespace meshhood::inline v0_1
