// SPDX-License-Identifier: MIT
#include "parts/distribution.h"

#include <span>

#include "parts/corner_positions.h"

namespace meshhood::parts {
namespace {

/// Adds a face to every part whose box is within the halo of the box of the face, and the corners that are not within
/// the halo as the fringe of the part.
void add_face(const Distribution& to, std::span<const std::uint64_t> face, const CornerPositions& vertices) {
  BoundingBox around;
  for (const std::uint64_t corner : face) around.add(vertices[corner]);
  to.tree.for_each_near(around, to.squared_halo, [&](std::uint32_t part, const BoundingBox& box) {
    if (to.finished[part]) return;
    to.contents.faces.append(part, std::uint64_t{face.size()});
    to.contents.faces.append_all(part, face);
    for (const std::uint64_t corner : face) {
      const Point& p = vertices[corner];
      if (!may_be_within(box, {p, p}, to.squared_halo)) to.contents.vertices.append(part, Site{p, corner});
    }
  });
}

}  // namespace

std::vector<std::uint64_t> Distribution::add_vertices(Stages& stages) const {
  std::vector<std::uint64_t> sizes(finished.size());
  for_each_vertex(mesh, stages, [&](const Site& vertex) {
    const BoundingBox here{vertex.position, vertex.position};
    tree.for_each_near(here, squared_halo, [&](std::uint32_t part, const BoundingBox&) {
      ++sizes[part];
      if (!finished[part]) contents.vertices.append(part, vertex);
    });
  });
  return sizes;
}

void Distribution::add_faces(std::size_t chunk_corners, std::uint64_t corners, Stages& stages) const {
  FaceChunk chunk;
  std::uint64_t done = 0;
  mesh.rewind_faces();
  while (mesh.read_faces(chunk_corners, chunk)) {
    const CornerPositions vertices(mesh, chunk);
    for (std::size_t i = 0; i < chunk.size(); ++i) add_face(*this, chunk.face(i), vertices);
    stages.report(done += chunk.corners.size(), corners);
  }
}

}  // namespace meshhood::parts
