// SPDX-License-Identifier: MIT
// The normals of the vertices.
#include "curvature/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "meshhood/error.h"

#include "base/validate.h"
#include "base/vector.h"
#include "exact/neighbors.h"
#include "shared/parallel.h"

namespace meshhood {
namespace {

bool same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// The index does not keep the faces: they must be those of the same vertices.
void check_positions(const IndexView& index, const MeshView& mesh) {
  if (mesh.positions.size() != index.vertex_count()) {
    raise(ErrorCode::InvalidMesh, "the mesh has " + std::to_string(mesh.positions.size()) +
                                      " vertices, but the index has " + std::to_string(index.vertex_count()));
  }
  mesh.positions.visit([&](const auto& given) {
    std::visit(
        [&](auto kept) {
          for (std::size_t i = 0; i < index.vertex_count(); ++i) {
            if (same(point(given, index.id(i)), point(kept, i))) continue;
            raise(ErrorCode::InvalidMesh, "vertex " + std::to_string(index.id(i)) +
                                              " has moved since the index was built, expected the same mesh");
          }
        },
        index.positions);
  });
}

/// Stores the normals of vertices from the place `begin` on as unit vectors; one of length 0 becomes NaN.
void set_normals(SurfaceState& state, std::size_t begin, std::span<const Point> normals) {
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Point& n = normals[i];
    const double norm = length(n);
    const double size = norm > 0 ? norm : std::numeric_limits<double>::quiet_NaN();
    state.normal_x[begin + i] = n.x / size;
    state.normal_y[begin + i] = n.y / size;
    state.normal_z[begin + i] = n.z / size;
  }
}

/// The sums of the vector areas of the faces at the vertices whose places are in a range: in the frame, where products
/// do not overflow, and in the order of the faces.
template <class Real>
std::vector<Point> sum_areas(const IndexView& index, std::span<const Real> xyz, const FacesView& faces,
                             std::size_t begin, std::size_t end) {
  std::vector<Point> sums(end - begin, {0, 0, 0});
  const auto is_summed = [&](std::uint32_t place) { return begin <= place && place < end; };
  std::vector<std::uint32_t> places;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    places.clear();
    for (const VertexId corner : corners) places.push_back(place_of(index, corner));
    if (std::none_of(places.begin(), places.end(), is_summed)) return;
    const Point area = 0.5 * doubled_vector_area(places.size(), [&](std::size_t i) {
                         return index.frame.scale * point(xyz, places[i]);
                       });
    for (const std::uint32_t place : places) {
      if (is_summed(place)) sums[place - begin] = sums[place - begin] + area;
    }
  });
  return sums;
}

/// Each thread reads all faces, and sums at its part of the vertices. Many parts would mostly repeat the reading.
void sum_normals(SurfaceState& state, const FacesView& faces, TaskContext& task) {
  constexpr std::size_t kMostParts = 4;
  const IndexView& index = *state.index;
  const std::size_t parts = std::min<std::size_t>(task.threads(), kMostParts);
  task.parallel_for(index.vertex_count(), index.vertex_count() / parts + 1,
                    [&](unsigned, std::size_t begin, std::size_t end) {
                      const auto sums = [&](auto xyz) { return sum_areas(index, xyz, faces, begin, end); };
                      set_normals(state, begin, std::visit(sums, index.positions));
                    });
}

/// `faces` are valid.
CurvatureIndex of_faces(const Index& index, const FacesView& faces, TaskContext& task) {
  if (faces.size() == 0 && index.vertex_count() != 0) {
    raise(ErrorCode::InvalidMesh, "the mesh has no faces, expected faces or normals");
  }
  auto state = std::make_unique<SurfaceState>(index);
  sum_normals(*state, faces, task);
  return CurvatureAccess::make(std::move(state));
}

}  // namespace

// `searched` is never refitted. If the caller's index is, in place, `check_current` of `index` throws.
CurvatureIndex::State::State(const Index& given)
    : searched(IndexAccess::alias(given)),
      index(searched),
      normal_x(given.vertex_count()),
      normal_y(given.vertex_count()),
      normal_z(given.vertex_count()) {}

std::size_t CurvatureIndex::State::first_neighbor(std::size_t place) const {
  const std::uint32_t slot = index->slot[index->id(place)];
  std::size_t first = place;
  for_each_neighbor(*index, leaf_of(slot), lane_of(slot), [&](std::size_t other) {
    if (first == place || index->id(other) < index->id(first)) first = other;
  });
  return first;
}

CurvatureIndex CurvatureIndex::build(const Index& index, const MeshView& mesh, unsigned threads) {
  TaskContext task(threads);
  validate(mesh, task);
  check_positions(IndexAccess::view(index), mesh);
  return of_faces(index, mesh.faces, task);
}

CurvatureIndex CurvatureIndex::build(const Index& index, const FacesView& faces, unsigned threads) {
  TaskContext task(threads);
  validate(MeshView{index.positions(), faces}, task);
  return of_faces(index, faces, task);
}

CurvatureIndex CurvatureIndex::build(const Index& index, std::span<const double> normals) {
  const std::size_t vertices = index.vertex_count();
  if (normals.size() != 3 * vertices) {
    raise(ErrorCode::InvalidMesh, std::to_string(normals.size()) +
                                      " components of normals, expected three for each of " + std::to_string(vertices) +
                                      " vertices");
  }
  auto state = std::make_unique<State>(index);
  std::vector<Point> scaled;
  scaled.reserve(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    const VertexId id = state->index->id(i);
    const Point n = point(normals, id);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (std::isinf(n.x) || std::isinf(n.y) || std::isinf(n.z)) {
      raise(ErrorCode::InvalidMesh,
            "the normal of vertex " + std::to_string(id) + " is infinite, expected numbers, or NaN for no normal");
    }
    scaled.push_back({n.x / largest, n.y / largest, n.z / largest});  // its square may overflow
  }
  set_normals(*state, 0, scaled);
  return CurvatureIndex(std::move(state));
}

CurvatureIndex::CurvatureIndex(std::unique_ptr<const State> state) : state_(std::move(state)) {}
CurvatureIndex::CurvatureIndex(CurvatureIndex&&) noexcept = default;
CurvatureIndex& CurvatureIndex::operator=(CurvatureIndex&&) noexcept = default;
CurvatureIndex::~CurvatureIndex() = default;

std::size_t CurvatureIndex::vertex_count() const { return state_->normal_x.size(); }

std::size_t CurvatureIndex::bytes() const { return 3 * state_->normal_x.size() * sizeof(double); }

double libigl_radius(const MeshView& mesh, double edges) {
  validate(mesh);
  double sum = 0;
  std::size_t sides = 0;
  mesh.positions.visit([&](const auto& xyz) {
    mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const VertexId next = corners[(i + 1) % corners.size()];
        sum += std::sqrt(squared_distance(point(xyz, corners[i]), point(xyz, next)));
        ++sides;
      }
    });
  });
  return sides == 0 ? 0 : edges * (sum / static_cast<double>(sides));
}

}  // namespace meshhood
