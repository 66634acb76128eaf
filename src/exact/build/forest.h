// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/build/node_parts.h"
#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// The leaves are grouped into a forest, not a tree, because nodes that are not linked are never grouped together. So
/// every node above the leaves is connected by links between its children.
///
/// A node without links has no parent. Such nodes of one level share *root groups*. Where grouping no longer makes a
/// level much smaller, as around a hub, all nodes of the level are in root groups, and keep their links.
struct Forest {
  std::vector<std::uint32_t> levels;  // the first group of each level, and one more: the number of groups
  std::vector<GroupRecord> records;   // by group; `nodes` and `first_child` are set
  std::vector<NodeId> parents;        // by group: the node that covers it, or kNoNode
  std::vector<std::uint32_t> leaves;  // by place: the number that the leaf had before, or kNoNode
};

/// Groups the leaves and numbers them in the order of the groups, from the top down. O(leaves log(leaves) + links).
[[nodiscard]] Forest make_forest(NodeGraph leaves, TaskContext& task);

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
