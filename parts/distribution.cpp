// SPDX-License-Identifier: MIT
#include "parts/distribution.h"

#include <algorithm>
#include <span>

#include "parts/corner_positions.h"

namespace meshhood::parts {
namespace {

/// Which parts each corner of a chunk belongs to.
class CornerParts {
 public:
  CornerParts(const CornerPositions& vertices, const CutTree& tree, double squared_halo) {
    begins_.reserve(vertices.positions().size() + 1);
    std::vector<std::uint32_t> near;
    for (const Point& p : vertices.positions()) {
      begins_.push_back(parts_.size());
      tree.find_near(p, squared_halo, near);
      parts_.insert(parts_.end(), near.begin(), near.end());
    }
    begins_.push_back(parts_.size());
  }

  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t number) const {
    return std::span(parts_).subspan(begins_[number], begins_[number + 1] - begins_[number]);
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> parts_;  // ascending for each vertex
};

/// Every part that has a corner of a face gets the face, and the other corners as its fringe. `takers` is room for the
/// parts.
void add_face(const Distribution& to, std::span<const std::uint64_t> face, const CornerPositions& vertices,
              const CornerParts& parts, std::vector<std::uint32_t>& takers) {
  takers.clear();
  for (const std::uint64_t corner : face) {
    const auto more = parts[vertices.number(corner)];
    takers.insert(takers.end(), more.begin(), more.end());
  }
  std::sort(takers.begin(), takers.end());
  takers.erase(std::unique(takers.begin(), takers.end()), takers.end());
  for (const std::uint32_t part : takers) {
    if (to.finished[part]) continue;
    to.contents.faces.append(part, std::uint64_t{face.size()});
    to.contents.faces.append_all(part, face);
    for (const std::uint64_t corner : face) {
      const std::size_t number = vertices.number(corner);
      const auto has = parts[number];
      if (std::binary_search(has.begin(), has.end(), part)) continue;
      to.contents.vertices.append(part, Site{vertices.positions()[number], corner});
    }
  }
}

}  // namespace

std::vector<std::uint64_t> Distribution::add_vertices(Stages& stages) const {
  std::vector<std::uint64_t> sizes(finished.size());
  std::vector<std::uint32_t> near;
  for_each_vertex(mesh, stages, [&](const Site& vertex) {
    tree.find_near(vertex.position, squared_halo, near);
    for (const std::uint32_t part : near) {
      ++sizes[part];
      if (!finished[part]) contents.vertices.append(part, vertex);
    }
  });
  return sizes;
}

void Distribution::add_faces(std::size_t chunk_corners, std::uint64_t corners, Stages& stages) const {
  FaceChunk chunk;
  std::vector<std::uint32_t> takers;
  std::uint64_t done = 0;
  mesh.rewind_faces();
  while (mesh.read_faces(chunk_corners, chunk)) {
    const CornerPositions vertices(mesh, chunk);
    const CornerParts parts(vertices, tree, squared_halo);
    for (std::size_t i = 0; i < chunk.size(); ++i) add_face(*this, chunk.face(i), vertices, parts, takers);
    stages.report(done += chunk.corners.size(), corners);
  }
}

}  // namespace meshhood::parts
