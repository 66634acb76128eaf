// SPDX-License-Identifier: MIT
#include "meshhood/refit.h"

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/error.h"

#include "exact/arrays.h"
#include "exact/build/geometry.h"
#include "exact/index_access.h"
#include "exact/moves.h"
#include "exact/weighted_graph.h"

namespace meshhood {
namespace {

void check_size(const PositionsView& positions, const IndexView& index) {
  if (positions.scalar_count() == 3 * index.vertex_count()) return;
  raise(ErrorCode::InvalidMesh, std::to_string(positions.scalar_count()) + " coordinates, but the index has " +
                                    std::to_string(index.vertex_count()) + " vertices, expected three a vertex");
}

/// Moves are written to the positions of the index, which must not lose digits.
void check_precision(const PositionsView& positions, const IndexView& index) {
  const bool is_double = positions.visit([](const auto& xyz) { return sizeof(*xyz.first) == sizeof(double); });
  if (!is_double || std::holds_alternative<std::span<const double>>(index.positions)) return;
  raise(ErrorCode::InvalidMesh,
        "the positions are double, but those of the index are float: expected float, or a call without `changed`");
}

/// An index with the connectivity of `index` and another geometry.
Index with_geometry(const IndexView& index, std::shared_ptr<GeometryData> geometry) {
  auto view = std::make_shared<IndexView>(index);
  view->newest = std::make_shared<std::uint64_t>(view->version);
  set_geometry(*view, std::move(geometry));
  return IndexAccess::make(std::move(view));
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

/// The geometry with all positions given, in any precision.
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

/// The geometry after moves that leave the frame: makes a new one, and all bounds in it.
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
  if (!index.geometry) set_geometry(index, copy_geometry(index));  // of a file, which must not change
  apply_moves(moves, index, task);
}

}  // namespace

Index refit(const Index& index, const PositionsView& positions, const Run& run) {
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  const IndexView& view = IndexAccess::whole(index, "refitted");
  return with_geometry(view, geometry_at(positions, view, task));
}

Index refit(const Index& index, const PositionsView& positions, const IndicesView& changed, const Run& run) {
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  const IndexView& view = IndexAccess::whole(index, "refitted");
  const std::vector<Move> moves = checked_moves(view, positions, changed);
  if (!stay_in_frame(moves, view.frame)) return with_geometry(view, geometry_beyond_frame(moves, view, task));
  Index moved = with_geometry(view, copy_geometry(view));
  apply_moves(moves, IndexAccess::changeable(moved), task);
  return moved;
}

void Index::refit_in_place(const PositionsView& positions, const Run& run) {
  static_cast<void>(IndexAccess::whole(*this, "refitted"));
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  auto graph = std::make_shared<KeptGraph>();
  set_geometry(view(), geometry_at(positions, view(), task));
  graph_ = std::move(graph);
  view_->version = ++*view_->newest;
}

void Index::refit_in_place(const PositionsView& positions, const IndicesView& changed, const Run& run) {
  static_cast<void>(IndexAccess::whole(*this, "refitted"));
  TaskContext task(run.threads, run.progress, kGeometrySteps);
  auto graph = std::make_shared<KeptGraph>();
  move_in_place(checked_moves(view(), positions, changed), view(), task);
  graph_ = std::move(graph);
  view_->version = ++*view_->newest;
}

}  // namespace meshhood
