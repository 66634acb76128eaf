// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "meshhood/aggregate.h"
#include "meshhood/curvature.h"
#include "meshhood/error.h"

#include "base/validate.h"
#include "base/vector.h"
#include "curvature/quadric.h"
#include "curvature/symmetric.h"
#include "shared/distance.h"
#include "shared/parallel.h"
#include "simd/moments.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

/// Area, mean and Gaussian curvature, and the anisotropic measure, row by row.
using Measures = std::array<double, CorrectedCurvatures::kMeasures>;

/// A corner of a triangle and its normal.
struct Corner {
  Point x;
  Point u;
};

std::array<double, 3> components(const Point& p) { return {p.x, p.y, p.z}; }

/// Adds the measures of a triangle. With x01, x02 the sides at corner 0 and u the mean of the normals u0, u1, u2:
///     area         u . (x01 x x02) / 2
///     mean         u . ((u0 - u2) x x01 + (u1 - u0) x x02) / 2, twice the integral of H
///     Gaussian     u0 . (u1 x u2) / 2
///     anisotropic  u . (e_i x x01 (u2 - u0)_j - e_i x x02 (u1 - u0)_j) / 2 for row i, column j
/// and u . (e_i x a) = (a x u)_i.
void add_triangle(const Corner& c0, const Corner& c1, const Corner& c2, Measures& sum) {
  const Point u = (1.0 / 3) * (c0.u + c1.u + c2.u);
  const Point x01 = c1.x - c0.x;
  const Point x02 = c2.x - c0.x;
  const Point u01 = c1.u - c0.u;
  const Point u02 = c2.u - c0.u;
  sum[0] += dot(u, cross(x01, x02)) / 2;
  sum[1] += dot(u, cross(u01, x02) - cross(u02, x01)) / 2;
  sum[2] += dot(c0.u, cross(c1.u, c2.u)) / 2;
  const auto a = components(cross(x01, u));
  const auto b = components(cross(x02, u));
  const auto p = components(u01);
  const auto q = components(u02);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) sum[3 + 3 * i + j] += (a[i] * q[j] - b[i] * p[j]) / 2;
  }
}

Measures measures_of(std::span<const Corner> face) {
  Measures sum{};
  if (face.size() == 3) {
    add_triangle(face[0], face[1], face[2], sum);
    return sum;
  }
  Corner middle{{0, 0, 0}, {0, 0, 0}};
  for (const Corner& corner : face) middle = {middle.x + corner.x, middle.u + corner.u};
  middle.x = (1 / static_cast<double>(face.size())) * middle.x;
  middle.u = unit(middle.u);
  for (std::size_t i = 0; i < face.size(); ++i) add_triangle(face[i], face[(i + 1) % face.size()], middle, sum);
  return sum;
}

/// Returns the measures that each vertex holds, #V by 12 in the caller's order. Lengths are in the frame, where nothing
/// overflows.
std::vector<double> measures_by_vertex(const OrientedIndex& surface, const FacesView& faces) {
  const IndexView& index = *surface.index;
  std::vector<double> held(std::tuple_size_v<Measures> * index.vertex_count());
  std::vector<Corner> face;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    if (corners.size() < 3) return;
    face.clear();
    const std::uint32_t first = index.place(corners[0]);
    for (const VertexId corner : corners) {
      const std::uint32_t place = index.place(corner);
      const Point x = index.frame.scale * (surface.position(place) - surface.position(first));
      face.push_back({x, surface.normal(place)});
    }
    const Measures measures = measures_of(face);
    for (const double measure : measures) {
      if (std::isnan(measure)) return;
    }
    const double share = 1 / static_cast<double>(corners.size());
    for (const VertexId corner : corners) {
      double* const to = &held[measures.size() * corner];
      for (std::size_t i = 0; i < measures.size(); ++i) to[i] += share * measures[i];
    }
  });
  return held;
}

/// Returns the quadric whose shape operator is the symmetric part of the anisotropic measure over the tangent plane.
/// CGAL excludes the normal by a large eigenvalue; this is the limit of its result for an infinite one.
Quadric quadric_of(std::span<const double> m, const TangentFrame& frame) {
  const auto along = [&](const Point& a, const Point& b) {
    const Point m_b{m[3] * b.x + m[4] * b.y + m[5] * b.z, m[6] * b.x + m[7] * b.y + m[8] * b.z,
                    m[9] * b.x + m[10] * b.y + m[11] * b.z};
    return dot(a, m_b);
  };
  return {along(frame.u, frame.u) / 2, (along(frame.u, frame.v) + along(frame.v, frame.u)) / 2,
          along(frame.v, frame.v) / 2, 0, 0};
}

