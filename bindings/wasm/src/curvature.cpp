// SPDX-License-Identifier: MIT
// Curvature and features at a scale. `use_faces` or `use_normals` comes first.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "rows.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

Curvatures last_curvatures;

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

extern "C" {

[[clang::export_name("use_normals")]] void use_normals(const double* normals, std::size_t scalars) {
  workspace.use_normals({normals, scalars});
}

/// See `RowArguments`. With scales, one after the other.
[[clang::export_name("curvature")]] void curvature(const VertexId* vertices, std::size_t vertex_count, double radius,
                                                   const double* radii, std::size_t radius_count, bool are_scales,
                                                   CurvatureFit fit, bool filter, bool is_like_libigl) {
  const RowArguments rows{vertices, vertex_count, radius, radii, radius_count, are_scales};
  CurvatureOptions options = is_like_libigl ? like_libigl() : CurvatureOptions{};
  options.fit = fit;
  options.filter = filter;
  BatchQuery query = rows.query();
  if (!query.radius.scales()) {
    last_curvatures = curvatures(workspace.surface(), query, options);
    return;
  }
  last_curvatures = {};
  for (const double scale : std::span(radii, radius_count)) {
    query.radius = scale;
    const Curvatures found = curvatures(workspace.surface(), query, options);
    append(last_curvatures.k1, found.k1);
    append(last_curvatures.k2, found.k2);
    append(last_curvatures.d1, found.d1);
    append(last_curvatures.d2, found.d2);
    append(last_curvatures.state, found.state);
  }
}

/// See `RowArguments`. `areas` are null unless a kind needs them.
[[clang::export_name("features")]] void features(const VertexId* vertices, std::size_t vertex_count, double radius,
                                                 const double* radii, std::size_t radius_count, bool are_scales,
                                                 const Feature* kinds, std::size_t kind_count, const double* areas,
                                                 std::size_t area_count, bool filter) {
  const RowArguments rows{vertices, vertex_count, radius, radii, radius_count, are_scales};
  answer.reals = meshhood::features(
      workspace.surface(), rows.query(),
      {.kinds = {kinds, kinds + kind_count}, .areas = std::span(areas, area_count), .filter = filter});
}

[[clang::export_name("curvature_rows")]] std::size_t curvature_rows() { return last_curvatures.state.size(); }

/// `which` is 0 for k1, 1 for k2, 2 for d1 and 3 for d2.
[[clang::export_name("curvature_reals")]] const double* curvature_reals(std::size_t which) {
  const Curvatures& last = last_curvatures;
  const std::array arrays{last.k1.data(), last.k2.data(), last.d1.data(), last.d2.data()};
  return arrays[which];
}

[[clang::export_name("curvature_states")]] const CurvatureState* curvature_states() {
  return last_curvatures.state.data();
}

[[clang::export_name("release_curvature")]] void release_curvature() { last_curvatures = {}; }

}  // extern "C"

}  // namespace meshhood::wasm
