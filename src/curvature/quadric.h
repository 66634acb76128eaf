// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/curvature.h"

#include "curvature/packet_moments.h"
#include "shared/distance.h"
#include "simd/moments.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {

/// The coefficients of z = a x^2 + b x y + c y^2 + d x + e y in the frame of a vertex.
using Quadric = std::array<double, 5>;

/// A quadric has five coefficients; libigl requires one vertex more.
inline constexpr std::size_t kFewestPoints = 6;

/// Orthonormal axes at a vertex; `n` is its normal.
struct TangentFrame {
  Point u;
  Point v;
  Point n;
};

/// Returns a frame whose axes in the tangent plane follow from the normal alone.
[[nodiscard]] TangentFrame frame_of(const Point& normal);

/// Returns libigl's frame: `u` points to a neighbor at `offset`, projected into the plane. If that has no length, it
/// returns the frame above.
[[nodiscard]] TangentFrame frame_towards(const Point& normal, const Point& offset);

// These read and write the row of one query.
[[nodiscard]] TangentFrame frame_of_query(const QueryFrames& frames, std::size_t query);
void set_frame(QueryFrames& frames, std::size_t query, const TangentFrame& frame);
void set_quadric(QueryQuadrics& quadrics, std::size_t query, const Quadric& quadric);

/// Returns the smallest determinant of the normal equations of `query` (see `MomentKernels::fit_quadrics`) for which
/// the errors of the moments, which follow from their sizes (see `PacketMoments::second_size`), hardly change the
/// solution.
[[nodiscard]] double smallest_determinant(const FrameMoments& moments, std::size_t query, double second_size,
                                          double fourth_size);

/// A least-squares fit by the points themselves.
struct PointFit {
  Quadric quadric;
  bool unique;
};

/// Fits `points`, in the frame of the vertex; if the fit is not unique, it returns the one with the smallest
/// coefficients. It uses a QR decomposition and the singular values of its factor, of which those below 5 epsilon of
/// the largest count as 0, as in libigl.
[[nodiscard]] PointFit fit_points(std::span<const Point> points);

// The jet is z = f + d x + e y + a x^2 + b x y + c y^2 over the plane of the principal components of its points. Its
// curvatures are those of the quadric without f: the constant moves the surface, but does not bend it.

/// Returns the axes of the principal components, that of the least variance as `n`, on the side of `normal`.
[[nodiscard]] TangentFrame jet_frame(const Eigen3& axes, const Point& normal);

/// A fit to points relative to the query vertex, and its frame.
struct JetFit {
  TangentFrame frame;
  PointFit fit;
};
[[nodiscard]] JetFit fit_jet(std::span<const Point> points, const Point& normal);

/// Computes the principal curvatures of the quadrics of the first queries (see `MomentKernels`).
void principal_curvatures(const MomentKernels& kernels, const QueryQuadrics& quadrics, const QueryFrames& frames,
                          std::size_t queries, ShapeOperator shape_operator, QueryCurvatures& out);

struct PrincipalCurvature {
  double k1;
  double k2;
  Point d1;
  Point d2;
};

/// Computes the principal curvatures of one quadric.
[[nodiscard]] PrincipalCurvature principal_curvature(const Quadric& quadric, const TangentFrame& frame,
                                                     ShapeOperator shape_operator);

/// Fits one vertex from the points of its neighborhood themselves. It is slow, but right also where the normal
/// equations are not: for few or badly placed vertices. Each thread needs its own.
class DirectFit {
 public:
  /// Borrows its arguments.
  DirectFit(const OrientedIndex& surface, Metric metric, const CurvatureOptions& options)
      : surface_(&surface), metric_(metric), options_(&options) {}

  struct Result {
    CurvatureState state;
    PrincipalCurvature curvature;
    std::size_t count;  // of the vertices within the radius that are fitted
  };

  /// Fits the vertex at `place` in index order. `frame` is that of its normal, for a quadric.
  Result fit(std::uint32_t place, double radius, const TangentFrame& frame);

 private:
  void extend(std::uint32_t place);
  void filter(const Point& normal);
  [[nodiscard]] double set_points(std::uint32_t place);
  [[nodiscard]] double scale_for(double extent) const;

  const OrientedIndex* surface_;
  Metric metric_;
  const CurvatureOptions* options_;
  std::optional<Searcher> searcher_;
  std::vector<std::uint32_t> found_;  // places in index order
  std::vector<std::uint32_t> facing_;
  std::vector<Point> points_;  // relative to the query vertex
};

}  // namespace meshhood::inline v0_1
