// SPDX-License-Identifier: MIT
// Computes the principal curvatures of a batch, packet by packet.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/curvature.h"
#include "meshhood/error.h"

#include "base/prefetch.h"
#include "base/vector.h"
#include "curvature/packet_moments.h"
#include "curvature/quadric.h"
#include "curvature/symmetric.h"
#include "exact/index_access.h"
#include "shared/large_pages.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

TangentFrame frame_at(const OrientedIndex& surface, std::uint32_t place, ShapeOperator shape_operator) {
  const Point normal = surface.normal(place);
  if (shape_operator == ShapeOperator::Exact) return frame_of(normal);
  return frame_towards(normal, surface.position(surface.first_neighbor(place)) - surface.position(place));
}

/// Fits the rows of packets. Each thread needs its own.
class CurvatureFitter {
 public:
  CurvatureFitter(const OrientedIndex& surface, Metric metric, const CurvatureOptions& options,
                  const CurvatureMemory& out)
      : surface_(&surface), options_(&options), out_(out), direct_(surface, metric, options) {}

  void fit(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments);

 private:
  void fit_row(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments, std::size_t query);
  void set_frames(std::span<const std::uint32_t> places, const QueryMoments& moments, const MomentKernels& kernels);
  void prefetch_row(std::size_t row) const;
  void write(std::size_t row, const DirectFit::Result& result);

  const OrientedIndex* surface_;
  const CurvatureOptions* options_;
  CurvatureMemory out_;
  DirectFit direct_;
  QueryFrames frames_{};  // of the fits
  FrameMoments in_frame_{};
  QueryQuadrics quadrics_{};
  QueryCurvatures curvatures_{};
};

void CurvatureFitter::fit(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments) {
  for_each_query(packet.queries, [&](std::size_t q) { prefetch_row(packet.rows[q]); });
  const MomentKernels& kernels = sums.kernels();
  set_frames(packet.places, moments, kernels);
  kernels.rotate(moments, frames_, in_frame_);
  (options_->fit == CurvatureFit::Quadric ? kernels.fit_quadrics : kernels.fit_jets)(in_frame_, quadrics_);
  principal_curvatures(kernels, quadrics_, frames_, packet.places.size(), options_->shape_operator, curvatures_);
  for_each_query(packet.queries, [&](std::size_t q) { fit_row(packet, sums, moments, q); });
}

void CurvatureFitter::set_frames(std::span<const std::uint32_t> places, const QueryMoments& moments,
                                 const MomentKernels& kernels) {
  const bool is_jet = options_->fit == CurvatureFit::Jet;
  if (!is_jet && options_->shape_operator == ShapeOperator::Exact) {
    for (std::size_t q = 0; q < places.size(); ++q) frames_.n.set(q, surface_->normal(places[q]));
    return kernels.set_tangents(places.size(), frames_);
  }
  for (std::size_t q = 0; q < places.size(); ++q) {
    set_frame(frames_, q,
              is_jet ? jet_frame(distribution_of(moments, q).axes, surface_->normal(places[q]))
                     : frame_at(*surface_, places[q], options_->shape_operator));
  }
}

void CurvatureFitter::fit_row(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments,
                              std::size_t query) {
  const std::size_t row = packet.rows[query];
  const std::uint32_t place = packet.places[query];
  if (std::isnan(surface_->normal(place).x)) return write(row, {CurvatureState::NoNormal, {}, 0});
  const auto count = static_cast<std::size_t>(moments.at[0][query]);
  const bool is_well_conditioned =
      quadrics_.determinant[query] >=
      smallest_determinant(in_frame_, query, sums.second_size(query), sums.fourth_size(query));
  if (count < kFewestPoints || !is_well_conditioned) {
    return write(row, direct_.fit(place, packet.radii[query], frame_at(*surface_, place, options_->shape_operator)));
  }
  const QueryCurvatures& found = curvatures_;
  write(row, {CurvatureState::Fitted,
              {sums.scale() * found.k1[query], sums.scale() * found.k2[query], found.d1.at(query), found.d2.at(query)},
              count});
}

/// Prefetches the results of a row, because the rows of a packet are scattered over them.
void CurvatureFitter::prefetch_row(std::size_t row) const {
  prefetch(&out_.state[row]);
  prefetch(&out_.count[row]);
  prefetch(&out_.k1[row]);
  prefetch(&out_.k2[row]);
  prefetch(&out_.d1[3 * row]);
  prefetch(&out_.d2[3 * row]);
}

