// SPDX-License-Identifier: MIT
// The surface: its faces, points on them, the thickness of its walls, and regions as meshes. `use_faces` comes first.
#include <cstddef>
#include <span>

#include "meshhood/fingerprint.h"
#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "shared/checksum.h"
#include "workspace.h"

namespace meshhood::wasm {

namespace {

/// Of the bytes of the corners and the offsets, in their order: `meshhood::fingerprint` does not see which way round a
/// face is, on which its normal depends.
Fingerprint hash_faces(const FacesView& faces) {
  const auto bytes_of = [](const IndicesView& indices) {
    return indices.visit([](auto values) { return std::as_bytes(values); });
  };
  const std::size_t corner_count = faces.corners().size();
  return wide_checksum(
      {std::as_bytes(std::span(&corner_count, 1)), bytes_of(faces.corners()), bytes_of(faces.offsets())});
}

}  // namespace

[[clang::export_name("use_faces")]] void use_faces() { workspace.use_faces(given.faces, hash_faces(given.faces)); }

/// See `append_point`.
[[clang::export_name("closest_point")]] void closest_point(double x, double y, double z) {
  answer = {};
  append_point(workspace.surface().closest_point({x, y, z}));
}

/// The same; the distance is infinite if the ray meets nothing.
[[clang::export_name("first_hit")]] void first_hit(double x, double y, double z, double along_x, double along_y,
                                                   double along_z) {
  answer = {};
  append_point(workspace.surface().first_hit({x, y, z}, {along_x, along_y, along_z}));
}

/// Of vertices, or, unless `points` is null, of a point for each face.
[[clang::export_name("thickness")]] void thickness(const VertexId* faces, std::size_t face_count,
                                                   const SpacePoint* points, const VertexId* vertices,
                                                   std::size_t vertex_count, ThicknessMethod method) {
  const std::span numbers(faces, face_count);
  answer.reals = points == nullptr
                     ? meshhood::thickness(workspace.surface(), view_vertices(vertices, vertex_count), method)
                     : meshhood::thickness(workspace.surface(), numbers, {points, face_count}, method);
}

// Regions as meshes.

/// The ids of the answer are the vertices, and the counts the faces, their offsets, and the corners. Returns the number
/// of faces.
[[clang::export_name("submesh")]] std::size_t submesh(const VertexId* ids, std::size_t count, Corners corners) {
  const Submesh part = workspace.surface().submesh({ids, count}, corners);
  answer = {.ids = part.vertices, .reals = {}, .counts = {part.faces.begin(), part.faces.end()}};
  answer.counts.insert(answer.counts.end(), part.offsets.begin(), part.offsets.end());
  answer.counts.insert(answer.counts.end(), part.corners.begin(), part.corners.end());
  return part.faces.size();
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

}  // namespace meshhood::wasm
