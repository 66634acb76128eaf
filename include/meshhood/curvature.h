// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"
#include "meshhood/surface.h"

/// Computes curvature at a scale: the shape of the surface in the neighborhood of a vertex with radius r.
/// docs/curvature.md explains the measures and how to choose among them.
///
/// The normal of a vertex is the sum of the vector areas of its faces, normalized. The vector area of a triangle is
/// half the cross product of two edges; that of a polygon is Newell's sum.
///
///     const meshhood::Surface surface(index, faces);
///     const auto [k1, k2, d1, d2, state, count] = meshhood::curvatures(surface, {.radius = 2.5});
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// How principal curvatures follow from the fitted quadric z = a x^2 + b x y + c y^2 + d x + e y.
enum class ShapeOperator : std::uint8_t {
  /// The shape operator of the quadric at the query vertex, from its first and second fundamental forms. The directions
  /// are tangent to the quadric. The result does not depend on the numbering of the vertices.
  Exact,

  /// The matrix that libigl uses, which differs where d or e is not 0: both of its off-diagonal elements are ME - LF;
  /// those of the shape operator are ME - LF and MG - NF. The error is of second order in the slope of the fit against
  /// the vertex normal, and depends on the numbering. The directions lie in the plane of the vertex normal.
  Libigl,
};

/// The surface that is fitted to a neighborhood.
enum class CurvatureFit : std::uint8_t {
  /// z = a x^2 + b x y + c y^2 + d x + e y over the tangent plane of the vertex normal, through the query vertex
  /// (Panozzo et al.).
  Quadric,

  /// The polynomial of degree 2, with a constant term, over the plane of the principal components of the neighborhood
  /// (F. Cazals, M. Pouget, "Estimating differential quantities using polynomial fitting of osculating jets", Computer
  /// Aided Geometric Design 22, 2005): CGAL's `Monge_via_jet_fitting` of degrees 2 and 2, if there is no filter. The
  /// vertex normal decides only the sign.
  Jet,
};

/// How the values of a row of `Curvatures` were found.
enum class CurvatureState : std::uint8_t {
  Fitted,         ///< the least-squares fit, which is unique
  RankDeficient,  ///< the points determine no unique quadric: the one with the smallest coefficients
  TooFew,         ///< fewer than six are in the ball or joined to it, ignored ones not passed: all values are 0
  NoNormal,       ///< the query vertex has no normal, as it belongs to no face with an area: all values are 0
  Extended,       ///< fewer than six vertices are in the ball: the fit to these and to the nearest joined ones
};

struct CurvatureOptions {
  /// Fit only the vertices whose normal makes an angle of less than 90 degrees with that of the query vertex, if there
  /// are at least six. This keeps the other side of a fold or a thin wall out of the fit.
  bool filter = true;

  /// If true, a vertex at exactly the radius is outside, as in libigl. Otherwise it is inside.
  bool open_ball = false;

  /// The shape operator of a quadric. With a jet, all but `Exact` is Error{InvalidOption}.
  ShapeOperator shape_operator = ShapeOperator::Exact;

  CurvatureFit fit = CurvatureFit::Quadric;
};

/// Returns the options with which `curvatures` agrees with `igl::principal_curvature(V, F, ..., radius, useKring =
/// false)` of libigl, at the radius of `libigl_radius`.
[[nodiscard]] CurvatureOptions like_libigl();

/// Returns the radius of libigl's neighborhoods: `edges` times the mean length of the sides of all faces. A side of two
/// faces counts twice, so that this differs from `mean_edge_length` where the mesh has a border. It is 0 if there are
/// no sides. Throws Error{InvalidMesh, TooLarge}, and Error{InvalidRadius} unless `edges` is >= 0 or infinite.
[[nodiscard]] double libigl_radius(const MeshView& mesh, double edges);

/// Principal curvatures, one entry for each row of the query.
struct Curvatures {
  /// #rows, in 1 / unit of the positions, k1 >= k2. They are positive where the surface is convex, seen from the side
  /// to which the normals point: 1 / R on a sphere with normals outward.
  std::vector<double> k1;
  std::vector<double> k2;

  /// #rows by 3: the directions of k1 and k2. They are orthogonal unit vectors, with the sign that makes the component
  /// of largest magnitude positive.
  std::vector<double> d1;
  std::vector<double> d2;

  std::vector<CurvatureState> state;  ///< #rows

  /// #rows: the vertices within the radius to which the surface is fitted, without those that the filter leaves out. If
  /// these are fewer than six, others beyond the radius are fitted, too.
  std::vector<std::uint32_t> count;
};

