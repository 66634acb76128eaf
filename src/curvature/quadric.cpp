// SPDX-License-Identifier: MIT
#include "curvature/quadric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vector.h"

namespace meshhood {
namespace {

constexpr std::size_t kTerms = 5;
using TermMatrix = std::array<std::array<double, kTerms>, kTerms>;

Point unit(const Point& a) { return (1 / length(a)) * a; }

/// The vector, or its negative: the one whose component of largest magnitude is positive.
Point with_sign(const Point& a) {
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  const bool negative = a.x == -largest || (a.x != largest && (a.y == -largest || (a.y != largest && a.z < 0)));
  return negative ? -1 * a : a;
}

}  // namespace

TangentFrame frame_of(const Point& normal) {
  // The coordinate axis that is farthest from the normal.
  const double x = std::abs(normal.x);
  const double y = std::abs(normal.y);
  const double z = std::abs(normal.z);
  const Point axis = x <= y && x <= z ? Point{1, 0, 0} : (y <= z ? Point{0, 1, 0} : Point{0, 0, 1});
  const Point u = unit(axis - dot(axis, normal) * normal);
  return {u, cross(normal, u), normal};
}

TangentFrame frame_towards(const Point& normal, const Point& offset) {
  const Point in_plane = offset - dot(offset, normal) * normal;
  const double size = length(in_plane);
  if (!(size > 0)) return frame_of(normal);
  const Point u = {in_plane.x / size, in_plane.y / size, in_plane.z / size};
  return {u, unit(cross(normal, u)), normal};
}

std::optional<Quadric> fit_moments(const FrameMoments& s, std::size_t query, const MomentSizes& sizes) {
  const auto at = [query](const QueryRow& row) { return row[query]; };
  TermMatrix b{{{at(s.u4)},
                {at(s.u3v), at(s.u2v2)},
                {at(s.u2v2), at(s.uv3), at(s.v4)},
                {at(s.u3), at(s.u2v), at(s.uv2), at(s.uu)},
                {at(s.u2v), at(s.uv2), at(s.v3), at(s.uv), at(s.vv)}}};
  Quadric solution{at(s.uun), at(s.uvn), at(s.vvn), at(s.un), at(s.vn)};
  // Scaled to a diagonal of ones, so that the result does not depend on the unit.
  std::array<double, kTerms> scale{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    if (!(b[i][i] > 0)) return std::nullopt;
    scale[i] = 1 / std::sqrt(b[i][i]);
    for (std::size_t j = 0; j <= i; ++j) b[i][j] *= scale[i] * scale[j];
    solution[i] *= scale[i];
  }
  // The condition of a matrix with unit diagonal is at most 12 / determinant. The relative errors of its elements are
  // about epsilon times `amplification`. Measured, results are then within 1e-9 of the exact ones.
  const double amplification =
      std::max(sizes.fourth / std::min({at(s.u4), at(s.u2v2), at(s.v4)}), sizes.second / std::min(at(s.uu), at(s.vv)));
  const double smallest_determinant = 1e-6 * amplification;  // mutant: ill-conditioned-fit
  double determinant = 1;
  for (std::size_t j = 0; j < kTerms; ++j) {  // Cholesky
    for (std::size_t k = 0; k < j; ++k) b[j][j] -= b[j][k] * b[j][k];
    determinant *= b[j][j];
    if (!(determinant >= smallest_determinant)) return std::nullopt;
    b[j][j] = std::sqrt(b[j][j]);
    for (std::size_t i = j + 1; i < kTerms; ++i) {
      for (std::size_t k = 0; k < j; ++k) b[i][j] -= b[i][k] * b[j][k];
      b[i][j] /= b[j][j];
    }
  }
  for (std::size_t i = 0; i < kTerms; ++i) {
    for (std::size_t k = 0; k < i; ++k) solution[i] -= b[i][k] * solution[k];
    solution[i] /= b[i][i];
  }
  for (std::size_t i = kTerms; i-- > 0;) {
    for (std::size_t k = i + 1; k < kTerms; ++k) solution[i] -= b[k][i] * solution[k];
    solution[i] /= b[i][i];
  }
  for (std::size_t i = 0; i < kTerms; ++i) solution[i] *= scale[i];
  return solution;
}

namespace {

using TermColumn = std::vector<double>;

double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Householder's QR decomposition of the first five of the columns; the last is the right-hand side. Leaves R in the
/// first five rows.
void triangularize(std::array<TermColumn, kTerms + 1>& columns) {
  for (std::size_t k = 0; k < kTerms; ++k) {
    const std::span<double> pivot = std::span(columns[k]).subspan(k);
    const double norm = std::sqrt(product(pivot, pivot));
    if (norm == 0) continue;
    const double diagonal = pivot[0] > 0 ? -norm : norm;
    pivot[0] -= diagonal;
    const double square = product(pivot, pivot);
    for (std::size_t j = k + 1; j <= kTerms; ++j) {
      const std::span<double> column = std::span(columns[j]).subspan(k);
      const double factor = 2 * product(pivot, column) / square;
      for (std::size_t i = 0; i < column.size(); ++i) column[i] -= factor * pivot[i];
    }
    std::fill(pivot.begin(), pivot.end(), 0);
    pivot[0] = diagonal;
  }
}

/// One-sided Jacobi: rotates pairs of columns of `a`, and those of `v` likewise, until all columns of `a` are
/// orthogonal. Then a = a0 v. `a[j]` is column j.
void orthogonalize(TermMatrix& a, TermMatrix& v) {
  constexpr int kMostSweeps = 60;
  constexpr double kPrecision = std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < kTerms; ++i) v[i][i] = 1;
  bool done = false;
  for (int sweep = 0; sweep < kMostSweeps && !done; ++sweep) {
    done = true;
    for (std::size_t p = 0; p < kTerms; ++p) {
      for (std::size_t q = p + 1; q < kTerms; ++q) {
        const double pp = product(a[p], a[p]);
        const double qq = product(a[q], a[q]);
        const double pq = product(a[p], a[q]);
        if (std::abs(pq) <= kPrecision * std::sqrt(pp * qq)) continue;
        done = false;
        const double ratio = (qq - pp) / (2 * pq);
        const double t = (ratio >= 0 ? 1 : -1) / (std::abs(ratio) + std::sqrt(1 + ratio * ratio));
        const double c = 1 / std::sqrt(1 + t * t);
        const double s = c * t;
        for (TermMatrix* const m : {&a, &v}) {
          for (std::size_t i = 0; i < kTerms; ++i) {
            const double x = (*m)[p][i];
            const double y = (*m)[q][i];
            (*m)[p][i] = c * x - s * y;
            (*m)[q][i] = s * x + c * y;
          }
        }
      }
    }
  }
}

}  // namespace