/// Writes rows from the measures of all neighborhoods.
struct CorrectedRows {
  std::span<const double> sums;  // #rows by `CorrectedCurvatures::kMeasures`
  double scale;                  // of the frame
  CorrectedCurvatures& out;

  [[nodiscard]] std::span<const double> measures(std::size_t row) const {
    return sums.subspan(CorrectedCurvatures::kMeasures * row, CorrectedCurvatures::kMeasures);
  }

  /// Writes up to 32 rows. `normal(row)` is that of the query vertex.
  template <class F>
  void write(std::size_t begin, std::size_t end, F&& normal) const {
    QueryFrames frames{};
    QueryQuadrics quadrics{};
    const MomentKernels& kernels = moment_kernels(best_isa());
    for (std::size_t row = begin; row < end; ++row) frames.n.set(row - begin, normal(row));
    kernels.set_tangents(end - begin, frames);
    for (std::size_t row = begin; row < end; ++row) {
      set_quadric(quadrics, row - begin, quadric_of(measures(row), frame_of_query(frames, row - begin)));
    }
    QueryCurvatures curvatures{};
    principal_curvatures(kernels, quadrics, frames, end - begin, ShapeOperator::Exact, curvatures);
    for (std::size_t row = begin; row < end; ++row) {
      write_sums(row);
      const std::size_t q = row - begin;
      const double area = measures(row)[0];
      const bool exists = area != 0 && !std::isnan(frames.n.x[q]);
      const Point nan{kNan, kNan, kNan};
      // The area is negative where the given normals point to the other side of the faces: then the order changes.
      const auto& [k1, k2, d1, d2] = curvatures;
      const bool swaps = area < 0;
      out.k1[row] = exists ? (swaps ? k2 : k1)[q] / area * scale : kNan;
      out.k2[row] = exists ? (swaps ? k1 : k2)[q] / area * scale : kNan;
      set_row(out.d1, row, exists ? (swaps ? d2 : d1).at(q) : nan);
      set_row(out.d2, row, exists ? (swaps ? d1 : d2).at(q) : nan);
    }
  }

 private:
  void write_sums(std::size_t row) const {
    const std::span<const double> m = measures(row);
    double* const to = &out.measures[m.size() * row];
    to[0] = m[0] / scale / scale;
    to[1] = m[1] / scale;
    to[2] = m[2];
    for (std::size_t i = 3; i < m.size(); ++i) to[i] = m[i] / scale;
    out.area[row] = to[0];
    out.mean[row] = m[0] != 0 ? m[1] / (2 * m[0]) * scale : kNan;
    out.gaussian[row] = m[0] != 0 ? m[2] / m[0] * scale * scale : kNan;
  }
};

}  // namespace

CorrectedCurvatures corrected_curvatures(const Surface& surface, const BatchQuery& query, const Run& run) {
  if (surface.face_count() == 0 && surface.vertex_count() != 0) {
    raise(ErrorCode::InvalidMesh, "the surface has no faces, expected faces, also with normals");
  }
  TaskContext task(run.threads);
  const OrientedIndex state = SurfaceAccess::oriented(surface, task);
  constexpr std::size_t kChannels = CorrectedCurvatures::kMeasures;
  const std::vector<double> held = measures_by_vertex(state, SurfaceAccess::state(surface).faces().view());
  std::vector<VertexId> listed;
  AggregateQuery sum{.vertices = {}, .radius = query.radius, .metric = query.metric, .reduce = {Reduce::Sum}};
  if (query.vertices.list()) {
    listed.assign(query.vertices.list()->begin(), query.vertices.list()->end());
    sum.vertices = listed;
  }
  const std::vector<double> sums = aggregate(*state.searched, {.values = held, .channels = kChannels}, sum,
                                             {.threads = run.threads, .progress = run.progress});
  const std::size_t results = sums.size() / kChannels;
  const std::size_t rows = sum.vertices.count(surface.vertex_count());
  CorrectedCurvatures result;
  result.measures.resize(sums.size());
  for (auto* const numbers : {&result.area, &result.mean, &result.gaussian, &result.k1, &result.k2}) {
    numbers->resize(results);
  }
  result.d1.resize(3 * results);
  result.d2.resize(3 * results);
  const auto normal = [&](std::size_t row) { return state.normal(state.index->place(sum.vertices[row % rows])); };
  const CorrectedRows writer{sums, state.index->frame.scale, result};
  task.parallel_for(results, kPacketCapacity,
                    [&](unsigned, std::size_t begin, std::size_t end) { writer.write(begin, end, normal); });
  return result;
}

}  // namespace meshhood::inline v0_1
