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
#include "shared/raw_vector.h"

namespace meshhood {
namespace {

constexpr std::size_t kVerticesPerTask = 2048;

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

/// Stores a normal as a unit vector; one of length 0 becomes NaN.
void set_normal(SurfaceState& state, std::size_t place, const Point& n) {
  const double norm = length(n);
  const double size = norm > 0 ? norm : std::numeric_limits<double>::quiet_NaN();
  state.normal_x[place] = n.x / size;
  state.normal_y[place] = n.y / size;
  state.normal_z[place] = n.z / size;
}

/// The place of each of the caller's vertices in index order.
RawVector<std::uint32_t> places_of_vertices(const IndexView& index, TaskContext& task) {
  RawVector<std::uint32_t> places(index.vertex_count());
  task.parallel_for(places.size(), kVerticesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) places[index.id(i)] = static_cast<std::uint32_t>(i);
  });
  return places;
}

/// Sets the normals of a range of places: the sums of the vector areas of the faces at each vertex, in the order of the
/// faces, as unit vectors. The areas are computed in the unit of the frame, where products do not overflow.
template <class Real>
void sum_areas(std::span<const Real> xyz, std::span<const std::uint32_t> places, const FacesView& faces,
               std::size_t first, std::size_t end, SurfaceState& state) {
  const double scale = state.index->frame.scale;
  for (const std::span<double> axis : {state.normal_x, state.normal_y, state.normal_z}) {
    std::ranges::fill(axis.subspan(first, end - first), 0.0);
  }
  // Below `first`, the difference wraps around to a large number.
  const auto is_summed = [&](std::uint32_t place) { return place - first < end - first; };
  const auto position = [&](std::uint32_t place) { return scale * point(xyz, place); };
  const auto add = [&](std::uint32_t place, const Point& area) {
    if (!is_summed(place)) return;
    state.normal_x[place] += area.x;
    state.normal_y[place] += area.y;
    state.normal_z[place] += area.z;
  };
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    if (corners.size() == 3) {
      const std::uint32_t a = places[corners[0]];
      const std::uint32_t b = places[corners[1]];
      const std::uint32_t c = places[corners[2]];
      if (!is_summed(a) && !is_summed(b) && !is_summed(c)) return;
      const Point area = 0.5 * doubled_vector_area(position(a), position(b), position(c));
      add(a, area);
      add(b, area);
      add(c, area);
    } else if (std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return is_summed(places[v]); })) {
      const auto corner = [&](std::size_t i) { return position(places[corners[i]]); };
      const Point area = 0.5 * doubled_vector_area(corners.size(), corner);
      for (const VertexId c : corners) add(places[c], area);
    }
  });
  for (std::size_t place = first; place < end; ++place) set_normal(state, place, state.normal(place));
}

/// Each thread reads all faces, and sums at its part of the vertices. Many parts would mostly repeat the reading.
void sum_normals(SurfaceState& state, const FacesView& faces, TaskContext& task) {
  constexpr std::size_t kMostParts = 4;
  const RawVector<std::uint32_t> places = places_of_vertices(*state.index, task);
  const std::size_t parts = std::min<std::size_t>(task.threads(), kMostParts);
  task.parallel_for(places.size(), places.size() / parts + 1, [&](unsigned, std::size_t begin, std::size_t end) {
    std::visit([&](auto xyz) { sum_areas(xyz, places, faces, begin, end, state); }, state.index->positions);
  });
}

/// `faces` are valid.
CurvatureIndex of_faces(const Index& index, const FacesView& faces, TaskContext& task) {
  if (faces.size() == 0 && index.vertex_count() != 0) {
    raise(ErrorCode::InvalidMesh, "the mesh has no faces, expected faces or normals");
  }
  auto state = std::make_unique<SurfaceState>(index);
  sum_normals(*state, faces, task);
  task.finish();
  return CurvatureAccess::make(std::move(state));
}

}  // namespace

// `searched` is never refitted. If the caller's index is, in place, `check_current` of `index` throws.
CurvatureIndex::State::State(const Index& given)
    : searched(IndexAccess::alias(given)),
      index(searched),
      normals(std::make_shared<RawVector<double>>(3 * given.vertex_count())) {
  set_spans();
}

CurvatureIndex::State::State(const Index& given, const State& other)
    : searched(IndexAccess::alias(given)), index(searched), normals(other.normals) {
  set_spans();
}

void CurvatureIndex::State::set_spans() {
  const std::size_t vertices = index->vertex_count();
  normal_x = std::span(*normals).first(vertices);
  normal_y = std::span(*normals).subspan(vertices, vertices);
  normal_z = std::span(*normals).last(vertices);
}

std::size_t CurvatureIndex::State::first_neighbor(std::size_t place) const {
  const std::uint32_t slot = index->slot[index->id(place)];
  std::size_t first = place;
  for_each_neighbor(*index, leaf_of(slot), lane_of(slot), [&](std::size_t other) {
    if (first == place || index->id(other) < index->id(first)) first = other;
  });
  return first;
}

CurvatureIndex CurvatureIndex::build(const Index& index, const MeshView& mesh, const Run& run) {
  TaskContext task(run.threads, run.progress, 1);
  validate(mesh, task);
  check_positions(IndexAccess::view(index), mesh);
  return of_faces(index, mesh.faces, task);
}

CurvatureIndex CurvatureIndex::build(const Index& index, const FacesView& faces, const Run& run) {
  TaskContext task(run.threads, run.progress, 1);
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
  for (std::size_t i = 0; i < vertices; ++i) {
    const VertexId id = state->index->id(i);
    const Point n = point(normals, id);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (std::isinf(n.x) || std::isinf(n.y) || std::isinf(n.z)) {
      raise(ErrorCode::InvalidMesh,
            "the normal of vertex " + std::to_string(id) + " is infinite, expected numbers, or NaN for no normal");
    }
    set_normal(*state, i, {n.x / largest, n.y / largest, n.z / largest});  // its square may overflow
  }
  return CurvatureIndex(std::move(state));
}

CurvatureIndex CurvatureIndex::on(const Index& index) const {
  // Masked indices share this counter with their mesh; a refitted copy has its own.
  if (IndexAccess::view(index).newest != state_->index->newest) {
    raise(ErrorCode::InvalidOption, "the index is of another mesh, expected one from `masked` of that of the surface");
  }
  return CurvatureIndex(std::make_unique<State>(index, *state_));
}

CurvatureIndex::CurvatureIndex(std::unique_ptr<const State> state) : state_(std::move(state)) {}

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
