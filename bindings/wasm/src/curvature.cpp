// SPDX-License-Identifier: MIT
// Curvature and features at a scale. `use_faces` or `use_normals` comes first.
#include <cstddef>
#include <cstdint>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {

[[clang::export_name("use_normals")]] void use_normals(const double* normals, std::size_t scalars) {
  workspace.use_normals({normals, scalars});
}

/// The reals of the answer are all k1, then all k2, d1 and d2; the counts are the states.
[[clang::export_name("curvature")]] void curvature(CurvatureFit fit, bool filter, bool is_like_libigl) {
  CurvatureOptions options = is_like_libigl ? like_libigl() : CurvatureOptions{};
  options.fit = fit;
  options.filter = filter;
  const Curvatures found = curvatures(workspace.surface(), rows, options);
  answer = {};
  for (const auto* part : {&found.k1, &found.k2, &found.d1, &found.d2}) {
    answer.reals.insert(answer.reals.end(), part->begin(), part->end());
  }
  for (const CurvatureState state : found.state) answer.counts.push_back(static_cast<std::uint32_t>(state));
}

[[clang::export_name("features")]] void features(const Feature* kinds, std::size_t kind_count, bool filter) {
  answer.reals =
      meshhood::features(workspace.surface(), rows, {.kinds = {kinds, kinds + kind_count}, .filter = filter});
}

}  // namespace meshhood::wasm