/// Memory of the caller for the arrays of `Curvatures`, of the sizes given there.
struct CurvatureMemory {
  std::span<double> k1;
  std::span<double> k2;
  std::span<double> d1;
  std::span<double> d2;
  std::span<CurvatureState> state;
  std::span<std::uint32_t> count;
};

/// Fits a quadric through the query vertex to its neighborhood by least squares (Panozzo et al., "Efficient
/// Multi-scale Curvature and Crease Estimation", GraVisMa 2010), or a jet (see `CurvatureFit`), and returns its
/// principal curvatures at that vertex.
/// A neighborhood of fewer than six vertices is extended by the nearest vertex that an edge joins to it, until it has
/// six. It is not extended by ignored vertices, nor across them.
/// query    as for `counts`: one radius for all rows, or one for each, or scales.
/// A row depends on surface, vertex and radius alone, bit for bit: not on the other rows of the call, earlier calls,
/// threads or the processor. Takes O(size of the neighborhoods) in the worst case; the common part of the neighborhoods
/// of a leaf is summed once. Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row,
/// and Error{InvalidMesh} if the surface has neither faces nor normals of its own.
[[nodiscard]] Curvatures curvatures(const Surface& surface, const BatchQuery& query,
                                    const CurvatureOptions& options = {}, const Run& run = {});

/// Writes the same into memory of the caller, which need not be initialized: all of it, unless the call throws. Throws
/// as the overload above, and Error{InvalidOption} if an array does not have the requested size.
void curvatures(const Surface& surface, const BatchQuery& query, const CurvatureMemory& out,
                const CurvatureOptions& options = {}, const Run& run = {});

/// Returns Koenderink's shape index, 2 / pi atan((k1 + k2) / (k1 - k2)): 1 on a dome, 0.5 on a ridge, 0 on a saddle,
/// -0.5 in a valley, -1 in a bowl. It is NaN where both are 0. Expects k1 >= k2, which is not checked.
[[nodiscard]] double shape_index(double k1, double k2);

/// Returns Koenderink's curvedness, the square root of (k1^2 + k2^2) / 2.
[[nodiscard]] double curvedness(double k1, double k2);

/// Curvatures from measures instead of a fit.
///
/// There is a value for each row of the query; if that has scales, #rows stands for #radii by #rows. All but the area
/// and the measures are NaN where the area is 0; k1, k2, d1 and d2 also where the vertex has no normal.
struct CorrectedCurvatures {
  std::vector<double> area;      ///< #rows: of the neighborhood, corrected by the normals
  std::vector<double> mean;      ///< #rows: H, in 1 / unit of the positions, positive where convex, as in `Curvatures`
  std::vector<double> gaussian;  ///< #rows: K
  std::vector<double> k1;        ///< #rows: the principal curvatures, k1 >= k2. Their mean is not exactly `mean`
  std::vector<double> k2;
  std::vector<double> d1;  ///< #rows by 3: their directions in the plane of the vertex normal, as in `Curvatures`
  std::vector<double> d2;

  /// #rows by 12, the sums from which the others follow: the area; twice the integral of H; the integral of K; and the
  /// anisotropic measure, a matrix of 3 by 3, row by row. CGAL's mu0, mu1, mu2 and muXY.
  std::vector<double> measures;
  static constexpr std::size_t kMeasures = 12;
};

/// Computes the interpolated corrected curvature measures (J.-O. Lachaud, P. Romon, B. Thibert, D. Coeurjolly,
/// "Interpolated corrected curvature measures for polygonal surfaces", Computer Graphics Forum 39, 2020; CGAL 6 has
/// them as `interpolated_corrected_curvatures`): integrals over the faces of area, mean curvature, Gaussian curvature
/// and the anisotropic measure, with the vertex normals interpolated over each face, divided by the area.
///
/// A vertex of a face holds a third of its measures, so that those of a neighborhood are sums over its vertices. CGAL
/// instead weighs each face by the share of it inside the ball. A polygon of more than three corners is divided into
/// triangles around its barycenter, with the mean normal of the corners. A face counts 0 if a corner has no normal.
///
/// Nothing is fitted, and neighborhoods are neither filtered nor extended. The measures are robust on noisy meshes, and
/// defined for a radius of 0. At a wall, a face still gives shares to its other corners.
///
/// query  as of `aggregate`.
/// Each row depends on surface, vertex and radius alone, bit for bit, as that of `aggregate`. The call takes the time
/// of `aggregate` with twelve channels. Throws Error{InvalidMesh, TooLarge, VertexOutOfRange, InvalidRadius,
/// InvalidOption, Cancelled}.
[[nodiscard]] CorrectedCurvatures corrected_curvatures(const Surface& surface, const BatchQuery& query,
                                                       const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
