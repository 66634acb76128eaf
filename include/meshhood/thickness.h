// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/run.h"
#include "meshhood/surface.h"

/// The thickness of a wall, whose faces are oriented counterclockwise, seen from outside.
///
///     const meshhood::Surface surface(index, faces);
///     const std::vector<double> across = meshhood::thickness(surface);
namespace meshhood {
inline namespace v0_1 MESHHOOD_API {

enum class ThicknessMethod : std::uint8_t {
  /// The way from the vertex against its normal (see curvature.h) to the surface.
  Ray,

  /// The diameter of the largest ball that touches the surface at the vertex from inside, and has no point of an
  /// opposite face in it. A face is opposite if its normal turns from that of the vertex by more than 53 degrees, the
  /// cosine of which is 0.6: on a curved wall, those beside the vertex lie inside every ball that touches there. By
  /// a shrinking ball (J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation using nearest neighbors and the
  /// normal field", The Visual Computer 28, 2012), but with the nearest points of faces.
  Sphere,
};

/// The thickness at each of `vertices`, in the unit of the positions. Faces with the vertex as a corner do not count,
/// nor does what lies at the same place. Infinite where nothing else is met, for the sphere within the extent of the
/// mesh; NaN for a vertex without a normal.
///
/// Masks have no effect. A row depends on the surface, its vertex and the method alone, bit for bit. O(log #V) a row on
/// most surfaces; for a ball, as many searches for a closest point as it has steps, mostly 2 to 6. 16 bytes a row.
/// Throws Error{VertexOutOfRange, Cancelled}, naming the row, Error{InvalidOption} after a refit in place, and
/// Error{InvalidMesh} if no face has three corners.
[[nodiscard]] std::vector<double> thickness(const Surface& surface, const BatchVertices& vertices = {},
                                            ThicknessMethod method = ThicknessMethod::Ray, const Run& run = {});

}  // namespace v0_1
}  // namespace meshhood
