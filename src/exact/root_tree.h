// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"
#include "simd/node_group.h"

namespace meshhood::inline v0_1 {

struct GroupRecord;

/// Bounding spheres over the root groups, for searches that follow no links. A mesh of many components has many root
/// groups. Those of one level are in a kd order, so neighbors in the list lie close together.
struct RootTree {
  std::vector<std::uint32_t> groups;  // without a parent; of the highest level first
  // First a sphere around each of `groups`, then on each level one around eight of those before; the last has one.
  std::vector<std::vector<FrameSphere>> levels;
};

/// O(groups). Takes records that are not verified yet.
[[nodiscard]] RootTree make_root_tree(std::span<const Group> groups, std::span<const GroupRecord> records,
                                      std::span<const std::uint32_t> parents);

}  // namespace meshhood::inline v0_1
