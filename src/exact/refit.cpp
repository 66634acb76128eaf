// SPDX-License-Identifier: MIT
#include "meshhood/refit.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/error.h"

#include "base/validate.h"
#include "exact/build/tree.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

/// A vertex and its new position.
struct Move {
  std::uint32_t slot;
  Point to;
};

/// Returns the vertices `changed`, ascending by slot, each once. Reads each argument once, because another thread may
/// write to it. Throws Error{InvalidMesh, VertexOutOfRange} for a vertex that the mesh does not have, and for an
/// invalid position.
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
    if (!is_valid_position(to)) refuse_position(vertex, to);
    moves.push_back({index.slot[vertex], to});
  }
  std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.slot < b.slot; });
  const auto is_same = [](const Move& a, const Move& b) { return a.slot == b.slot; };
  moves.erase(std::unique(moves.begin(), moves.end(), is_same), moves.end());
  return moves;
}

/// Returns whether the frame covers all new positions.
bool stay_in_frame(std::span<const Move> moves, const Frame& frame) {
  return std::all_of(moves.begin(), moves.end(), [&](const Move& move) { return covers(frame, move.to); });
}

/// Returns the leaves of the vertices, ascending, as the moves do.
std::vector<LeafId> leaves_to_measure(std::span<const Move> moves) {
  std::vector<LeafId> leaves;
  for (const Move& move : moves) {
    if (leaves.empty() || leaves.back() != leaf_of(move.slot)) leaves.push_back(leaf_of(move.slot));
  }
  return leaves;
}

/// Writes the new positions to `positions`, in index order.
void write_moves(std::span<const Move> moves, const IndexView& index, OrderedPositions& positions) {
  std::visit(
      [&](auto& xyz) {
        using Real = typename std::decay_t<decltype(xyz)>::value_type;
        for (const Move& move : moves) {
          Real* const to = &xyz[3 * index.place_at(move.slot)];
          to[0] = static_cast<Real>(move.to.x);
          to[1] = static_cast<Real>(move.to.y);
          to[2] = static_cast<Real>(move.to.z);
        }
      },
      positions);
}

