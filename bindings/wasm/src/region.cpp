// SPDX-License-Identifier: MIT
// Searches from one start, a vertex or a point, by a method or a metric and with masks. `start_at_...` comes first, and
// borrows its array for the calls that follow; `search_by` comes first, too, and copies the masks.
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "shared/text.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

Start origin = VertexId{0};
VertexId closest = 0;
std::vector<std::size_t> region_sizes;

void answer_sizes() { answer.counts.assign(region_sizes.begin(), region_sizes.end()); }

}  // namespace

[[clang::export_name("start_at_vertex")]] void start_at_vertex(VertexId v) { origin = v; }

/// Refuses a point that is no start. Calls of the library have other names for it.
[[clang::export_name("check_start")]] void check_start(double x, double y, double z) {
  check_point({x, y, z}, "start");
}

/// The vertex nearest to the point is the seed if `seeds` is null.
[[clang::export_name("start_at_point")]] void start_at_point(double x, double y, double z, const VertexId* seeds,
                                                             std::size_t seed_count) {
  const SpacePoint center{x, y, z};
  if (seeds == nullptr) {
    closest = meshhood::nearest(workspace.searched(), center).vertex;
    origin = Start(center, std::span(&closest, 1));
  } else {
    origin = Start(center, std::span(seeds, seed_count));
  }
}

/// The rows of the next call on many vertices: all if `vertices` is null. The radius of all rows, unless there are
/// radii: one for each row, or with `are_scales` each for all rows.
[[clang::export_name("use_rows")]] void use_rows(const VertexId* vertices, std::size_t vertex_count, double radius,
                                                 const double* radii, std::size_t radius_count, bool are_scales) {
  const std::span list(radii, radius_count);
  rows.vertices = view_vertices(vertices, vertex_count);
  rows.radius = are_scales         ? BatchRadius::scales({list.begin(), list.end()})
                : radii != nullptr ? BatchRadius(list)
                                   : BatchRadius(radius);
}

/// The metric of the rows and the masks of all searches that follow; no masks if both are empty. Along the surface,
/// `use_faces` comes before.
[[clang::export_name("search_by")]] void search_by(MetricName metric, const std::uint8_t* walls, std::size_t wall_count,
                                                   const std::uint8_t* ignored, std::size_t ignored_count) {
  const bool is_along_surface = metric == MetricName::Surface;
  rows.metric = is_along_surface ? Metric::Path : static_cast<Metric>(metric);
  workspace.set_masks({walls, wall_count}, {ignored, ignored_count});
  workspace.search_along_surface(is_along_surface);
}

/// By a method; the exact one searches by the metric, the others from a vertex. Returns whether a seed lies in the
/// ball.
[[clang::export_name("neighborhood")]] bool neighborhood(MethodName method, double radius, bool with_distances) {
  const auto search = [&](auto& searcher, const auto& start) {
    if (with_distances) return searcher.neighborhood(start, radius, answer.ids, answer.reals);
    answer.reals.clear();
    searcher.neighborhood(start, radius, answer.ids);
  };
  if (method != MethodName::Exact) {
    std::visit([&](auto& searcher) { search(searcher, origin.vertex()); }, workspace.searcher(method));
    return true;
  }
  Searcher& searcher = workspace.searcher(rows.metric);
  search(searcher, origin);
  return searcher.has_seed(origin, radius);
}

[[clang::export_name("count")]] std::size_t count(MethodName method, double radius) {
  if (method == MethodName::Exact) return workspace.searcher(rows.metric).count(origin, radius);
  return std::visit([&](auto& searcher) { return searcher.count(origin.vertex(), radius); },
                    workspace.searcher(method));
}

/// Whether a seed lies in the largest ball.
[[clang::export_name("nested")]] bool nested(const double* radii, std::size_t radius_count) {
  Searcher& searcher = workspace.searcher(rows.metric);
  searcher.nested(origin, std::span(radii, radius_count), answer.ids, region_sizes);
  answer_sizes();
  return radius_count == 0 || searcher.has_seed(origin, radii[radius_count - 1]);
}

[[clang::export_name("contains")]] bool contains(VertexId w, double radius) {
  return workspace.searcher(rows.metric).contains(origin, w, radius);
}

[[clang::export_name("connecting_radius")]] double connecting_radius(VertexId w) {
  return workspace.searcher(rows.metric).connecting_radius(origin, w);
}

[[clang::export_name("nearest_connected")]] void nearest_connected(std::size_t k) {
  workspace.searcher(rows.metric).nearest_connected(origin, k, answer.ids, answer.reals);
}

/// Returns the vertex, which is no wall; the first real of the answer is its distance.
[[clang::export_name("nearest")]] VertexId nearest(double x, double y, double z) {
  const NearestVertex found = meshhood::nearest(workspace.searched(), {x, y, z});
  answer.reals = {found.distance};
  return found.vertex;
}

}  // namespace meshhood::wasm
