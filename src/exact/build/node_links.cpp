// SPDX-License-Identifier: MIT
#include "exact/build/node_links.h"

#include <algorithm>

namespace meshhood::inline v0_1 {
namespace {

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

std::vector<NodeLink> make_node_links(std::span<const std::uint32_t> first_link, std::span<const Link> links,
                                      std::span<const std::uint32_t> levels, std::span<const NodeId> parents,
                                      std::vector<GroupRecord>& records, TaskContext& task) {
  constexpr std::size_t kGrain = 32;  // enough that passing them to a thread costs little
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
