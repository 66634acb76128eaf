// SPDX-License-Identifier: MIT
#include "curvature/quadric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "curvature/packet_moments.h"
#include "curvature/symmetric.h"
#include "exact/index_access.h"
#include "exact/neighbors.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

template <std::size_t N>
using SmallVector = std::array<double, N>;
template <std::size_t N>
using SmallMatrix = std::array<SmallVector<N>, N>;

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Decomposes the first N of the columns by Householder's QR method; the last is the right-hand side. Leaves R in the
/// first N rows.
template <std::size_t N>
void triangularize(std::array<std::vector<double>, N + 1>& columns) {
  for (std::size_t k = 0; k < N; ++k) {
    const std::span<double> pivot = std::span(columns[k]).subspan(k);
    const double norm = std::sqrt(product(pivot, pivot));
    if (norm == 0) continue;
    const double diagonal = pivot[0] > 0 ? -norm : norm;
    pivot[0] -= diagonal;
    const double square = product(pivot, pivot);
    for (std::size_t j = k + 1; j <= N; ++j) {
      const std::span<double> column = std::span(columns[j]).subspan(k);
      const double factor = 2 * product(pivot, column) / square;
      for (std::size_t i = 0; i < column.size(); ++i) column[i] -= factor * pivot[i];
    }
    std::fill(pivot.begin(), pivot.end(), 0);
    pivot[0] = diagonal;
  }
}

/// Rotates pairs of columns of `a`, and those of `v` likewise, until all columns of `a` are orthogonal (the one-sided
/// Jacobi method). Then a = a0 v. `a[j]` is column j.
template <std::size_t N>
void orthogonalize(SmallMatrix<N>& a, SmallMatrix<N>& v) {
  constexpr int kMostSweeps = 60;
  constexpr double kPrecision = std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < N; ++i) v[i][i] = 1;
  bool done = false;
  for (int sweep = 0; sweep < kMostSweeps && !done; ++sweep) {
    done = true;
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t q = p + 1; q < N; ++q) {
        const double pp = product(a[p], a[p]);
        const double qq = product(a[q], a[q]);
        const double pq = product(a[p], a[q]);
        if (std::abs(pq) <= kPrecision * std::sqrt(pp * qq)) continue;
        done = false;
        const JacobiRotation rotation(pp, qq, pq);
        for (SmallMatrix<N>* const m : {&a, &v}) {
          for (std::size_t i = 0; i < N; ++i) rotation.turn((*m)[p][i], (*m)[q][i]);
        }
      }
    }
  }
}

/// Fits the rows of the points: N coefficients, of which the first five are those of the quadric, and a right-hand
/// side. Of several solutions, it returns that with the smallest coefficients. It uses a QR decomposition and the
/// singular values of its factor, of which those below N epsilon of the largest count as 0.
template <std::size_t N, class RowOf>
PointFit fit_rows(std::span<const Point> points, RowOf&& row_of) {
  std::array<std::vector<double>, N + 1> columns;
  for (std::vector<double>& column : columns) column.resize(std::max(points.size(), N));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::array<double, N + 1> row = row_of(points[i]);
    for (std::size_t j = 0; j <= N; ++j) columns[j][i] = row[j];
  }
  triangularize<N>(columns);
  SmallMatrix<N> a{};
  SmallMatrix<N> v{};
  for (std::size_t j = 0; j < N; ++j) std::copy_n(columns[j].begin(), N, a[j].begin());
  orthogonalize<N>(a, v);
  SmallVector<N> squares{};
  for (std::size_t j = 0; j < N; ++j) squares[j] = product(a[j], a[j]);
  const double largest = std::sqrt(*std::max_element(squares.begin(), squares.end()));
  const double least = static_cast<double>(N) * std::numeric_limits<double>::epsilon() * largest;
  PointFit result{{}, true};
  for (std::size_t j = 0; j < N; ++j) {
    if (!(std::sqrt(squares[j]) > least)) {
      result.unique = false;
      continue;
    }
    const double factor = product(a[j], std::span(columns[N]).first(N)) / squares[j];
    for (std::size_t i = 0; i < result.quadric.size(); ++i) result.quadric[i] += factor * v[j][i];
  }
  return result;
}

