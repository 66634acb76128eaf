// SPDX-License-Identifier: MIT
// Regions as meshes.
#include <cstddef>
#include <cstdint>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {

extern "C" {

[[clang::export_name("prepare_regions")]] void prepare_regions() {
  workspace.build(given, {}, {});
  workspace.use_faces(given.faces, {});
}

/// The counts of the answer are faces.
[[clang::export_name("faces")]] void faces(const VertexId* ids, std::size_t count, Corners corners) {
  const auto found = workspace.surface().faces({ids, count}, corners);
  answer.counts.assign(found.begin(), found.end());
}

/// The ids of the answer are the vertices, and the counts first the offsets of the faces, then the corners.
[[clang::export_name("submesh")]] void submesh(const VertexId* ids, std::size_t count, Corners corners) {
  const Submesh part = workspace.surface().submesh({ids, count}, corners);
  answer.ids.assign(part.vertices.begin(), part.vertices.end());
  answer.counts.assign(part.offsets.begin(), part.offsets.end());
  answer.counts.insert(answer.counts.end(), part.corners.begin(), part.corners.end());
}

/// The reals of the answer are the points, the ids the ends of their edges, and the counts first the offsets, then
/// whether each polyline is closed.
[[clang::export_name("rim")]] void rim(const VertexId* ids, std::size_t count, double x, double y, double z,
                                       double radius) {
  const Rim outline = workspace.surface().rim({ids, count}, {x, y, z}, radius);
  answer = {};
  append_rows(answer.reals, outline.points);
  append_rows(answer.ids, outline.edges);
  answer.counts.assign(outline.offsets.begin(), outline.offsets.end());
  answer.counts.insert(answer.counts.end(), outline.closed.begin(), outline.closed.end());
}

}  // extern "C"

}  // namespace meshhood::wasm
