// SPDX-License-Identifier: MIT
#include "surface/normal_cones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "simd/node_group.h"

namespace meshhood::inline v0_1 {
namespace {

// More than the rounding of an angle, and of a cone in single precision.
constexpr double kSlack = 0x1p-20;

// The squares of a shorter vector vanish, and with them its direction.
constexpr double kShortest = 0x1p-480;

/// Normals at most `angle` away from a unit vector. As it stands: none.
struct Bundle {
  Point axis{0, 0, 0};
  double angle = -1;
};

Bundle bundle_of(const Point& area) {
  const double size = length(area);
  if (size >= kShortest) return {(1 / size) * area, 0};
  const bool has_no_normal = area.x == 0 && area.y == 0 && area.z == 0;
  return {{0, 0, 0}, has_no_normal ? -1 : std::numbers::pi};
}

/// Where the axes cancel out, one of them is at least 90 degrees away from what is left.
Bundle around(std::span<const Bundle> parts) {
  Bundle all;
  for (const Bundle& part : parts) all.axis = all.axis + part.axis;
  all.axis = (1 / std::max(length(all.axis), kSlack)) * all.axis;
  for (const Bundle& part : parts) {
    if (part.angle < 0) continue;
    const double apart = std::acos(std::clamp(dot(all.axis, part.axis), -1.0, 1.0));
    all.angle = std::max(all.angle, apart + part.angle + kSlack);
  }
  return all;
}

template <class BundleOf>
std::vector<Bundle> in_groups(std::size_t count, BundleOf&& bundle_of_part) {
  std::vector<Bundle> groups;
  groups.reserve((count + kFanOut - 1) / kFanOut);
  for (std::size_t first = 0; first < count; first += kFanOut) {
    std::array<Bundle, kFanOut> parts;
    for (std::size_t i = first; i < std::min(first + kFanOut, count); ++i) parts[i - first] = bundle_of_part(i);
    groups.push_back(around(parts));
  }
  return groups;
}

NormalCone cone_of(const Bundle& normals) {
  if (normals.angle < 0) return {};
  const double left = std::acos(kOpposite) - normals.angle;
  if (left <= 0) return {0, 0, 0, 1};  // opposite to any
  return {static_cast<float>(normals.axis.x), static_cast<float>(normals.axis.y), static_cast<float>(normals.axis.z),
          static_cast<float>(std::cos(left) + kSlack)};
}

}  // namespace

NormalCones::NormalCones(const IndexView& index, const FaceTree& tree) {
  std::vector<Bundle> groups = in_groups(
      tree.triangles().size(), [&](std::size_t i) { return bundle_of(doubled_area(index, tree.triangles()[i])); });
  for (;;) {
    std::ranges::transform(groups, levels_.emplace_back(groups.size()).begin(), cone_of);
    if (groups.size() == 1) return;
    groups = in_groups(groups.size(), [&](std::size_t i) { return groups[i]; });
  }
}

std::size_t NormalCones::bytes() const {
  std::size_t bytes = 0;
  for (const std::vector<NormalCone>& level : levels_) bytes += level.size() * sizeof(NormalCone);
  return bytes;
}

}  // namespace meshhood::inline v0_1
