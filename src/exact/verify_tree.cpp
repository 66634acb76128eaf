// SPDX-License-Identifier: MIT
// Verifies the groups of nodes: which group each node covers, the links between nodes, and their spheres.
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "exact/build/forest.h"
#include "exact/build/tree.h"
#include "exact/node_search.h"
#include "exact/verify.h"

namespace meshhood::inline v0_1::file {
namespace {

std::string name(std::size_t group) { return "group " + std::to_string(group); }

/// The groups of a level must cover the first groups of the level below, in order; the others must be root groups.
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

  /// The groups of a level from `group` on must have no parent.
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

class TreeCheck {
 public:
  TreeCheck(const IndexView& index, const SectionReader& file) : index_(index), file_(file) {}

  void run() const {
    for (std::size_t group = 0; group < index_.groups.size(); ++group) {
      for (std::size_t i = 0; i < kFanOut; ++i) check_node(group, i);
    }
    for (std::size_t level = 0; level < index_.tree.size(); ++level) check_mean(level);
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      if (index_.leaves[leaf].size == 0) continue;
      check_same_sphere(leaf);
      check_enclosed(leaf);
    }
  }

 private:
  void check_mean(std::size_t level) const {
    const TreeLevel& own = index_.tree[level];
    const double mean = mean_radius(index_.groups.subspan(own.first_group, own.groups),
                                    index_.records.subspan(own.first_group, own.groups));
    if (std::bit_cast<std::uint64_t>(mean) != std::bit_cast<std::uint64_t>(index_.mean_radii[level])) {
      file_.refuse(&index_.mean_radii[level], "level " + std::to_string(level) + ": the mean radius is wrong");
    }
  }

  [[nodiscard]] FrameSphere sphere(std::size_t node) const {
    const Group& g = index_.groups[node / kFanOut];
    const std::size_t i = node % kFanOut;
    return {g.x[i], g.y[i], g.z[i], g.radius[i]};
  }

  void check_node(std::size_t group, std::size_t i) const {
    const Group& g = index_.groups[group];
    if (i >= index_.records[group].nodes) {
      if (!is_absent(g, i)) file_.refuse(&g, name(group * kFanOut + i) + ": expected an absent node");
      return;
    }
    const bool is_finite =
        std::isfinite(g.x[i]) && std::isfinite(g.y[i]) && std::isfinite(g.z[i]) && std::isfinite(g.radius[i]);
    if (is_finite && g.radius[i] > 0) return;
    file_.refuse(&g, name(group * kFanOut + i) + ": the bounding sphere is not valid");
  }

  void check_same_sphere(std::size_t leaf) const {
    const FrameSphere in_tree = sphere(leaf);
    // Both are copies of the same sphere. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    if (std::memcmp(&in_tree, &index_.leaves[leaf].bounds, sizeof(FrameSphere)) == 0) return;
    file_.refuse(&index_.leaves[leaf],
                 "leaf " + std::to_string(leaf) + ": the bounding sphere differs from that in the tree");
  }

  void check_enclosed(std::size_t leaf) const {
    for (unsigned lane = 0; lane < index_.leaves[leaf].size; ++lane) {
      const Point p = index_.frame.to_frame(index_.position(static_cast<LeafId>(leaf), lane));
      for (auto node = static_cast<NodeId>(leaf); node != kNoNode; node = index_.parents[node / kFanOut]) {
        const FrameSphere bounds = sphere(node);
        const auto radius = static_cast<double>(bounds.radius);
        if (squared_distance(center_of(bounds), p) <= radius * radius) continue;
        file_.refuse(&index_.groups[node / kFanOut], name(node) + ": the bounding sphere does not enclose lane " +
                                                         std::to_string(lane) + " of leaf " + std::to_string(leaf));
      }
    }
  }

  static std::string name(std::size_t node) { return "node " + std::to_string(node); }

  const IndexView& index_;
  const SectionReader& file_;
};

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

void verify_tree(const IndexView& index, const SectionReader& file) { TreeCheck(index, file).run(); }

}  // namespace meshhood::inline v0_1::file
