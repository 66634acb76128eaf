// SPDX-License-Identifier: MIT
#include "surface/submesh.h"

#include <algorithm>
#include <string>

#include "meshhood/error.h"

#include "shared/text.h"

namespace meshhood::inline v0_1 {

FaceSelection::FaceSelection(const SurfaceState& surface, std::span<const VertexId> ids, Corners corners)
    : is_marked_(surface.index->vertex_count()) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < is_marked_.size()) continue;
    raise_no_such_vertex(ErrorCode::VertexOutOfRange, "ids: position " + std::to_string(i) + ": vertex ",
                         std::to_string(ids[i]), is_marked_.size());
  }
  for (const VertexId v : ids) {
    is_marked_[v] = true;
    faces_.insert(faces_.end(), surface.lists()[v].begin(), surface.lists()[v].end());
  }
  std::sort(faces_.begin(), faces_.end());
  faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
  if (corners == Corners::Any) return;
  std::erase_if(faces_, [&](std::size_t face) {
    return !std::ranges::all_of(surface.faces()[face], [&](VertexId v) { return has(v); });
  });
}

std::vector<std::size_t> Surface::faces(std::span<const VertexId> ids, Corners corners) const {
  return FaceSelection(SurfaceAccess::state(*this), ids, corners).faces();
}

Submesh Surface::submesh(std::span<const VertexId> ids, Corners corners) const {
  const State& state = SurfaceAccess::state(*this);
  Submesh result;
  result.faces = FaceSelection(state, ids, corners).faces();
  result.offsets.push_back(0);
  for (const std::size_t face : result.faces) {
    const auto all = state.faces()[face];
    result.corners.insert(result.corners.end(), all.begin(), all.end());
    result.offsets.push_back(result.corners.size());
  }
  result.vertices = result.corners;
  std::sort(result.vertices.begin(), result.vertices.end());
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  for (VertexId& corner : result.corners) {
    const auto place = std::lower_bound(result.vertices.begin(), result.vertices.end(), corner);
    corner = static_cast<VertexId>(place - result.vertices.begin());
  }
  return result;
}

}  // namespace meshhood::inline v0_1
