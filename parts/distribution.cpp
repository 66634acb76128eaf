// SPDX-License-Identifier: MIT
#include "parts/distribution.h"

#include <algorithm>
#include <array>

#include "parts/vertex_chunks.h"
#include "shared/distance.h"

namespace meshhood::parts {

/// Which parts each corner of a chunk belongs to.
class Distribution::CornerParts {
 public:
  CornerParts(const CornerPositions& vertices, const CutTree& tree, double squared_halo) {
    begins_.reserve(vertices.size() + 1);
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      begins_.push_back(parts_.size());
      tree.find_near(vertices.at(i), squared_halo, near);
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

Distribution::Distribution(ChunkedMesh& mesh, const CutTree& tree, double halo, const std::vector<bool>& finished,
                           PartContents& contents)
    : mesh_(mesh), tree_(tree), squared_halo_(squared_radius(halo)), finished_(finished), contents_(contents) {}

std::vector<std::uint64_t> Distribution::add_vertices(Stages& stages) {
  std::vector<std::uint64_t> sizes(tree_.size());
  std::vector<std::uint32_t> near;
  for_each_vertex(mesh_, stages, [&](const Site& vertex) {
    tree_.find_near(vertex.position, squared_halo_, near);
    for (const std::uint32_t part : near) {
      ++sizes[part];
      if (!finished_[part]) contents_.vertices.append(part, vertex_words(vertex));
    }
  });
  return sizes;
}

void Distribution::add_faces(std::size_t chunk_corners, std::uint64_t corners, Stages& stages) {
  FaceChunk chunk;
  std::uint64_t done = 0;
  mesh_.rewind_faces();
  while (mesh_.read_faces(chunk_corners, chunk)) {
    const CornerPositions vertices(mesh_, chunk);
    const CornerParts parts(vertices, tree_, squared_halo_);
    for (std::size_t face = 0; face < chunk.size(); ++face) {
      add_face(chunk.face(face), vertices, parts);
    }
    stages.report(done += chunk.corners.size(), corners);
  }
}

/// Every part that has a corner of a face gets the face, and the other corners as its fringe.
void Distribution::add_face(std::span<const std::uint64_t> face, const CornerPositions& vertices,
                            const CornerParts& parts) {
  takers_.clear();
  for (const std::uint64_t corner : face) {
    const auto more = parts[vertices.number(corner)];
    takers_.insert(takers_.end(), more.begin(), more.end());
  }
  std::sort(takers_.begin(), takers_.end());
  takers_.erase(std::unique(takers_.begin(), takers_.end()), takers_.end());
  for (const std::uint32_t part : takers_) {
    if (finished_[part]) continue;
    contents_.faces.append(part, std::array{std::uint64_t{face.size()}});
    contents_.faces.append(part, face);
    for (const std::uint64_t corner : face) {
      const std::size_t number = vertices.number(corner);
      const auto has = parts[number];
      if (std::binary_search(has.begin(), has.end(), part)) continue;
      contents_.vertices.append(part, vertex_words({vertices.at(number), corner}));
    }
  }
}

}  // namespace meshhood::parts
