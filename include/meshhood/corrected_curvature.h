// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/curvature.h"
#include "meshhood/export.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"

/// Curvature from measures instead of a fit. See docs/curvature.md.
namespace meshhood {
inline namespace v0_1 MESHHOOD_API {

/// One value for each row of the query; #radii by #rows if it has scales, which are then meant by #rows. All but the
/// area and the measures are NaN where the area is 0; k1, k2, d1 and d2 also where the vertex has no normal.
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

/// The interpolated corrected curvature measures (J.-O. Lachaud, P. Romon, B. Thibert, D. Coeurjolly, "Interpolated
/// corrected curvature measures for polygonal surfaces", Computer Graphics Forum 39, 2020; CGAL 6 has them as
/// `interpolated_corrected_curvatures`): integrals over the faces of area, mean curvature, Gaussian curvature and the
/// anisotropic measure, with the vertex normals interpolated over each face, divided by the area.
///
/// A vertex of a face holds a third of its measures, so that those of a neighborhood are sums over its vertices. CGAL
/// instead weighs each face by the share of it inside the ball. A polygon of more than three corners is divided into
/// triangles around its barycenter, which has the mean normal of the corners. A face with a corner that has no normal
/// counts 0.
///
/// Nothing is fitted, and neighborhoods are neither filtered nor extended. The measures are robust on noisy meshes, and
/// defined for a radius of 0.
///
/// A face at a wall still gives shares to its other corners.
/// query  as of `aggregate`.
/// Each row depends on surface, vertex and radius alone, bit for bit, as that of `aggregate`. Takes the time of
/// `aggregate` with twelve channels.
/// Throws Error{InvalidMesh, TooLarge, VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}.
[[nodiscard]] CorrectedCurvatures corrected_curvatures(const Surface& surface, const BatchQuery& query,
                                                       const Run& run = {});

}  // namespace v0_1
}  // namespace meshhood
