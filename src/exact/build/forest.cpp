// SPDX-License-Identifier: MIT
#include "exact/build/forest.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "exact/build/node_parts.h"

namespace meshhood::inline v0_1 {
namespace {

/// The groups of one level: those that become nodes of the level above, by its numbers, and root groups.
struct LevelGroups {
  NodeGroups covered;
  NodeGroups roots;

  [[nodiscard]] std::size_t size() const { return covered.size() + roots.size(); }
};

/// Returns the nodes with links, or those without, in a kd order of eight; they ascend within each eight.
std::vector<KdPoint> order_nodes(const NodeGraph& graph, bool with_links, TaskContext& task) {
  std::vector<KdPoint> points;
  for (std::uint32_t node = 0; node < graph.size(); ++node) {
    if (graph[node].empty() == with_links) continue;
    points.push_back(kd_point(graph.balls[node].center, node));
  }
  kd_order(points, kFanOut, task);
  return points;
}

void pack(std::span<const KdPoint> order, NodeGroups& groups) {
  std::vector<std::uint32_t> nodes;
  for (std::size_t begin = 0; begin < order.size(); begin += kFanOut) {
    nodes.clear();
    for (const KdPoint& point : order.subspan(begin, std::min<std::size_t>(kFanOut, order.size() - begin))) {
      nodes.push_back(point.id);
    }
    groups.add(nodes);
  }
}

/// Groups the nodes of one level after the other, upwards.
class LevelGrouping {
 public:
  LevelGroups group(const NodeGraph& graph, TaskContext& task) {
    LevelGroups result;
    const std::vector<KdPoint> linked = order_nodes(graph, true, task);
    result.covered = cover(graph, linked);
    // Around a hub, hardly any node finds a partner that has room.
    if (4 * result.covered.size() > 3 * linked.size()) {
      result.covered = {};
      pack(linked, result.roots);
    }
    pack(order_nodes(graph, false, task), result.roots);
    return result;
  }

 private:
  NodeGroups cover(const NodeGraph& graph, std::span<const KdPoint> linked) {
    // Chosen: groups of leaves are filled to 0.87 to 0.97 on scans and bodies, and to 0.78 on closely folded surfaces.
    constexpr double kWellFilled = 0.85;
    NodeParts parts = connected_parts(graph, linked);
    if (!dissolves_) dissolves_ = parts.fill() < kWellFilled;
    if (*dissolves_) dissolve_small_parts(parts);
    return parts.groups();
  }

  std::optional<bool> dissolves_;  // whether small parts are dissolved; decided for the leaves, and kept for all levels
};

/// Numbers the groups of all levels from the top down.
class Numbering {
 public:
  explicit Numbering(std::span<const LevelGroups> levels) : levels_(levels) {
    forest_.levels.push_back(0);
    for (const LevelGroups& level : levels) {
      forest_.levels.push_back(forest_.levels.back() + static_cast<std::uint32_t>(level.size()));
    }
    forest_.records.resize(forest_.levels.back());
    forest_.parents.assign(forest_.levels.back(), kNoNode);
    forest_.leaves.assign(std::size_t{forest_.levels[1]} * kFanOut, kNoNode);
  }

  Forest run() {
    // The groups of the level above that become its nodes, in their final order.
    std::vector<std::uint32_t> covered;
    for (std::size_t level = levels_.size(); level-- > 0;) covered = number_level(level, covered);
    return std::move(forest_);
  }

 private:
  /// Returns the nodes of the level, which are the groups of the level below, in their final order.
  std::vector<std::uint32_t> number_level(std::size_t level, const std::vector<std::uint32_t>& covered) {
    std::vector<std::uint32_t> nodes;
    next_child_ = level == 0 ? 0 : forest_.levels[level - 1];
    std::uint32_t group = forest_.levels[level];
    for (const std::uint32_t old : covered) add_group(group++, level, levels_[level].covered[old], nodes);
    const NodeGroups& roots = levels_[level].roots;
    for (std::size_t root = 0; root < roots.size(); ++root) add_group(group++, level, roots[root], nodes);
    return nodes;
  }

  void add_group(std::uint32_t group, std::size_t level, std::span<const std::uint32_t> members,
                 std::vector<std::uint32_t>& nodes) {
    GroupRecord& record = forest_.records[group];
    record.nodes = static_cast<std::uint32_t>(members.size());
    record.first_child = next_child_;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto node = static_cast<NodeId>(std::size_t{group} * kFanOut + i);
      if (level == 0) {
        forest_.leaves[node] = members[i];
      } else {
        forest_.parents[next_child_++] = node;
        nodes.push_back(members[i]);
      }
    }
  }

