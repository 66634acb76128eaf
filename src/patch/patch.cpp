// SPDX-License-Identifier: MIT
#include "meshhood/patch.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "base/validate.h"
#include "base/vector.h"
#include "batch/packets.h"
#include "batch/position_sort.h"
#include "batch/rows.h"
#include "exact/query/arguments.h"
#include "patch/meshlets.h"
#include "patch/packet_patches.h"
#include "patch/search.h"
#include "shared/parallel.h"
#include "shared/text.h"
#include "surface/face_points.h"
#include "surface/face_triangles.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kGapColumns = sizeof(SurfacePoint) / sizeof(double);

const PatchState& patches_alone(const SurfaceState& surface) {
  TaskContext alone;
  return surface.patches(alone);
}

/// Returns a volume, given in the frame, in the unit of the mesh.
double volume_in_mesh(double volume, double scale) { return volume / scale / scale / scale; }

/// Runs the search around a vertex.
void run_at(const PatchState& state, PatchSearch& search, VertexId v, double radius, bool measures) {
  const std::uint32_t slot = state.index->slot[v];
  const std::span<const TriangleId> fan = state.triangles.fans[state.index->place_at(slot)];
  search.run(state.index->position_at(slot), radius, fan, measures);
}

}  // namespace

struct PatchSearcher::State {
  explicit State(const Surface& given)
      : owner(SurfaceAccess::share(given)), surface(&patches_alone(*owner)), search(*surface) {}

  std::shared_ptr<const SurfaceState> owner;
  const PatchState* surface;
  PatchSearch search;
  std::vector<TriangleId> starts;

  void run(const PatchStart& start, double radius, bool measures) {
    owner->index.check_current();
    check_radius(radius);
    if (!start.face()) {
      check_vertex(start.vertex(), surface->index->vertex_count(), "vertex");
      return run_at(*surface, search, start.vertex(), radius, measures);
    }
    check_point(start.point(), "point");
    const Point center{start.point()[0], start.point()[1], start.point()[2]};
    find_start(*start.face(), center, radius);
    search.run(center, radius, starts, measures);
  }

  /// Finds the triangle of a face that is nearest to a point; none if it has no point in the ball. A point on the face
  /// is off it by the rounding of its coordinates, which are as large as those of the corners.
  void find_start(std::size_t face, const Point& p, double radius) {
    constexpr double kRounding = 0x1p-48;
    const IndexView& index = *surface->index;
    const Triangles& all = surface->triangles;
    if (face >= surface->faces->size()) raise_no_such_face(face, surface->faces->size());
    starts.clear();
    double least = kInfinity;
    double reach = radius;
    for (const VertexId corner : (*surface->faces)[face]) {
      const Point at = index.position_of(corner);
      reach = std::max(reach, kRounding * largest_component(at));
      for (const TriangleId t : all.fans[index.place(corner)]) {
        if (all.face[t] != face) continue;
        const double distance = nearest_in_triangle(p, corners_of(index, all.corners[t]), index.frame.scale).distance;
        if (!(distance < least)) continue;
        least = distance;
        starts.assign(1, t);
      }
    }
    if (least > reach) starts.clear();
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
  ClippedMesh mesh = state_->search.clip(radius, tolerance);
  mesh.area = state_->search.area();
  return mesh;
}

PatchMeasure PatchSearcher::measure(const PatchStart& start, double radius) {
  state_->run(start, radius, true);
  return {state_->search.area(), volume_in_mesh(state_->search.volume(), state_->surface->index->frame.scale)};
}

SurfacePoint PatchSearcher::gap(const PatchStart& start, double radius) {
  state_->run(start, radius, false);
  return state_->search.gap();
}

namespace {

/// Visits the patches of packets, on one thread.
class PacketVisit {
 public:
  PacketVisit(const PatchState& state, PatchParts parts, RowPatchVisitor visit)
      : state_(&state), parts_(parts), packet_(state), visit_(std::move(visit)) {}

  void run(const PacketAnswer& answer) {
    const QueryWord found = packet_.find(answer, parts_.measures);
    for (std::size_t q = 0; q < answer.rows.size(); ++q) {  // this includes walls, which are no queries of a packet
      RowPatch patch{answer.radii[q]};
      if ((found >> q & 1U) != 0) {
        if (parts_.measures) patch = {patch.radius, packet_.area(q), packet_.volume(q)};
        if (parts_.gaps) patch.gap = packet_.gap(q);
      } else {
        if (!search_) search_.emplace(*state_);
        run_at(*state_, *search_, answer.vertices[q], patch.radius, parts_.measures);
        if (parts_.measures) patch = {patch.radius, search_->area(), search_->volume()};
        if (parts_.gaps) patch.gap = search_->gap();
      }
      visit_(answer.rows[q], patch);
    }
  }

