// SPDX-License-Identifier: MIT
#include "region/region_mesher.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "meshhood/error.h"
#include "meshhood/region_mesh.h"

#include "shared/text.h"

namespace meshhood {

FaceLists::FaceLists(const MeshView& mesh) {
  corner_begin_.reserve(mesh.faces.size() + 1);
  corners_.reserve(mesh.faces.corner_count());
  corner_begin_.push_back(0);
  face_begin_.assign(mesh.positions.size() + 1, 0);
  mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    for (const VertexId corner : corners) ++face_begin_[corner];
    corner_begin_.push_back(corners_.size());
  });
  // Each number stands at the end of its list and moves to the beginning as the list fills, from the last face on.
  std::inclusive_scan(face_begin_.begin(), face_begin_.end(), face_begin_.begin());
  faces_.resize(corners_.size());
  for (std::size_t face = size(); face-- > 0;) {
    for (const VertexId corner : corners(face)) faces_[--face_begin_[corner]] = face;
  }
}

void RegionMesher::State::mark(std::span<const VertexId> ids) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < marks.size()) continue;
    raise_no_such_vertex(ErrorCode::VertexOutOfRange, "ids: position " + std::to_string(i) + ": vertex ",
                         std::to_string(ids[i]), marks.size());
  }
  if (++round == 0) {
    std::fill(marks.begin(), marks.end(), 0);
    round = 1;
  }
  for (const VertexId v : ids) marks[v] = round;
}

std::vector<std::size_t> RegionMesher::State::select(std::span<const VertexId> ids, Corners corners) {
  mark(ids);
  std::vector<std::size_t> faces;
  for (const VertexId v : ids) faces.insert(faces.end(), lists.faces(v).begin(), lists.faces(v).end());
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  if (corners == Corners::Any) return faces;
  std::erase_if(faces, [&](std::size_t face) {
    const auto all = lists.corners(face);
    return !std::all_of(all.begin(), all.end(), [&](VertexId v) { return is_marked(v); });
  });
  return faces;
}

RegionMesher::RegionMesher(const MeshView& mesh) {
  validate(mesh);
  state_ = std::make_unique<State>(mesh);
}

std::size_t RegionMesher::vertex_count() const { return state_->positions.size(); }
std::size_t RegionMesher::face_count() const { return state_->lists.size(); }

std::vector<std::size_t> RegionMesher::faces(std::span<const VertexId> ids, Corners corners) {
  return state_->select(ids, corners);
}

Submesh RegionMesher::submesh(std::span<const VertexId> ids, Corners corners) {
  Submesh result;
  result.faces = state_->select(ids, corners);
  result.offsets.push_back(0);
  for (const std::size_t face : result.faces) {
    const auto all = state_->lists.corners(face);
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

}  // namespace meshhood
