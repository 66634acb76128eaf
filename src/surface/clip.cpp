// SPDX-License-Identifier: MIT
// The part of a surface inside a ball: whole faces, and of the others the runs of corners inside, with the points of
// the rim before and after each.
#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "meshhood/aggregate.h"

#include "exact/query/arguments.h"
#include "surface/submesh.h"

namespace meshhood {
namespace {

/// Polygons whose corners are vertices, as an edge from a vertex to itself, and points on edges.
class Pieces {
 public:
  /// Adds the parts of a face inside the region.
  template <class IsInside>
  void add(std::size_t face, std::span<const VertexId> corners, IsInside&& is_inside) {
    if (std::all_of(corners.begin(), corners.end(), is_inside)) {
      for (const VertexId v : corners) corners_.push_back({v, v});
      close(face);
      return;
    }
    const auto corner = [&](std::size_t i) { return corners[i % corners.size()]; };
    for_each_run(corners, is_inside, [&](std::size_t begin, std::size_t count) {
      corners_.push_back({corner(begin), corner(begin + corners.size() - 1)});
      for (std::size_t i = begin; i < begin + count; ++i) corners_.push_back({corner(i), corner(i)});
      corners_.push_back({corner(begin + count - 1), corner(begin + count)});
      close(face);
    });
  }

  /// Numbers the points: vertices first.
  [[nodiscard]] ClippedMesh number() && {
    ClippedMesh mesh;
    mesh.edges = corners_;
    const auto order = [](const RimEdge& a, const RimEdge& b) {
      const bool is_vertex_a = a[0] == a[1];
      const bool is_vertex_b = b[0] == b[1];
      return is_vertex_a != is_vertex_b ? is_vertex_a : a < b;
    };
    std::sort(mesh.edges.begin(), mesh.edges.end(), order);
    mesh.edges.erase(std::unique(mesh.edges.begin(), mesh.edges.end()), mesh.edges.end());
    mesh.corners.reserve(corners_.size());
    for (const RimEdge& corner : corners_) {
      const auto place = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), corner, order);
      mesh.corners.push_back(static_cast<VertexId>(place - mesh.edges.begin()));
    }
    mesh.faces = std::move(faces_);
    mesh.offsets = std::move(offsets_);
    return mesh;
  }

 private:
  void close(std::size_t face) {
    faces_.push_back(face);
    offsets_.push_back(corners_.size());
  }

  std::vector<RimEdge> corners_;
  std::vector<std::size_t> faces_;
  std::vector<std::uint64_t> offsets_{0};
};

}  // namespace

ClippedMesh Surface::clip(std::span<const VertexId> ids, const SpacePoint& center, double radius) const {
  const State& state = SurfaceAccess::state(*this);
  check_point(center, "center: ");
  check_radius(radius);
  const FaceSelection selection(state, ids, Corners::Any);
  Pieces pieces;
  for (const std::size_t face : selection.faces()) {
    const auto corners = state.faces()[face];
    if (corners.size() < 3) continue;
    pieces.add(face, corners, [&](VertexId v) { return selection.has(v); });
  }
  ClippedMesh mesh = std::move(pieces).number();
  mesh.points = rim_points(*state.index, mesh.edges, center, radius);
  const std::vector<double> areas = meshhood::vertex_areas(mesh.view());
  mesh.area = std::accumulate(areas.begin(), areas.end(), 0.0);
  return mesh;
}

}  // namespace meshhood
