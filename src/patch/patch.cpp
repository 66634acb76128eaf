// SPDX-License-Identifier: MIT
#include "meshhood/patch.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <variant>

#include "meshhood/error.h"

#include "base/validate.h"
#include "batch/position_sort.h"
#include "batch/rows.h"
#include "exact/query/arguments.h"
#include "patch/clip.h"
#include "patch/gap.h"
#include "patch/row_patches.h"
#include "patch/search.h"
#include "patch/state.h"
#include "shared/parallel.h"
#include "shared/text.h"
#include "surface/face_tree.h"
#include "surface/surface.h"
#include "surface/triangle_point.h"

namespace meshhood {
namespace {

constexpr std::size_t kPatchesAtOnce = 32;

/// Runs the search around a vertex. Returns whether there is a patch.
bool run_at(const PatchState& state, PatchSearch& search, VertexId v, double radius, bool measures) {
  const std::uint32_t slot = state.index->slot[v];
  const std::span<const TriangleId> fan = state.triangles.fan(state.index->place_at(slot));
  search.run(state.index->position(leaf_of(slot), lane_of(slot)), radius, fan, measures);
  return !fan.empty();
}

void check_metric(const BatchQuery& query) {
  if (query.metric == Metric::Straight) return;
  raise(ErrorCode::InvalidOption, "a patch by another metric, expected the straight one");
}

}  // namespace

void for_each_patch(const PatchState& state, const Rows& rows, TaskContext& task, bool measures,
                    const std::function<void(const RowPatch&)>& visit) {
  const std::vector<std::size_t> in_order =
      rows_by_position(rows.size(), [&](std::size_t row) { return state.index->slot[rows.vertex(row)]; });
  std::vector<std::unique_ptr<PatchSearch>> searches(task.threads());
  task.parallel_for(rows.size(), kPatchesAtOnce, [&](unsigned thread, std::size_t begin, std::size_t end) {
    if (!searches[thread]) searches[thread] = std::make_unique<PatchSearch>(state);
    for (std::size_t i = begin; i < end && task.should_continue(thread); ++i) {
      const std::size_t row = in_order[i];
      const bool exists = run_at(state, *searches[thread], rows.vertex(row), rows.radius(row), measures);
      visit({row, rows.radius(row), state, *searches[thread], exists});
      task.advance(thread, 1);
    }
  });
}

struct PatchSearcher::State {
  explicit State(const Surface& given)
      : owner(SurfaceAccess::share(given)), surface(&owner->patches()), search(*surface) {}

  std::shared_ptr<const SurfaceState> owner;
  const PatchState* surface;
  PatchSearch search;
  std::vector<TriangleId> starts;

  /// Returns whether there is a patch.
  bool run(const PatchStart& start, double radius, bool measures) {
    owner->index.check_current();
    check_radius(radius);
    if (!start.face()) {
      check_vertex(start.vertex(), surface->index->vertex_count(), "vertex");
      return run_at(*surface, search, start.vertex(), radius, measures);
    }
    check_point(start.point(), "point: ");
    find_start(*start.face(), {start.point()[0], start.point()[1], start.point()[2]});
    search.run({start.point()[0], start.point()[1], start.point()[2]}, radius, starts, measures);
    return !starts.empty();
  }

  /// The triangle of a face that is nearest to a point.
  void find_start(std::size_t face, const Point& p) {
    const IndexView& index = *surface->index;
    const Triangles& all = surface->triangles;
    if (face >= surface->faces->size()) {
      raise(ErrorCode::InvalidOption, "face " + std::to_string(face) + ", expected one of the mesh, which has " +
                                          std::to_string(surface->faces->size()));
    }
    starts.clear();
    double least = kInfinity;
    for (const VertexId corner : (*surface->faces)[face]) {
      for (const TriangleId t : all.fan(index.place(corner))) {
        if (all.face[t] != face) continue;
        const double distance = nearest_in_triangle(p, corners_of(index, all.corners[t]), index.frame.scale).distance;
        if (!(distance < least)) continue;
        least = distance;
        starts.assign(1, t);
      }
    }
  }
};

PatchSearcher::PatchSearcher(const Surface& surface) : state_(std::make_unique<State>(surface)) {}

std::vector<std::size_t> PatchSearcher::patch(const PatchStart& start, double radius) {
  state_->run(start, radius, false);
  std::vector<std::size_t> faces;
  for (const TriangleId t : state_->search.triangles()) faces.push_back(state_->surface->triangles.face[t]);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

ClippedMesh PatchSearcher::clip(const PatchStart& start, double radius, double tolerance) {
  if (!(tolerance >= 1e-12 && tolerance <= 1)) {
    raise(ErrorCode::InvalidOption, "tolerance " + to_text(tolerance) + ", expected one from 1e-12 to 1");
  }
  state_->run(start, radius, true);
  ClippedMesh mesh = clip_patch(*state_->surface, state_->search, radius, tolerance);
  mesh.area = state_->search.area();
  return mesh;
}

PatchMeasure PatchSearcher::measure(const PatchStart& start, double radius) {
  state_->run(start, radius, true);
  return {state_->search.area(), state_->search.volume()};
}

SurfacePoint PatchSearcher::gap(const PatchStart& start, double radius) {
  return state_->run(start, radius, false) ? find_gap(*state_->surface, state_->search, radius) : SurfacePoint{};
}

Invariants invariants(const Surface& surface, const BatchQuery& query, const Run& run) {
  const PatchState& state = SurfaceAccess::state(surface).patches();
  check_metric(query);
  const std::vector<BatchRadius> passes = radius_of_passes(query.radius);
  Rows rows({.vertices = query.vertices, .radius = passes.front()}, state.index->vertex_count());
  TaskContext task(run.threads, run.progress, passes.size() * rows.size());
  Invariants result{std::vector<double>(passes.size() * rows.size()), std::vector<double>(passes.size() * rows.size())};
  for (std::size_t pass = 0; pass < passes.size(); ++pass) {
    if (query.radius.scales()) rows.set_radius(passes[pass].common());
    for_each_patch(state, rows, task, true, [&](const RowPatch& patch) {
      result.area[pass * rows.size() + patch.row] = patch.search.area();
      result.volume[pass * rows.size() + patch.row] = patch.search.volume();
    });
  }
  task.finish();
  return result;
}

std::vector<SurfacePoint> gaps(const Surface& surface, const BatchQuery& query, const Run& run) {
  const PatchState& state = SurfaceAccess::state(surface).patches();
  check_metric(query);
  const Rows rows(query, state.index->vertex_count());
  TaskContext task(run.threads, run.progress, rows.size());
  std::vector<SurfacePoint> result(rows.size());
  for_each_patch(state, rows, task, false, [&](const RowPatch& patch) { result[patch.row] = patch.gap(); });
  task.finish();
  return result;
}

}  // namespace meshhood