PointFit fit_points(std::span<const Point> points) {
  std::array<TermColumn, kTerms + 1> columns;
  for (TermColumn& column : columns) column.reserve(std::max(points.size(), kTerms));
  for (const Point& p : points) {
    const std::array<double, kTerms + 1> row{p.x * p.x, p.x * p.y, p.y * p.y, p.x, p.y, p.z};
    for (std::size_t j = 0; j <= kTerms; ++j) columns[j].push_back(row[j]);
  }
  for (TermColumn& column : columns) column.resize(std::max(points.size(), kTerms));
  triangularize(columns);
  TermMatrix a{};
  TermMatrix v{};
  for (std::size_t j = 0; j < kTerms; ++j) std::copy_n(columns[j].begin(), kTerms, a[j].begin());
  orthogonalize(a, v);
  std::array<double, kTerms> squares{};
  for (std::size_t j = 0; j < kTerms; ++j) squares[j] = product(a[j], a[j]);
  const double largest = std::sqrt(*std::max_element(squares.begin(), squares.end()));
  const double least = kTerms * std::numeric_limits<double>::epsilon() * largest;
  PointFit result{{}, true};
  for (std::size_t j = 0; j < kTerms; ++j) {
    if (!(std::sqrt(squares[j]) > least)) {  // mutant: deficient-fit-as-unique
      result.unique = false;
      continue;
    }
    const double factor = product(a[j], std::span(columns[kTerms]).first(kTerms)) / squares[j];
    for (std::size_t i = 0; i < kTerms; ++i) result.quadric[i] += factor * v[j][i];
  }
  return result;
}

