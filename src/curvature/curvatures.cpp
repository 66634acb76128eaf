// SPDX-License-Identifier: MIT
// Principal curvatures of a batch, packet by packet.
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "meshhood/curvature.h"
#include "meshhood/error.h"

#include "base/vector.h"
#include "curvature/direct_fit.h"
#include "curvature/jet.h"
#include "curvature/packet_moments.h"
#include "curvature/quadric.h"
#include "curvature/surface.h"
#include "curvature/symmetric.h"
#include "curvature/visit_moments.h"
#include "exact/index_access.h"
#include "exact/query/filtered.h"

namespace meshhood {
namespace {

TangentFrame frame_at(const SurfaceState& surface, std::uint32_t place, ShapeOperator shape_operator) {
  const Point normal = surface.normal(place);
  if (shape_operator == ShapeOperator::Exact) return frame_of(normal);
  return frame_towards(normal, surface.position(surface.first_neighbor(place)) - surface.position(place));
}

/// Fits the rows of packets. One object a thread.
class CurvatureFitter {
 public:
  CurvatureFitter(const SurfaceState& surface, const Index& searched, const CurvatureOptions& options, Curvatures& out)
      : surface_(&surface), options_(&options), out_(&out), direct_(surface, searched, options) {}

  void fit(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments);

 private:
  void fit_row(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments, std::size_t query);
  [[nodiscard]] TangentFrame fit_frame(const QueryMoments& moments, std::size_t query) const;
  [[nodiscard]] std::optional<Quadric> quadric(const PacketMoments& sums, std::size_t query) const;
  void write(std::size_t row, const DirectFit::Result& result);

  const SurfaceState* surface_;
  const CurvatureOptions* options_;
  Curvatures* out_;
  DirectFit direct_;
  std::array<TangentFrame, kPacketCapacity> frames_{};  // of the vertex normals
  std::array<TangentFrame, kPacketCapacity> axes_{};    // of the fits
  QueryVectors u_{};
  QueryVectors v_{};
  QueryVectors n_{};
  FrameMoments in_frame_{};
  QueryQuadrics quadrics_{};
};

void CurvatureFitter::fit(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments) {
  for (std::size_t q = 0; q < packet.places.size(); ++q) {
    frames_[q] = frame_at(*surface_, packet.places[q], options_->shape_operator);
    axes_[q] = fit_frame(moments, q);
    u_.set(q, axes_[q].u);
    v_.set(q, axes_[q].v);
    n_.set(q, axes_[q].n);
  }
  const MomentKernels& kernels = sums.kernels();
  kernels.rotate(moments, u_, v_, n_, in_frame_);
  (options_->fit == CurvatureFit::Quadric ? kernels.fit_quadrics : kernels.fit_jets)(in_frame_, quadrics_);
  for_each_query(packet.queries, [&](std::size_t q) { fit_row(packet, sums, moments, q); });
}

void CurvatureFitter::fit_row(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments,
                              std::size_t query) {
  const std::size_t row = packet.rows[query];
  if (std::isnan(frames_[query].n.x)) return write(row, {CurvatureState::NoNormal, {}, 0});
  const auto count = static_cast<std::size_t>(moments.at[0][query]);
  if (count >= kFewestPoints) {
    if (const std::optional<Quadric> fitted = quadric(sums, query)) {
      PrincipalCurvature result = principal_curvature(*fitted, axes_[query], options_->shape_operator);
      result.k1 *= sums.scale();
      result.k2 *= sums.scale();
      return write(row, {CurvatureState::Fitted, result, count});
    }
  }
  write(row, direct_.fit(packet.places[query], packet.radii[query], frames_[query]));
}

TangentFrame CurvatureFitter::fit_frame(const QueryMoments& moments, std::size_t query) const {
  if (options_->fit == CurvatureFit::Quadric) return frames_[query];
  return jet_frame(distribution_of(moments, query).axes, frames_[query].n);
}

/// None if the normal equations are too badly conditioned for the errors of the moments.
std::optional<Quadric> CurvatureFitter::quadric(const PacketMoments& sums, std::size_t query) const {
  const QueryQuadrics& found = quadrics_;
  if (!(found.determinant[query] >= smallest_determinant(in_frame_, query, sums.sizes(query)))) return std::nullopt;
  return Quadric{found.a[query], found.b[query], found.c[query], found.d[query], found.e[query]};
}

void CurvatureFitter::write(std::size_t row, const DirectFit::Result& result) {
  out_->state[row] = result.state;
  out_->count[row] = static_cast<std::uint32_t>(result.count);
  out_->k1[row] = result.curvature.k1;
  out_->k2[row] = result.curvature.k2;
  set_row(out_->d1, row, result.curvature.d1);
  set_row(out_->d2, row, result.curvature.d2);
}

}  // namespace

CurvatureOptions like_libigl() { return {.filter = true, .open_ball = true, .shape_operator = ShapeOperator::Libigl}; }

Curvatures curvatures(const CurvatureIndex& surface, const BatchQuery& query, const CurvatureOptions& options) {
  if (options.fit == CurvatureFit::Jet && options.shape_operator == ShapeOperator::Libigl) {
    raise(ErrorCode::InvalidOption, "libigl's shape operator requires the quadric, not the jet");
  }
  const SurfaceState& state = CurvatureAccess::state(surface);
  const std::size_t rows = query.vertices.list() ? query.vertices.list()->size() : surface.vertex_count();
  Curvatures result;
  result.k1.resize(rows);
  result.k2.resize(rows);
  result.d1.resize(3 * rows);
  result.d2.resize(3 * rows);
  result.state.resize(rows);
  result.count.resize(rows);
  const Index searched = filtered(state.searched, query.filter, options.threads);
  const MomentSource source{.index = &IndexAccess::view(searched), .filter = options.filter ? &state : nullptr};
  visit_moments(searched, {.vertices = query.vertices, .radius = query.radius}, options.open_ball, source,
                {.threads = options.threads, .progress = options.progress}, [&] {
                  auto fitter = std::make_shared<CurvatureFitter>(state, searched, options, result);
                  return [fitter](const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments) {
                    fitter->fit(packet, sums, moments);
                  };
                });
  return result;
}

double shape_index(double k1, double k2) {
  if (k1 == 0 && k2 == 0) return std::numeric_limits<double>::quiet_NaN();
  return 2 * std::numbers::inv_pi * std::atan2(k1 + k2, k1 - k2);
}

double curvedness(double k1, double k2) {
  const double largest = std::max(std::abs(k1), std::abs(k2));
  if (!(largest > 0) || std::isinf(largest)) return largest;
  const double a = k1 / largest;
  const double b = k2 / largest;
  return largest * std::sqrt((a * a + b * b) / 2);
}

}  // namespace meshhood