double ratio(double numerator, double denominator) { return denominator > 0 ? numerator / denominator : kInfinity; }

}  // namespace

TangentFrame frame_of(const Point& normal) {
  QueryFrames frames{};
  frames.n.set(0, normal);
  moment_kernels(best_isa()).set_tangents(1, frames);
  return frame_of_query(frames, 0);
}

TangentFrame frame_towards(const Point& normal, const Point& offset) {
  const Point in_plane = offset - dot(offset, normal) * normal;
  const double size = length(in_plane);
  if (!(size > 0)) return frame_of(normal);
  const Point u = {in_plane.x / size, in_plane.y / size, in_plane.z / size};
  return {u, unit(cross(normal, u)), normal};
}

TangentFrame frame_of_query(const QueryFrames& frames, std::size_t query) {
  return {frames.u.at(query), frames.v.at(query), frames.n.at(query)};
}

void set_frame(QueryFrames& frames, std::size_t query, const TangentFrame& frame) {
  frames.u.set(query, frame.u);
  frames.v.set(query, frame.v);
  frames.n.set(query, frame.n);
}

void set_quadric(QueryQuadrics& quadrics, std::size_t query, const Quadric& quadric) {
  quadrics.a[query] = quadric[0];
  quadrics.b[query] = quadric[1];
  quadrics.c[query] = quadric[2];
  quadrics.d[query] = quadric[3];
  quadrics.e[query] = quadric[4];
}

double smallest_determinant(const FrameMoments& s, std::size_t query, double second_size, double fourth_size) {
  const auto at = [query](const QueryRow& row) { return row[query]; };
  // The relative errors of the elements of the normal equations are about epsilon times `amplification`. With this
  // bound, results were measured to be within 1e-9 of the exact ones.
  const double amplification = std::max(ratio(fourth_size, std::min({at(s.u4), at(s.u2v2), at(s.v4)})),
                                        ratio(second_size, std::min(at(s.uu), at(s.vv))));
  return 1e-6 * amplification;
}

PointFit fit_points(std::span<const Point> points) {
  return fit_rows<5>(points, [](const Point& p) { return std::array{p.x * p.x, p.x * p.y, p.y * p.y, p.x, p.y, p.z}; });
}

TangentFrame jet_frame(const Eigen3& axes, const Point& normal) {
  const Point n = dot(axes.vectors[0], normal) < 0 ? -1 * axes.vectors[0] : axes.vectors[0];
  const Point& u = axes.vectors[2];
  return {u, cross(n, u), n};
}

JetFit fit_jet(std::span<const Point> points, const Point& normal) {
  Point sum{0, 0, 0};
  for (const Point& p : points) sum = sum + p;
  const Point center = (1 / static_cast<double>(points.size())) * sum;
  Symmetric3 covariance{0, 0, 0, 0, 0, 0};
  for (const Point& p : points) {
    const Point q = p - center;
    covariance = {covariance.xx + q.x * q.x, covariance.xy + q.x * q.y, covariance.xz + q.x * q.z,
                  covariance.yy + q.y * q.y, covariance.yz + q.y * q.z, covariance.zz + q.z * q.z};
  }
  const TangentFrame frame = jet_frame(eigen(covariance), normal);
  const auto row_of = [&](const Point& p) {
    const double x = dot(p, frame.u);
    const double y = dot(p, frame.v);
    return std::array{x * x, x * y, y * y, x, y, 1.0, dot(p, frame.n)};
  };
  return {frame, fit_rows<6>(points, row_of)};
}

void principal_curvatures(const MomentKernels& kernels, const QueryQuadrics& quadrics, const QueryFrames& frames,
                          std::size_t queries, ShapeOperator shape_operator, QueryCurvatures& out) {
  const bool of_libigl = shape_operator == ShapeOperator::Libigl;
  (of_libigl ? kernels.principal_curvatures_of_libigl : kernels.principal_curvatures)(quadrics, frames, queries, out);
}

