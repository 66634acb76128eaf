// SPDX-License-Identifier: MIT
#include "exact/moves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "meshhood/error.h"

#include "base/validate.h"
#include "exact/arrays.h"
#include "exact/build/leaf_spheres.h"
#include "exact/build/tree.h"
#include "shared/text.h"

namespace meshhood {
namespace {

std::size_t vertex_at(const IndexView& index, std::uint32_t slot) {
  return std::size_t{index.leaf_begin[leaf_of(slot)]} + lane_of(slot);
}

Point position_at(const IndexView& index, std::uint32_t slot) { return index.position(leaf_of(slot), lane_of(slot)); }

/// The leaves of the vertices, ascending, as the moves do.
std::vector<LeafId> leaves_to_measure(std::span<const Move> moves) {
  std::vector<LeafId> leaves;
  for (const Move& move : moves) {
    if (leaves.empty() || leaves.back() != leaf_of(move.slot)) leaves.push_back(leaf_of(move.slot));
  }
  return leaves;
}

/// The parts of a geometry that some moves change. Puts them back at the end unless `keep` has been called.
class Backup {
 public:
  Backup(std::span<const Move> moves, std::span<const LeafId> leaves, IndexView& index)
      : index_(index), geometry_(*index.geometry), mean_radii_(geometry_.mean_radii) {
    for (const Move& move : moves) positions_.push_back({move.slot, position_at(index, move.slot)});
    for (const LeafId leaf : leaves) bounds_.emplace_back(leaf, geometry_.leaves[leaf].bounds);
    for (const std::size_t group : groups_above(leaves, index)) {
      groups_.emplace_back(group, geometry_.groups[group]);
    }
  }
  Backup(const Backup&) = delete;
  Backup& operator=(const Backup&) = delete;

  ~Backup() {  // NOLINT(bugprone-exception-escape): std::visit throws only for a variant without a value
    if (kept_) return;
    write_moves(positions_, index_, geometry_.positions);
    for (const auto& [leaf, bounds] : bounds_) geometry_.leaves[leaf].bounds = bounds;
    for (const auto& [at, group] : groups_) geometry_.groups[at] = group;
    std::copy(mean_radii_.begin(), mean_radii_.end(), geometry_.mean_radii.begin());
  }

  void keep() { kept_ = true; }

 private:
  IndexView& index_;
  GeometryData& geometry_;
  std::vector<Move> positions_;
  std::vector<std::pair<LeafId, FrameSphere>> bounds_;
  std::vector<std::pair<std::size_t, Group>> groups_;
  std::vector<double> mean_radii_;
  bool kept_ = false;
};

}  // namespace

std::vector<Move> read_moves(const IndexView& index, const PositionsView& positions, const IndicesView& changed) {
  std::vector<Move> moves;
  moves.reserve(changed.size());
  for (std::size_t row = 0; row < changed.size(); ++row) {
    const std::uint64_t v = changed[row];
    if (v >= index.vertex_count()) {
      raise_no_such_vertex(ErrorCode::VertexOutOfRange, "changed: row " + std::to_string(row) + ": vertex ",
                           to_text(changed, row), index.vertex_count());
    }
    const auto vertex = static_cast<std::size_t>(v);
    const Point to = point(positions, vertex);
    check_position(vertex, to);
    moves.push_back({index.slot[vertex], to});
  }
  std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.slot < b.slot; });
  const auto is_same = [](const Move& a, const Move& b) { return a.slot == b.slot; };
  moves.erase(std::unique(moves.begin(), moves.end(), is_same), moves.end());
  return moves;
}

bool stay_in_frame(std::span<const Move> moves, const Frame& frame) {
  return std::all_of(moves.begin(), moves.end(), [&](const Move& move) { return covers(frame, move.to); });
}

void write_moves(std::span<const Move> moves, const IndexView& index, OrderedPositions& positions) {
  std::visit(
      [&](auto& xyz) {
        using Real = typename std::decay_t<decltype(xyz)>::value_type;
        for (const Move& move : moves) {
          Real* const to = &xyz[3 * vertex_at(index, move.slot)];
          to[0] = static_cast<Real>(move.to.x);
          to[1] = static_cast<Real>(move.to.y);
          to[2] = static_cast<Real>(move.to.z);
        }
      },
      positions);
}

void apply_moves(std::span<const Move> moves, IndexView& index, TaskContext& task) {
  GeometryData& geometry = *index.geometry;
  const std::vector<LeafId> leaves = leaves_to_measure(moves);
  Backup backup(moves, leaves, index);
  write_moves(moves, index, geometry.positions);
  Spheres spheres = measure_leaves(leaves, index, task);
  for (std::size_t i = 0; i < leaves.size(); ++i) geometry.leaves[leaves[i]].bounds = spheres[i];
  update_tree(leaves, std::move(spheres), index, geometry.groups, geometry.mean_radii);
  RootTree roots = make_root_tree(index.groups, index.records, index.parents);
  task.finish();
  backup.keep();
  index.roots = std::move(roots);
  for (std::size_t level = 0; level < index.tree.size(); ++level) {
    index.tree[level].mean_radius = geometry.mean_radii[level];
  }
}

}  // namespace meshhood
