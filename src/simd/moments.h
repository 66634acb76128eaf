// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shared/distance.h"
#include "simd/joint.h"
#include "simd/kernels.h"

/// The inner loops of curvature sum powers of coordinates over the neighborhoods of a packet. As in `Kernels`, each
/// function gives the same result on every processor, bit for bit.
namespace meshhood::inline v0_1 {

/// The moments of a set of vertices about a center are M_ijk = sum of weight x^i y^j z^k for i + j + k <= 4, where x,
/// y, z are the coordinates relative to the center. They are ordered by i; then by j + k; then by k. So the moments
/// with j + k <= 4 - i of each i are a prefix of those of i - 1.
inline constexpr std::size_t kMomentCount = 35;

/// Returns the place of M_ijk.
[[nodiscard]] constexpr std::size_t moment_index(std::size_t i, std::size_t j, std::size_t k) {
  constexpr std::array<std::size_t, 5> kFirst{0, 15, 25, 31, 34};
  return kFirst[i] + (j + k) * (j + k + 1) / 2 + k;
}

/// A number for each query of a packet.
using QueryRow = PerLane<double>;
static_assert(kLeafCapacity == kPacketCapacity);

using QueryVectors = PointPerLane<double>;

/// The moments of the neighborhoods of a packet, by moment, then by query.
struct QueryMoments {
  std::array<QueryRow, kMomentCount> at;
};

/// The moments of one set, padded to whole vectors.
struct alignas(64) PaddedMoments {
  static constexpr std::size_t kPadded = 40;
  std::array<double, kPadded> at;
};

inline void add(PaddedMoments& sum, const PaddedMoments& term) {
  for (std::size_t m = 0; m < PaddedMoments::kPadded; ++m) sum.at[m] += term.at[m];
}

/// The moments of each query.
using MomentsByQuery = std::array<PaddedMoments, kPacketCapacity>;

/// The vertices of a leaf relative to the center of a packet, in a unit in which they are about 1.
struct MomentPoints : PointPerLane<double> {
  PerLane<double> weight;

  void set(std::size_t i, const Point& p, double its_weight) {
    PointPerLane::set(i, p);
    weight[i] = its_weight;
  }
};

/// The moments of each neighborhood about its query vertex, in the frame (u, v, n) of its tangent plane. The fit of a
/// quadratic height over that plane needs no others, and `u`, `v`, `n` and `one` only if it has a constant term.
struct FrameMoments {
  QueryRow uu, uv, vv;
  QueryRow u4, u3v, u2v2, uv3, v4;
  QueryRow u3, u2v, uv2, v3;
  QueryRow uun, uvn, vvn;
  QueryRow un, vn;
  QueryRow u, v, n, one;
};

/// Orthonormal axes at each query vertex: `n` is the normal of the plane that a surface is fitted over.
struct QueryFrames {
  QueryVectors u, v, n;
};

struct NormalColumns {
  const double* x;
  const double* y;
  const double* z;
};

/// Tests which vertices face the queries of a packet: those whose normal makes an angle of less than 90 degrees with
/// that of the query. The product of the two, in double, each operation rounded, is > 0.
struct FacingTest {
  QueryVectors normals;  // of the queries: unit vectors, or NaN
  // A vertex faces all queries if, in float, the product of normal and axis is > `all`, and none if it is <= `-all`.
  Point axis{0, 0, 0};
  float all = 0;
};

/// The fits z = a x^2 + b x y + c y^2 + d x + e y of the queries of a packet.
struct QueryQuadrics {
  QueryRow a, b, c, d, e;
  QueryRow determinant;  // of the normal equations, see `MomentKernels::fit_quadrics`
};

/// Principal curvatures, k1 >= k2, positive where the surface is convex, seen from `n`, and their directions: vectors
/// of length 1, or 0, whose component of largest magnitude is positive.
struct QueryCurvatures {
  QueryRow k1, k2;
  QueryVectors d1, d2;
};

struct MomentKernels {
  /// Sets the coordinates of points to those of the first `size` vertices of `xyz`, #V by 3, less the center, times the
  /// scale; and, up to the next multiple of eight, to 0. Reads that many vertices; those beyond `size` may have any
  /// values.
  void (*set_points_float)(const float* xyz, std::size_t size, const Point& center, double scale, MomentPoints& points);
  void (*set_points_double)(const double* xyz, std::size_t size, const Point& center, double scale,
                            MomentPoints& points);

  /// Writes the powers of each of the chosen points, times its weight, one after the other. May write over the elements
  /// beyond these: `out` has room for 32.
  void (*powers)(const MomentPoints& points, LaneMask chosen, PaddedMoments* out);

  /// Writes the sum of the powers of `size` points, at least one, times their weights. Reads the points up to the next
  /// multiple of eight: their coordinates must be finite, and their weights do not matter.
  void (*sum)(const MomentPoints& points, std::size_t size, PaddedMoments& out);

  /// Adds `terms[i]` to the sums of the queries of `words[i]`, term after term. At most 64 terms. Reads the 15 words
  /// after the last one, but does not use them.
  void (*add_terms)(const PaddedMoments* terms, std::span<const QueryWord> words, MomentsByQuery& sums);

  /// Removes from `words[i]` the queries that vertex `i` does not face. Normals are unit vectors; one of NaN faces
  /// none. At most `kLeafCapacity` words; the columns begin with the first vertex.
  void (*keep_facing)(const NormalColumns& normals, const FacingTest& test, std::span<QueryWord> words);

  /// Moves the centers by `-by`: the coordinates grow by `by`. The Taylor shifts along the axes take 105 multiply-adds.
  void (*shift)(QueryMoments& moments, const QueryVectors& by);

  /// Sets `u` and `v` of the frames of the first queries by their normals, which are unit vectors or NaN: `u` is the
  /// projection of the coordinate axis that is farthest from the normal. Also reads and writes rows of others.
  void (*set_tangents)(std::size_t queries, QueryFrames& frames);

  /// Contracts the moments with the axes of the frames.
  void (*rotate)(const QueryMoments& moments, const QueryFrames& frames, FrameMoments& out);

  /// Solves the normal equations of the least-squares fits. `determinant` is the least of their leading determinants,
  /// scaled to a diagonal of ones: the condition of such a matrix is at most 12 / determinant. It is not > 0 if there
  /// is no unique solution.
  void (*fit_quadrics)(const FrameMoments& moments, QueryQuadrics& out);

  /// Does the same with a constant term, which `out` leaves out.
  void (*fit_jets)(const FrameMoments& moments, QueryQuadrics& out);

  /// Computes the principal curvatures of the quadrics of the first queries, by `ShapeOperator::Exact`. Also reads and
  /// writes rows of others, which may have any values.
  void (*principal_curvatures)(const QueryQuadrics& quadrics, const QueryFrames& frames, std::size_t queries,
                               QueryCurvatures& out);

  /// Does the same by `ShapeOperator::Libigl`. The direction of a curvature of 0 is 0.
  void (*principal_curvatures_of_libigl)(const QueryQuadrics& quadrics, const QueryFrames& frames, std::size_t queries,
                                         QueryCurvatures& out);
};

/// Returns the kernels for `isa`, which the processor must have.
[[nodiscard]] const MomentKernels& moment_kernels(Isa isa);

}  // namespace meshhood::inline v0_1
