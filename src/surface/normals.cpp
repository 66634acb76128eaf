// SPDX-License-Identifier: MIT
// The normal of a vertex is the sum of the vector areas of its faces, normalized. The vector area of a triangle is half
// the cross product of two edges; that of a polygon is Newell's sum. Its length is the area, of which the vertices of a
// face have equal shares.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "meshhood/aggregate.h"
#include "meshhood/error.h"

#include "base/frame.h"
#include "base/vector.h"
#include "shared/parallel.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kVerticesPerTask = 2048;

/// Returns the place of each of the caller's vertices in index order.
RawVector<std::uint32_t> places_of_vertices(const IndexView& index, TaskContext& task) {
  RawVector<std::uint32_t> places(index.vertex_count());
  task.parallel_for(places.size(), kVerticesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) places[index.id(i)] = static_cast<std::uint32_t>(i);
  });
  return places;
}

/// Returns the vector area of a face in the unit of the frame, where products do not overflow. `place_of(i)` is the
/// place of corner `i` in `xyz`. The origin of the frame is not taken off: it may be far from the face.
template <class Positions, class PlaceOf>
Point vector_area(const Positions& xyz, double scale, std::size_t corners, PlaceOf&& place_of) {
  const auto corner = [&](std::size_t i) { return scale * point(xyz, place_of(i)); };
  if (corners == 3) return 0.5 * doubled_vector_area(corner(0), corner(1), corner(2));
  return 0.5 * doubled_vector_area(corners, corner);
}

/// Sets the normals of a range of places: the sums of the vector areas of the faces at each vertex, in the order of the
/// faces, as unit vectors.
template <class Real>
void sum_areas(std::span<const Real> xyz, double scale, std::span<const std::uint32_t> places, const FacesView& faces,
               std::size_t first, std::size_t end, Normals& normals) {
  for (const std::span<double> axis : {std::span(normals.x), std::span(normals.y), std::span(normals.z)}) {
    std::ranges::fill(axis.subspan(first, end - first), 0.0);
  }
  // Below `first`, the difference wraps around to a large number.
  const auto is_summed = [&](VertexId v) { return places[v] - first < end - first; };
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    if (std::none_of(corners.begin(), corners.end(), is_summed)) return;
    const Point area = vector_area(xyz, scale, corners.size(), [&](std::size_t i) { return places[corners[i]]; });
    for (const VertexId v : corners) {
      if (!is_summed(v)) continue;
      normals.x[places[v]] += area.x;
      normals.y[places[v]] += area.y;
      normals.z[places[v]] += area.z;
    }
  });
  for (std::size_t place = first; place < end; ++place) {
    normals.set(place, {normals.x[place], normals.y[place], normals.z[place]});
  }
}

}  // namespace

void Normals::set(std::size_t place, const Point& n) {
  const double norm = length_without_underflow(n);
  const double size = norm > 0 ? norm : kNan;
  x[place] = n.x / size;
  y[place] = n.y / size;
  z[place] = n.z / size;
}

// Each thread reads all faces, and sums at its part of the vertices. Many parts would mostly repeat the reading.
Normals make_normals(const IndexView& index, const FacesView& faces, TaskContext& task) {
  constexpr std::size_t kMostParts = 4;
  Normals normals(index.vertex_count());
  const RawVector<std::uint32_t> places = places_of_vertices(index, task);
  const std::size_t parts = std::min<std::size_t>(task.threads(), kMostParts);
  task.parallel_for(places.size(), places.size() / parts + 1, [&](unsigned, std::size_t begin, std::size_t end) {
    std::visit([&](auto xyz) { sum_areas(xyz, index.frame.scale, places, faces, begin, end, normals); },
               index.positions);
  });
  return normals;
}

void renew_normals(const IndexView& index, const StoredFaces& faces, const FaceLists& lists,
                   std::span<const VertexId> vertices, Normals& normals) {
  for (const VertexId v : vertices) {
    Point sum{0, 0, 0};
    for (const std::uint32_t face : lists[v]) {
      const std::span<const VertexId> corners = faces[face];
      sum = sum + std::visit(
                      [&](auto xyz) {
                        return vector_area(xyz, index.frame.scale, corners.size(),
                                           [&](std::size_t i) { return index.place(corners[i]); });
                      },
                      index.positions);
    }
    normals.set(index.place(v), sum);
  }
}

Normals read_normals(const IndexView& index, std::span<const double> given) {
  const std::size_t vertices = index.vertex_count();
  if (given.size() != 3 * vertices) {
    raise(ErrorCode::InvalidMesh, std::to_string(given.size()) + " components of normals, expected three for each of " +
                                      std::to_string(vertices) + " vertices");
  }
  Normals normals(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    const VertexId id = index.id(i);
    const Point n = point(given, id);
    const double largest = largest_component(n);
    if (std::isinf(n.x) || std::isinf(n.y) || std::isinf(n.z)) {
      raise(ErrorCode::InvalidMesh,
            "the normal of vertex " + std::to_string(id) + " is infinite, expected numbers, or NaN for no normal");
    }
    normals.set(i, {n.x / largest, n.y / largest, n.z / largest});  // a square of the given components might overflow
  }
  return normals;
}

std::vector<double> vertex_areas(const MeshView& mesh) {
  validate(mesh);
  const double scale = make_frame(mesh.positions).scale;
  std::vector<double> areas(mesh.positions.size());
  mesh.positions.visit([&](const auto& xyz) {
    mesh.faces.for_each([&](std::size_t /*face*/, std::span<const VertexId> corners) {
      if (corners.size() < 3) return;
      const Point area = vector_area(xyz, scale, corners.size(), [&](std::size_t i) { return corners[i]; });
      const double share = length_without_underflow(area) / static_cast<double>(corners.size());
      for (const VertexId corner : corners) areas[corner] += share;
    });
  });
  for (double& area : areas) area = (area / scale) / scale;
  return areas;
}

}  // namespace meshhood::inline v0_1
