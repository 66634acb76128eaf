// SPDX-License-Identifier: MIT
#include "exact/root_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "base/vector.h"
#include "exact/layout.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

/// A sphere around at least one sphere.
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

}  // namespace meshhood::inline v0_1