void CurvatureFitter::write(std::size_t row, const DirectFit::Result& result) {
  out_.state[row] = result.state;
  out_.count[row] = static_cast<std::uint32_t>(result.count);
  out_.k1[row] = result.curvature.k1;
  out_.k2[row] = result.curvature.k2;
  set_row(out_.d1, row, result.curvature.d1);
  set_row(out_.d2, row, result.curvature.d2);
}

void check_sizes(const CurvatureMemory& memory, std::size_t rows) {
  const auto check = [](const char* name, std::size_t size, std::size_t expected) {
    if (size == expected) return;
    raise(ErrorCode::InvalidOption,
          "memory for " + std::to_string(size) + " elements of " + name + ", expected for " + std::to_string(expected));
  };
  check("k1", memory.k1.size(), rows);
  check("k2", memory.k2.size(), rows);
  check("d1", memory.d1.size(), 3 * rows);
  check("d2", memory.d2.size(), 3 * rows);
  check("state", memory.state.size(), rows);
  check("count", memory.count.size(), rows);
}

/// Returns the radii of the closed balls that have the vertices nearer than `radius`; a ball of radius 0 has its
/// vertex. Numbers that are no radii stay as they are. A list is written into `memory`.
BatchRadius opened(const BatchRadius& radius, std::vector<double>& memory) {
  const auto open = [](double r) { return r > 0 ? std::nextafter(r, 0.0) : r; };
  if (!radius.list() && !radius.scales()) return open(radius.common());
  const auto radii = radius.list() ? *radius.list() : std::span<const double>(*radius.scales());
  for (const double r : radii) memory.push_back(open(r));
  return radius.list() ? BatchRadius(memory) : BatchRadius::scales(std::move(memory));
}

}  // namespace

CurvatureOptions like_libigl() { return {.filter = true, .open_ball = true, .shape_operator = ShapeOperator::Libigl}; }

Curvatures make_curvatures(std::size_t rows) {
  return {.k1 = make_values<double>(rows),
          .k2 = make_values<double>(rows),
          .d1 = make_values<double>(3 * rows),
          .d2 = make_values<double>(3 * rows),
          .state = make_values<CurvatureState>(rows),
          .count = make_values<std::uint32_t>(rows)};
}

CurvatureMemory memory_of(Curvatures& curvatures) {
  return {curvatures.k1, curvatures.k2, curvatures.d1, curvatures.d2, curvatures.state, curvatures.count};
}

PacketVisitor curvature_visitor(const OrientedIndex& surface, Metric metric, const CurvatureOptions& options,
                                const CurvatureMemory& out) {
  const MomentSource source{.index = surface.index, .filter = options.filter ? &surface : nullptr, .metric = metric};
  const auto fitter = std::make_shared<CurvatureFitter>(surface, metric, options, out);
  return moment_visitor(source, [fitter](const MomentRows& packet, const PacketMoments& sums,
                                         const QueryMoments& moments) { fitter->fit(packet, sums, moments); });
}

Curvatures curvatures(const Surface& surface, const BatchQuery& query, const CurvatureOptions& options,
                      const Run& run) {
  Curvatures result = make_curvatures(query.result_rows(surface.vertex_count(), 3));  // of a direction
  curvatures(surface, query, memory_of(result), options, run);
  return result;
}

void curvatures(const Surface& surface, const BatchQuery& query, const CurvatureMemory& out,
                const CurvatureOptions& options, const Run& run) {
  if (options.fit == CurvatureFit::Jet && options.shape_operator == ShapeOperator::Libigl) {
    raise(ErrorCode::InvalidOption, "libigl's shape operator requires the quadric, not the jet");
  }
  const OrientedIndex state = SurfaceAccess::oriented(surface, run.threads);
  check_sizes(out, query.result_rows(surface.vertex_count()));
  BatchQuery closed = query;
  std::vector<double> radii;
  if (options.open_ball && query.metric != Metric::Rings) closed.radius = opened(query.radius, radii);
  for_each_packet(
      *state.searched, closed,
      [&](unsigned /*thread*/) { return curvature_visitor(state, query.metric, options, out); }, run);
}

double shape_index(double k1, double k2) {
  if (k1 == 0 && k2 == 0) return kNan;
  return 2 * std::numbers::inv_pi * std::atan2(k1 + k2, k1 - k2);
}

double curvedness(double k1, double k2) {
  const double largest = std::max(std::abs(k1), std::abs(k2));
  if (!(largest > 0) || std::isinf(largest)) return largest;
  const double a = k1 / largest;
  const double b = k2 / largest;
  return largest * std::sqrt((a * a + b * b) / 2);
}

double libigl_radius(const MeshView& mesh, double edges) {
  check_radius(edges, "edges: ");
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

}  // namespace meshhood::inline v0_1
