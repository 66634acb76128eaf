// SPDX-License-Identifier: MIT
#include "exact/query/filtered.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "exact/index_access.h"
#include "exact/node_search.h"
#include "exact/query/arguments.h"
#include "exact/query/lane_filter.h"
#include "shared/parallel.h"

namespace meshhood {
namespace {

/// The arrays that a filter changes.
struct FilteredData {
  std::vector<LaneMask> walls;
  std::vector<LaneMask> ignored;
  std::vector<Leaf> leaves;
  std::vector<GroupRecord> records;
  IndexView shared;  // keeps the others alive
};

/// The lanes of each leaf; nothing if the mask has no vertex.
std::vector<LaneMask> lanes_by_leaf(const IndexView& index, const VertexMask& mask, TaskContext& task) {
  constexpr std::size_t kLeavesAtOnce = 512;
  const LaneFilter filter(index, mask);
  if (filter.empty()) return {};
  std::vector<LaneMask> lanes(index.leaf_count());
  task.parallel_for(lanes.size(), kLeavesAtOnce, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) lanes[leaf] = filter.of(static_cast<LeafId>(leaf));
  });
  if (std::ranges::all_of(lanes, [](LaneMask some) { return some == 0; })) lanes.clear();
  return lanes;
}

/// Marks leaves with walls as not connected, and the nodes above them as pierced.
void pierce(const IndexView& index, FilteredData& data) {
  data.leaves.assign(index.leaves.begin(), index.leaves.end());
  data.records.assign(index.records.begin(), index.records.end());
  const auto mark = [&](NodeId node) { data.records[node / kFanOut].pierced |= node_at(node % kFanOut); };
  for (LeafId leaf = 0; leaf < data.walls.size(); ++leaf) {
    if (data.walls[leaf] == 0) continue;
    data.leaves[leaf].connected = false;
    mark(leaf);
  }
  // Groups have smaller numbers than the node that covers them.
  for (std::size_t group = 0; group < data.records.size(); ++group) {
    if (data.records[group].pierced != 0 && index.parents[group] != kNoNode) mark(index.parents[group]);
  }
}

}  // namespace

Index filtered(const Index& index, const Filter& filter, unsigned threads) {
  const IndexView& given = IndexAccess::view(index);
  check_filter(filter, given.vertex_count());
  if (filter.empty()) return IndexAccess::alias(index);
  const Progress none;
  TaskContext task(threads, none, 0);
  auto data = std::make_shared<FilteredData>();
  data->shared = given;
  data->walls = lanes_by_leaf(given, filter.walls, task);
  data->ignored = lanes_by_leaf(given, filter.ignored, task);
  auto view = std::make_shared<IndexView>(given);
  if (!data->walls.empty()) {
    pierce(given, *data);
    view->leaves = data->leaves;
    view->records = data->records;
  }
  view->walls = data->walls;
  view->ignored = data->ignored;
  view->geometry = nullptr;
  view->owner = std::move(data);
  return IndexAccess::make(std::move(view), index);
}

}  // namespace meshhood
