// SPDX-License-Identifier: MIT
// Derives an index for searches with masks. It shares the positions, edges and spheres, all of which remain valid
// without the walls: a sphere still contains what is below it, and a link may be one more than is needed. What would be
// wrong is changed in copies:
//
// - the walls of each leaf are kept as lanes, which every search takes out of those that are in the ball;
// - a leaf with walls is not connected, and every node above it is *pierced*, that is never whole. So a search goes
//   down to the vertices wherever there are walls.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/masks.h"

#include "exact/index_access.h"
#include "exact/node_search.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

/// The arrays that masks change.
struct MaskedData {
  std::vector<LaneMask> walls;
  std::vector<LaneMask> ignored;
  std::vector<Leaf> leaves;
  std::vector<GroupRecord> records;
  IndexView shared;  // keeps the others alive
};

void check_mask(const VertexMask& mask, std::size_t vertices, const char* name) {
  const std::size_t size = mask.size();
  if (size == 0 || size == vertices) return;
  raise(ErrorCode::InvalidOption, std::string(name) + ": " + std::to_string(size) +
                                      " values, expected one for each of " + std::to_string(vertices) + " vertices");
}

LaneMask lanes_of(const IndexView& index, const VertexMask& mask, std::size_t leaf) {
  LaneMask lanes = 0;
  for (std::size_t i = index.leaf_begin[leaf]; i < index.leaf_begin[leaf + 1]; ++i) {
    lanes |= LaneMask{mask[index.id(i)]} << (i - index.leaf_begin[leaf]);
  }
  return lanes;
}

/// Returns the lanes of each leaf; nothing if the mask has no vertex.
std::vector<LaneMask> lanes_by_leaf(const IndexView& index, const VertexMask& mask, TaskContext& task) {
  constexpr std::size_t kLeavesAtOnce = 512;
  if (mask.size() == 0) return {};
  std::vector<LaneMask> lanes(index.leaf_count());
  task.parallel_for(lanes.size(), kLeavesAtOnce, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) lanes[leaf] = lanes_of(index, mask, leaf);
  });
  if (std::ranges::all_of(lanes, [](LaneMask some) { return some == 0; })) lanes.clear();
  return lanes;
}

/// Marks leaves with walls as not connected, and the nodes above them as pierced.
void pierce(const IndexView& index, MaskedData& data) {
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

Index masked(const Index& index, const Masks& masks, const Run& run) {
  const IndexView& given = IndexAccess::whole(index, "masked again");
  check_mask(masks.walls, given.vertex_count(), "walls");
  check_mask(masks.ignored, given.vertex_count(), "ignored");
  TaskContext task(run.threads, run.progress, 1);
  auto data = std::make_shared<MaskedData>();
  data->shared = given;
  data->walls = lanes_by_leaf(given, masks.walls, task);
  data->ignored = lanes_by_leaf(given, masks.ignored, task);
  auto view = std::make_shared<IndexView>(given);
  if (!data->walls.empty()) {
    pierce(given, *data);
    view->leaves = data->leaves;
    view->records = data->records;
  }
  view->walls = data->walls;
  view->ignored = data->ignored;
  view->is_derived = true;
  view->geometry = nullptr;
  view->owner = std::move(data);
  task.finish();
  return IndexAccess::make(std::move(view), IndexAccess::share_graph(index));
}

}  // namespace meshhood::inline v0_1