/// Copies the parts of a geometry that some moves change, and puts them back at the end unless `keep` has been called.
class Backup {
 public:
  Backup(std::span<const Move> moves, std::span<const LeafId> leaves, IndexView& index)
      : index_(index), geometry_(*index.geometry), mean_radii_(geometry_.mean_radii) {
    for (const Move& move : moves) positions_.push_back({move.slot, index.position_at(move.slot)});
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

/// Moves the vertices of `index`, which owns its geometry and has no searcher, and computes again what depends on them.
/// The moves must stay in the frame. If an exception ends the call, `index` is as it was.
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

void check_size(const PositionsView& positions, const IndexView& index) {
  if (positions.scalar_count() == 3 * index.vertex_count()) return;
  raise(ErrorCode::InvalidMesh, std::to_string(positions.scalar_count()) + " coordinates, but the index has " +
                                    std::to_string(index.vertex_count()) + " vertices, expected three a vertex");
}

/// Checks that moves lose no digits in the positions of the index.
void check_precision(const PositionsView& positions, const IndexView& index) {
  const bool is_double = positions.visit([](const auto& xyz) { return sizeof(*xyz.first) == sizeof(double); });
  if (!is_double || std::holds_alternative<std::span<const double>>(index.positions)) return;
  raise(ErrorCode::InvalidMesh,
        "the positions are double, but those of the index are float: expected float, or a call without `changed`");
}

/// Makes an index with the connectivity of `index` and another geometry.
Index with_geometry(const Index& index, std::shared_ptr<GeometryData> geometry) {
  auto view = std::make_shared<IndexView>(IndexAccess::view(index));
  view->newest = std::make_shared<std::uint64_t>(view->version);
  set_geometry(*view, std::move(geometry));
  return IndexAccess::make(std::move(view), std::make_shared<KeptGraph>(IndexAccess::share_graph(index)->edges()));
}

template <class T>
std::vector<T> copy(std::span<const T> array) {
  return {array.begin(), array.end()};
}

OrderedPositions copy(const PositionsInOrder& positions) {
  return std::visit(
      []<class Real>(std::span<const Real> xyz) -> OrderedPositions { return RawVector<Real>(xyz.begin(), xyz.end()); },
      positions);
}

std::shared_ptr<GeometryData> copy_geometry(const IndexView& index) {
  auto geometry = std::make_shared<GeometryData>();
  geometry->frame = index.frame;
  geometry->positions = copy(index.positions);
  geometry->leaves = copy(index.leaves);
  geometry->groups = copy(index.groups);
  geometry->mean_radii = copy(index.mean_radii);
  return geometry;
}

PositionsView without_padding(const OrderedPositions& positions, std::size_t vertices) {
  return std::visit([&](const auto& xyz) { return PositionsView(std::span(xyz).first(3 * vertices)); }, positions);
}

/// Makes the geometry with all positions given, in any precision.
std::shared_ptr<GeometryData> geometry_at(const PositionsView& positions, const IndexView& index, TaskContext& task) {
  check_size(positions, index);
  validate(positions);
  auto geometry = std::make_shared<GeometryData>();
  geometry->frame = make_frame(positions);
  geometry->leaves = copy(index.leaves);
  make_geometry(positions, index, *geometry, task);
  task.finish();
  return geometry;
}

/// Makes the geometry after moves that leave the frame: a new frame, and all bounds in it.
std::shared_ptr<GeometryData> geometry_beyond_frame(std::span<const Move> moves, const IndexView& index,
                                                    TaskContext& task) {
  auto geometry = std::make_shared<GeometryData>();
  geometry->positions = copy(index.positions);
  write_moves(moves, index, geometry->positions);
  geometry->frame = make_frame(without_padding(geometry->positions, index.vertex_count()));
  geometry->leaves = copy(index.leaves);
  measure_geometry(index, *geometry, task);
  task.finish();
  return geometry;
}

std::vector<Move> checked_moves(const IndexView& index, const PositionsView& positions, const IndicesView& changed) {
  check_size(positions, index);
  check_precision(positions, index);
  return read_moves(index, positions, changed);
}

/// Moves vertices of an index that no search uses. If an exception ends the call, it is as it was.
void move_in_place(std::span<const Move> moves, IndexView& index, TaskContext& task) {
  if (!stay_in_frame(moves, index.frame)) {
    set_geometry(index, geometry_beyond_frame(moves, index, task));
    return;
  }
  if (!index.geometry) set_geometry(index, copy_geometry(index));  // the bytes of a file must not change
  apply_moves(moves, index, task);
}

}  // namespace

Index refit(const Index& index, const PositionsView& positions, const Run& run) {
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  const IndexView& view = IndexAccess::whole(index, "refitted");
  return with_geometry(index, geometry_at(positions, view, task));
}

Index refit(const Index& index, const PositionsView& positions, const IndicesView& changed, const Run& run) {
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  const IndexView& view = IndexAccess::whole(index, "refitted");
  const std::vector<Move> moves = checked_moves(view, positions, changed);
  if (!stay_in_frame(moves, view.frame)) return with_geometry(index, geometry_beyond_frame(moves, view, task));
  Index moved = with_geometry(index, copy_geometry(view));
  apply_moves(moves, IndexAccess::changeable(moved), task);
  return moved;
}

void Index::refit_in_place(const PositionsView& positions, const Run& run) {
  static_cast<void>(IndexAccess::whole(*this, "refitted"));
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  auto graph = std::make_shared<KeptGraph>(graph_->edges());
  set_geometry(view(), geometry_at(positions, view(), task));
  graph_ = std::move(graph);
  view_->version = ++*view_->newest;
}

void Index::refit_in_place(const PositionsView& positions, const IndicesView& changed, const Run& run) {
  static_cast<void>(IndexAccess::whole(*this, "refitted"));
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  const std::vector<Move> moves = checked_moves(view(), positions, changed);
  std::vector<VertexId> places;
  places.reserve(moves.size());
  for (const Move& move : moves) places.push_back(static_cast<VertexId>(view().place_at(move.slot)));
  move_in_place(moves, view(), task);
  graph_->renew(view(), places);
  view_->version = ++*view_->newest;
}

}  // namespace meshhood::inline v0_1
