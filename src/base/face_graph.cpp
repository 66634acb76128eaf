// SPDX-License-Identifier: MIT
// Finds the faces at each edge by sorting their sides.
#include "meshhood/face_graph.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "base/lists.h"
#include "base/vector.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// A side of a face: its ends, ascending, and the face.
using Side = std::array<VertexId, 3>;

using FacePair = std::pair<VertexId, VertexId>;

std::vector<Side> sides_of(const FacesView& faces) {
  std::vector<Side> sides;
  sides.reserve(faces.corner_count());
  faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
      if (low != high) sides.push_back({low, high, static_cast<VertexId>(face)});
    }
  });
  sort_out(sides);
  return sides;
}

/// Returns the pairs of faces that share an edge, in both directions, ascending.
std::vector<FacePair> pairs_of(std::span<const Side> sides) {
  std::vector<FacePair> pairs;
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end][0] == sides[begin][0] && sides[end][1] == sides[begin][1]) ++end;
    const std::size_t faces = end - begin;
    if (faces > 1 && faces * (faces - 1) > kMaxNeighbors - pairs.size()) {
      raise(ErrorCode::TooLarge, "the edge from vertex " + std::to_string(sides[begin][0]) + " to " +
                                     std::to_string(sides[begin][1]) + " has " + std::to_string(faces) +
                                     " faces: there are more than " + std::to_string(kMaxNeighbors) +
                                     " neighbors, the most that a graph may have");
    }
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = begin; j < end; ++j) {
        if (i != j) pairs.emplace_back(sides[i][2], sides[j][2]);
      }
    }
    begin = end;
  }
  sort_out(pairs);
  return pairs;
}

std::vector<double> centers_of(const MeshView& mesh) {
  std::vector<double> centers;
  centers.reserve(3 * mesh.faces.size());
  mesh.positions.visit([&](const auto& xyz) {
    mesh.faces.for_each([&](std::size_t face, std::span<const VertexId> corners) {
      if (corners.empty()) {
        raise(ErrorCode::InvalidMesh, "face " + std::to_string(face) + " has no corners, expected at least one");
      }
      const double share = 1 / static_cast<double>(corners.size());
      Point center{0, 0, 0};
      for (const VertexId v : corners) center = center + share * point(xyz, v);  // the sum might be too large
      centers.insert(centers.end(), {center.x, center.y, center.z});
    });
  });
  return centers;
}

}  // namespace

GraphData face_graph(const MeshView& mesh) {
  validate(mesh);
  if (mesh.faces.size() > kMaxVertices) {
    raise(ErrorCode::TooLarge,
          std::to_string(mesh.faces.size()) + " faces, expected at most " + std::to_string(kMaxVertices));
  }
  GraphData graph;
  graph.positions = centers_of(mesh);
  graph.adjacency.offsets.assign(mesh.faces.size() + 1, 0);
  const std::vector<FacePair> pairs = pairs_of(sides_of(mesh.faces));
  graph.adjacency.neighbors.reserve(pairs.size());
  for (const auto& [face, other] : pairs) {
    ++graph.adjacency.offsets[face + std::size_t{1}];
    graph.adjacency.neighbors.push_back(other);
  }
  std::vector<EdgeOffset>& offsets = graph.adjacency.offsets;
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  return graph;
}

}  // namespace meshhood::inline v0_1
