// SPDX-License-Identifier: MIT
// The groups of nodes: which group each node covers, and the links between nodes.
#include <cstring>
#include <string>
#include <vector>

#include "exact/build/node_links.h"
#include "exact/build/tree.h"
#include "exact/node_search.h"
#include "exact/verify.h"

namespace meshhood::inline v0_1::file {
namespace {

std::string name(std::size_t group) { return "group " + std::to_string(group); }

/// The groups of a level cover the first groups of the level below, in order; the others are root groups.
class ForestCheck {
 public:
  ForestCheck(const IndexView& index, const SectionReader& file) : index_(index), file_(file) {}

  void run() const {
    for (std::size_t level = 0; level < index_.tree.size(); ++level) check_level(level);
    if (index_.tree.empty()) return;
    check_roots(index_.tree.size() - 1, index_.tree.back().first_group);
  }

 private:
  void check_level(std::size_t level) const {
    const TreeLevel& own = index_.tree[level];
    std::size_t child = level == 0 ? 0 : index_.tree[level - 1].first_group;
    for (std::size_t group = own.first_group; group < own.first_group + own.groups; ++group) {
      const GroupRecord& record = index_.records[group];
      if (record.nodes == 0 || record.nodes > kFanOut) {
        file_.refuse(&record, name(group) + ": " + std::to_string(record.nodes) + " nodes, expected 1 to 8");
      }
      if (record.pierced != 0 || record.unused != decltype(record.unused){}) {
        file_.refuse(&record.pierced, name(group) + ": unused bytes are not 0");
      }
      if (record.first_child != child) {
        file_.refuse(&record.first_child, name(group) + ": its first child is group " +
                                              std::to_string(record.first_child) + ", expected " +
                                              std::to_string(child));
      }
      if (level == 0) continue;
      for (std::size_t i = 0; i < record.nodes; ++i) check_parent(child++, own.first_group, group * kFanOut + i);
    }
    if (level > 0) check_roots(level - 1, child);
  }

  /// `end` is the end of the level that the group may be on.
  void check_parent(std::size_t group, std::size_t end, std::size_t parent) const {
    if (group < end && index_.parents[group] == parent) return;
    file_.refuse(&index_.parents[group < end ? group : end - 1],
                 name(group) + ": expected a group covered by node " + std::to_string(parent));
  }

  /// The groups of a level from `group` on have no parent.
  void check_roots(std::size_t level, std::size_t group) const {
    for (; group < index_.tree[level].first_group + index_.tree[level].groups; ++group) {
      if (index_.parents[group] == kNoNode) continue;
      file_.refuse(&index_.parents[group], name(group) + ": no node covers it, but it has a parent");
    }
  }

  const IndexView& index_;
  const SectionReader& file_;
};

void verify_connected(const IndexView& index, std::size_t group, const SectionReader& file) {
  const GroupRecord& record = index.records[group];
  if (index.parents[group] == kNoNode) return;
  for (const NodeLink& link : index.node_links_of(record)) {
    if (index.parents[link.node() / kFanOut] == kNoNode) {
      file.refuse(&link, name(group) + ": it has a parent, but a group linked with it has none");
    }
  }
  if (reachable_nodes(record.linked, 1, first_nodes(record.nodes)) != first_nodes(record.nodes)) {
    file.refuse(&record.linked, name(group) + ": it has a parent, but its nodes are not connected by links");
  }
}

}  // namespace

void verify_forest(const IndexView& index, const SectionReader& file) { ForestCheck(index, file).run(); }

void verify_node_links(const IndexView& index, const SectionReader& file) {
  std::vector<GroupRecord> expected(index.records.begin(), index.records.end());
  set_vertices(index.leaf_begin, index.levels, expected);
  std::vector<std::uint32_t> first_link;
  for (const Leaf& leaf : index.leaves) first_link.push_back(leaf.first_link);
  TaskContext task;
  const std::vector<NodeLink> links =
      make_node_links(first_link, index.links, index.levels, index.parents, expected, task);
  for (std::size_t group = 0; group < expected.size(); ++group) {
    // All bytes are defined. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    if (std::memcmp(&expected[group], &index.records[group], sizeof(GroupRecord)) == 0) continue;
    file.refuse(&index.records[group], name(group) + ": its vertices or links are not those of its leaves");
  }
  if (links.size() != index.node_links.size()) {
    file.refuse(index.node_links.data(), std::to_string(index.node_links.size()) + " links between nodes, expected " +
                                             std::to_string(links.size()));
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].node() == index.node_links[i].node() && links[i].mine == index.node_links[i].mine) continue;
    file.refuse(&index.node_links[i], "link " + std::to_string(i) + " between nodes: expected node " +
                                          std::to_string(links[i].node()) + ", found " +
                                          std::to_string(index.node_links[i].node()));
  }
  for (std::size_t group = 0; group < expected.size(); ++group) verify_connected(index, group, file);
}

}  // namespace meshhood::inline v0_1::file