  std::span<const LevelGroups> levels_;
  Forest forest_;
  std::uint32_t next_child_ = 0;
};

/// Collects the links of one group, in any order and any number of times.
class GroupLinks {
 public:
  explicit GroupLinks(std::vector<NodeLink>& out) : out_(&out) {}

  void begin(std::uint32_t group) {
    group_ = group;
    linked_.fill(0);
    outer_.clear();
  }

  void add(unsigned mine, NodeId other) {
    if (other / kFanOut != group_) {
      outer_.emplace_back(other, static_cast<NodeSet>(1U << mine));
    } else if (other % kFanOut != mine) {
      linked_[mine] |= static_cast<NodeSet>(1U << other % kFanOut);
    }
  }

  void finish(GroupRecord& record) {
    std::sort(outer_.begin(), outer_.end(), [](const NodeLink& a, const NodeLink& b) { return a.node() < b.node(); });
    record.linked = linked_;
    record.first_link = static_cast<std::uint32_t>(out_->size());
    for (std::size_t i = 0; i < outer_.size(); ++i) {
      if (i == 0 || outer_[i].node() != outer_[i - 1].node()) out_->emplace_back(outer_[i].node(), NodeSet{0});
      out_->back().mine |= outer_[i].mine;
    }
    record.end_link = static_cast<std::uint32_t>(out_->size());
  }

 private:
  std::vector<NodeLink>* out_;
  std::uint32_t group_ = 0;
  std::array<NodeSet, kFanOut> linked_{};
  std::vector<NodeLink> outer_;
};

void append(const std::vector<NodeLink>& links, std::vector<NodeLink>& all) {
  all.insert(all.end(), links.begin(), links.end());
}

}  // namespace

Forest make_forest(NodeGraph leaves, TaskContext& task) {
  std::vector<LevelGroups> levels;
  LevelGrouping grouping;
  for (NodeGraph graph = std::move(leaves); graph.size() > 0;) {
    levels.push_back(grouping.group(graph, task));
    graph = contract(graph, levels.back().covered, task);
  }
  if (levels.empty()) return {{0}, {}, {}, {}};
  return Numbering(levels).run();
}

std::vector<NodeLink> make_node_links(std::span<const std::uint32_t> first_link, std::span<const Link> links,
                                      std::span<const std::uint32_t> levels, std::span<const NodeId> parents,
                                      std::vector<GroupRecord>& records, TaskContext& task) {
  constexpr std::size_t kGrain = 32;  // a chunk of this size takes much longer than passing it to a thread
  std::vector<NodeLink> result;
  const auto add_links = [&](std::size_t level, std::uint32_t group, GroupLinks& collected) {
    for (unsigned i = 0; i < records[group].nodes; ++i) {
      if (level == 0) {
        const std::size_t leaf = std::size_t{group} * kFanOut + i;
        for (std::size_t link = first_link[leaf]; link < first_link[leaf + 1]; ++link) {
          collected.add(i, links[link].leaf);
        }
        continue;
      }
      const GroupRecord& child = records[records[group].first_child + i];
      for (std::size_t link = child.first_link; link < child.end_link; ++link) {
        const NodeId other = parents[result[link].node() / kFanOut];
        if (other != kNoNode) collected.add(i, other);
      }
    }
  };
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    const std::size_t groups = levels[level + 1] - levels[level];
    std::vector<std::vector<NodeLink>> runs((groups + kGrain - 1) / kGrain);
    task.parallel_for(groups, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
      GroupLinks collected(runs[begin / kGrain]);
      for (auto group = static_cast<std::uint32_t>(levels[level] + begin); group < levels[level] + end; ++group) {
        collected.begin(group);
        add_links(level, group, collected);
        collected.finish(records[group]);
      }
    });
    for (std::size_t group = 0; group < groups; ++group) {
      if (group % kGrain == 0 && group > 0) append(runs[group / kGrain - 1], result);
      GroupRecord& record = records[levels[level] + group];
      record.first_link += static_cast<std::uint32_t>(result.size());
      record.end_link += static_cast<std::uint32_t>(result.size());
    }
    if (!runs.empty()) append(runs.back(), result);
  }
  return result;
}

}  // namespace meshhood::inline v0_1
