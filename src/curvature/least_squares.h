// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "curvature/symmetric.h"

/// Linear least squares with a few unknowns, by the rows themselves.
namespace meshhood::inline v0_1 {

template <std::size_t N>
using SmallVector = std::array<double, N>;
template <std::size_t N>
using SmallMatrix = std::array<SmallVector<N>, N>;

[[nodiscard]] inline double product(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Householder's QR decomposition of the first N of the columns; the last is the right-hand side. Leaves R in the first
/// N rows.
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

/// One-sided Jacobi: rotates pairs of columns of `a`, and those of `v` likewise, until all columns of `a` are
/// orthogonal. Then a = a0 v. `a[j]` is column j.
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

/// A solution, and whether it is the only one.
template <std::size_t N>
struct RowFit {
  SmallVector<N> solution;
  bool unique;
};

/// Fits rows of N coefficients and a right-hand side: `columns`, all of one length. The solution with the smallest
/// coefficients if there are several. By a QR decomposition and the singular values of its factor, of which those below
/// N epsilon of the largest count as 0.
template <std::size_t N>
[[nodiscard]] RowFit<N> fit_rows(std::array<std::vector<double>, N + 1>& columns) {
  for (std::vector<double>& column : columns) column.resize(std::max(column.size(), N));
  triangularize<N>(columns);
  SmallMatrix<N> a{};
  SmallMatrix<N> v{};
  for (std::size_t j = 0; j < N; ++j) std::copy_n(columns[j].begin(), N, a[j].begin());
  orthogonalize<N>(a, v);
  SmallVector<N> squares{};
  for (std::size_t j = 0; j < N; ++j) squares[j] = product(a[j], a[j]);
  const double largest = std::sqrt(*std::max_element(squares.begin(), squares.end()));
  const double least = static_cast<double>(N) * std::numeric_limits<double>::epsilon() * largest;
  RowFit<N> result{{}, true};
  for (std::size_t j = 0; j < N; ++j) {
    if (!(std::sqrt(squares[j]) > least)) {
      result.unique = false;
      continue;
    }
    const double factor = product(a[j], std::span(columns[N]).first(N)) / squares[j];
    for (std::size_t i = 0; i < N; ++i) result.solution[i] += factor * v[j][i];
  }
  return result;
}

}  // namespace meshhood::inline v0_1
