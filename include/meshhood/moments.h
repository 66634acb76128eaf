// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/run.h"

/// Computes moments of neighborhoods: sums of powers of coordinates, from which fits of polynomials, principal
/// components and integral invariants follow without another pass over the vertices. docs/curvature.md explains them.
///
///     const std::vector<double> areas = meshhood::vertex_areas(mesh);
///     const auto components = meshhood::principal_components(index, {.radius = 2.5}, {.weights = areas});
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// The largest i + j + k of a moment.
inline constexpr unsigned kLargestMomentDegree = 4;

/// Returns the number of moments with i + j + k <= `degree`: 1, 4, 10, 20, 35.
[[nodiscard]] constexpr std::size_t moment_count(unsigned degree) {
  return std::size_t{degree + 1} * (degree + 2) * (degree + 3) / 6;
}

/// Returns the column of M_ijk: 1, x, y, z, x^2, xy, xz, y^2, yz, z^2, x^3, ... Those of lower degree come first.
[[nodiscard]] constexpr std::size_t moment_column(unsigned i, unsigned j, unsigned k) {
  const unsigned degree = i + j + k;
  return (degree == 0 ? 0 : moment_count(degree - 1)) + std::size_t{j + k} * (j + k + 1) / 2 + k;
}

struct MomentOptions {
  /// The largest i + j + k, at most `kLargestMomentDegree`. `principal_components` ignores it.
  unsigned degree = 2;

  /// #V numbers, finite and >= 0; if empty, each is 1. With `vertex_areas`, sums become integrals over the surface.
  Borrowed<double> weights = {};
};

/// Returns M_ijk = sum of w x^i y^j z^k over the neighborhood of each row, by the metric of the query, where x, y, z
/// are the coordinates relative to the query vertex and w the weights: #rows by `moment_count(degree)`, in the order of
/// `moment_column`.
///
/// Sums are computed about a point near the query vertex, in a unit in which the size of the neighborhood is about 1,
/// and then shifted to the query vertex. Where too many digits would be lost by that, as in a small detail beside large
/// faces, the vertices are summed again about the query vertex. Results are accurate to 1e-13 of the sum of
/// w |p|^(i + j + k), where p is the position relative to the query vertex, on every mesh; a weight 2^-1300 of the
/// largest, or less, may be lost. A power of a coordinate outside the range of doubles becomes 0 or infinite.
///
/// A row depends on index, weights, vertex and radius alone, bit for bit: not on the other rows of the call, earlier
/// calls, threads or the processor. The call takes the time of `curvatures`; a row that is summed again takes that of
/// one more query. Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming row or vertex.
[[nodiscard]] std::vector<double> moments(const Index& index, const BatchQuery& query,
                                          const MomentOptions& options = {}, const Run& run = {});

/// How the vertices of each neighborhood are distributed, one entry for each row of the query. With areas as weights,
/// these are integral invariants: the area, the barycenter and the covariance of the surface in the neighborhood.
struct PrincipalComponents {
  std::vector<double> weight;     ///< #rows: the sum of the weights
  std::vector<double> center;     ///< #rows by 3: the weighted mean of the positions, relative to the query vertex
  std::vector<double> variances;  ///< #rows by 3, ascending: the eigenvalues of the weighted covariance about `center`

  /// #rows by 3 by 3: for each variance the direction of its axis. They are orthogonal unit vectors, with the sign that
  /// makes the component of largest magnitude positive. The first is the normal of the plane that fits best.
  std::vector<double> axes;
};

/// Computes the principal components. All but the weight are NaN where the weights of a neighborhood sum to 0.
/// Arguments, cost and errors are those of `moments`.
[[nodiscard]] PrincipalComponents principal_components(const Index& index, const BatchQuery& query,
                                                       const MomentOptions& options = {}, const Run& run = {});

/// Returns the least variance divided by the sum of the three (Pauly, Gross, Kobbelt 2002): 0 on a plane, at most 1/3,
/// and NaN where all are 0.
[[nodiscard]] double surface_variation(double least, double middle, double largest);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