 private:
  const PatchState* state_;
  PatchParts parts_;
  PacketPatches packet_;
  std::optional<PatchSearch> search_;  // of those that are not found in packets
  RowPatchVisitor visit_;
};

/// Calls `visit` with the patch of each row, on any thread.
void for_each_patch(const Surface& surface, const BatchQuery& query, PatchParts parts, const Run& run,
                    const RowPatchVisitor& visit) {
  TaskContext task(run.threads);
  const PatchState& state = SurfaceAccess::state(surface).patches(task);
  if (query.metric != Metric::Straight) {
    raise(ErrorCode::InvalidOption, "a patch by another metric, expected the straight one");
  }
  const auto make_visitor = [&](unsigned /*thread*/) { return patch_visitor(state, parts, visit); };
  for_each_packet(state.searched, query, make_visitor, run);
}

/// Calls `visit(searcher, start, radius, row)` for points of faces, on any thread; near ones follow each other.
template <class Visit>
void for_each_point(const Surface& surface, const IndicesView& faces, std::span<const SpacePoint> points,
                    const BatchRadius& radius, const Run& run, const Visit& visit) {
  constexpr std::size_t kPointsOfTask = 16;
  const SurfaceState& state = SurfaceAccess::state(surface);
  const FacePoints starts(state.faces(), faces, points);
  const std::vector<BatchRadius> passes = radius_of_passes(radius);
  TaskContext task(run.threads, run.progress, passes.size() * starts.size());
  static_cast<void>(state.patches(task));  // else each thread would make it
  const Rows rows({.vertices = starts.corners(), .radius = passes.front()}, surface.vertex_count());
  const auto slot_of = [&](std::size_t row) { return state.index->slot[starts.corners()[row]]; };
  std::vector<std::optional<PatchSearcher>> searchers(task.threads());
  for_each_by_position(starts.size(), kPointsOfTask, slot_of, task, [&](unsigned thread, std::size_t row) {
    if (!searchers[thread]) searchers[thread].emplace(surface);
    const PatchStart start(starts.face(row), starts.point(row));
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
      const double r = passes.size() == 1 ? rows.radius(row) : passes[pass].common();
      visit(*searchers[thread], start, r, pass * starts.size() + row);
    }
    task.advance(thread, passes.size());
  });
}

}  // namespace

PacketVisitor patch_visitor(const PatchState& state, PatchParts parts, RowPatchVisitor visit) {
  const auto visits = std::make_shared<PacketVisit>(state, parts, std::move(visit));
  return [visits](const PacketAnswer& answer) { visits->run(answer); };
}

Invariants invariants(const Surface& surface, const BatchQuery& query, const Run& run) {
  const std::size_t size = query.result_rows(surface.vertex_count());
  Invariants result{std::vector<double>(size), std::vector<double>(size)};
  const double scale = SurfaceAccess::state(surface).frame.scale;
  for_each_patch(surface, query, {.measures = true, .gaps = false}, run, [&](std::size_t row, const RowPatch& patch) {
    result.area[row] = patch.area;
    result.volume[row] = volume_in_mesh(patch.volume, scale);
  });
  return result;
}

Invariants invariants(const Surface& surface, const IndicesView& faces, std::span<const SpacePoint> points,
                      const BatchRadius& radius, const Run& run) {
  const std::size_t size = BatchQuery{.radius = radius}.result_rows(points.size());
  Invariants result{std::vector<double>(size), std::vector<double>(size)};
  for_each_point(surface, faces, points, radius, run,
                 [&](PatchSearcher& searcher, const PatchStart& start, double r, std::size_t row) {
                   const PatchMeasure found = searcher.measure(start, r);
                   result.area[row] = found.area;
                   result.volume[row] = found.volume;
                 });
  return result;
}

std::vector<SurfacePoint> gaps(const Surface& surface, const BatchQuery& query, const Run& run) {
  std::vector<SurfacePoint> result(query.result_rows(surface.vertex_count(), kGapColumns));
  for_each_gap(surface, query, [&](std::size_t row, const SurfacePoint& gap) { result[row] = gap; }, run);
  return result;
}

std::vector<SurfacePoint> gaps(const Surface& surface, const IndicesView& faces, std::span<const SpacePoint> points,
                               const BatchRadius& radius, const Run& run) {
  std::vector<SurfacePoint> result(BatchQuery{.radius = radius}.result_rows(points.size(), kGapColumns));
  for_each_point(surface, faces, points, radius, run,
                 [&](PatchSearcher& searcher, const PatchStart& start, double r, std::size_t row) {
                   result[row] = searcher.gap(start, r);
                 });
  return result;
}

void for_each_gap(const Surface& surface, const BatchQuery& query, const SurfacePointVisitor& visit, const Run& run) {
  check_function(visit, "visit");
  for_each_patch(surface, query, {.measures = false, .gaps = true}, run,
                 [&](std::size_t row, const RowPatch& patch) { visit(row, patch.gap); });
}

}  // namespace meshhood::inline v0_1