PrincipalCurvature principal_curvature(const Quadric& quadric, const TangentFrame& frame,
                                       ShapeOperator shape_operator) {
  QueryQuadrics quadrics{};
  set_quadric(quadrics, 0, quadric);
  QueryFrames frames{};
  set_frame(frames, 0, frame);
  QueryCurvatures out{};
  principal_curvatures(moment_kernels(best_isa()), quadrics, frames, 1, shape_operator, out);
  return {out.k1[0], out.k2[0], out.d1.at(0), out.d2.at(0)};
}

/// Adds the vertices nearest to the query vertex among those that are linked to the set, one by one; of several the one
/// with the lowest id. Walls and ignored vertices are left out.
void DirectFit::extend(std::uint32_t place) {
  const IndexView& index = *surface_->index;
  const Point center = surface_->position(place);
  const auto is_barred = [&](std::uint32_t i) { return index.is_wall_at(i) || index.is_ignored_at(i); };
  while (found_.size() < kFewestPoints) {
    std::optional<std::uint32_t> nearest;
    const auto key = [&](std::uint32_t i) {
      return std::pair(squared_distance(surface_->position(i), center), index.id(i));
    };
    for (const std::uint32_t i : found_) {
      for_each_neighbor(index, index.slot_at(i), [&](std::size_t to) {
        const auto other = static_cast<std::uint32_t>(to);
        if (is_barred(other) || std::find(found_.begin(), found_.end(), other) != found_.end()) return;
        if (!nearest || key(other) < key(*nearest)) nearest = other;
      });
    }
    if (!nearest) return;
    found_.push_back(*nearest);
  }
}

void DirectFit::filter(const Point& normal) {
  facing_.clear();
  for (const std::uint32_t i : found_) {
    if (dot(surface_->normal(i), normal) > 0) facing_.push_back(i);
  }
  if (facing_.size() >= kFewestPoints) found_.swap(facing_);
}

/// Returns the factor by which the coordinates were multiplied.
double DirectFit::set_points(std::uint32_t place) {
  const Point center = surface_->position(place);
  const double scale = scale_for(extent_of(*surface_->index, found_, center));
  points_.clear();
  for (const std::uint32_t i : found_) points_.push_back(scale * (surface_->position(i) - center));
  return scale;
}

DirectFit::Result DirectFit::fit(std::uint32_t place, double radius, const TangentFrame& frame) {
  if (!searcher_) searcher_.emplace(*surface_->searched, metric_);
  find_places(*searcher_, *surface_->index, place, radius, found_);
  const std::size_t inside = found_.size();
  const bool is_extended = inside < kFewestPoints;
  if (is_extended) extend(place);
  if (found_.size() < kFewestPoints) return {CurvatureState::TooFew, {}, inside};
  if (options_->filter) filter(frame.n);
  const std::size_t count = is_extended ? inside : found_.size();
  const double scale = set_points(place);
  const auto result = [&](const PointFit& fit, const TangentFrame& axes) -> Result {
    PrincipalCurvature curvature = principal_curvature(fit.quadric, axes, options_->shape_operator);
    curvature.k1 *= scale;
    curvature.k2 *= scale;
    const CurvatureState state = is_extended ? CurvatureState::Extended : CurvatureState::Fitted;
    return {fit.unique ? state : CurvatureState::RankDeficient, curvature, count};
  };
  if (options_->fit == CurvatureFit::Jet) {
    const JetFit jet = fit_jet(points_, frame.n);
    return result(jet.fit, jet.frame);
  }
  for (Point& p : points_) p = {dot(p, frame.u), dot(p, frame.v), dot(p, frame.n)};
  return result(fit_points(points_), frame);
}

/// Returns the factor of all coordinates, a power of two. If the fit is not unique, the one with the smallest
/// coefficients depends on the unit. libigl fits in the unit of the mesh; where squares and coordinates differ too much
/// there, it drops terms.
double DirectFit::scale_for(double extent) const {
  const double scale = unit_factor(extent, surface_->index->frame);
  if (!(extent > 0)) return scale;
  const bool moderate = scale > 0x1p-20 && scale < 0x1p20;
  return options_->shape_operator == ShapeOperator::Libigl && moderate ? 1 : scale;
}

}  // namespace meshhood::inline v0_1