namespace {

/// Eigenvalues and eigenvectors of the symmetric matrix [[p, o], [o, q]].
struct Eigen2 {
  double low;
  double high;
  std::array<double, 2> low_vector;
  std::array<double, 2> high_vector;
};

Eigen2 eigen(double p, double o, double q) {
  const double middle = (p + q) / 2;
  const double half = (p - q) / 2;
  const double radius = std::sqrt(half * half + o * o);
  double x = 1;
  double y = 0;
  if (radius > 0 && half >= 0) {
    x = std::sqrt((1 + half / radius) / 2);
    y = o / (2 * radius * x);
  } else if (radius > 0) {
    y = std::sqrt((1 - half / radius) / 2);
    x = o / (2 * radius * y);
  }
  return {middle - radius, middle + radius, {-y, x}, {x, y}};
}

}  // namespace

PrincipalCurvature principal_curvature(const Quadric& quadric, const TangentFrame& frame,
                                       ShapeOperator shape_operator) {
  const auto [a, b, c, d, e] = quadric;
  // First fundamental form: E, F, G. Second: L, M, N.
  const double E = 1 + d * d;  // NOLINT(readability-identifier-naming): the names of the field
  const double F = d * e;      // NOLINT(readability-identifier-naming)
  const double G = 1 + e * e;  // NOLINT(readability-identifier-naming)
  const double determinant = 1 + d * d + e * e;
  const double s = 1 / std::sqrt(determinant);
  const double L = 2 * a * s;  // NOLINT(readability-identifier-naming)
  const double M = b * s;      // NOLINT(readability-identifier-naming)
  const double N = 2 * c * s;  // NOLINT(readability-identifier-naming)
  if (shape_operator == ShapeOperator::Libigl) {
    const Eigen2 result =
        eigen((L * G - M * F) / determinant, (M * E - L * F) / determinant, (N * E - M * F) / determinant);
    const auto direction = [&](const std::array<double, 2>& v) {
      return with_sign(unit(v[0] * frame.u + v[1] * frame.v));
    };
    PrincipalCurvature k{-result.low, -result.high, direction(result.low_vector), direction(result.high_vector)};
    if (k.k1 == 0) k.d1 = {0, 0, 0};
    if (k.k2 == 0) k.d2 = {0, 0, 0};
    return k;
  }
  // With I = C C^T, C = [[r, 0], [F / r, t]], the shape operator is similar to the symmetric C^-1 II C^-T, whose
  // eigenvectors q belong to the directions C^-T q.
  const double r = std::sqrt(E);
  const double t = std::sqrt(determinant) / r;  // EG - F^2 = determinant
  const double f = F / r;
  const double p = L / E;
  const double o = (M - f * L / r) / (r * t);  // mutant: operator-without-tilt
  const double q = (N - 2 * f * M / r + f * f * L / E) / (t * t);
  const Eigen2 result = eigen(p, o, q);
  const auto direction = [&](const std::array<double, 2>& v) {
    const double y = v[1] / t;
    const double x = (v[0] - f * y) / r;
    return with_sign(unit(x * frame.u + y * frame.v + (d * x + e * y) * frame.n));
  };
  return {-result.low, -result.high, direction(result.low_vector), direction(result.high_vector)};
}

}  // namespace meshhood
