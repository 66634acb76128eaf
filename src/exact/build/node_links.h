// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Finds the links between the nodes of each level, from those between leaves and the parents of the groups. Sets
/// `linked`, `first_link` and `end_link` of the records. A verification calls this for an index file and compares.
///
/// first_link  by leaf, and one more: its first link in `links`
/// levels      as in IndexView
/// A link from a group with a parent to one without has no counterpart on the level above. O(links).
[[nodiscard]] std::vector<NodeLink> make_node_links(std::span<const std::uint32_t> first_link,
                                                    std::span<const Link> links, std::span<const std::uint32_t> levels,
                                                    std::span<const NodeId> parents, std::vector<GroupRecord>& records,
                                                    TaskContext& task);

}  // namespace meshhood::inline v0_1
