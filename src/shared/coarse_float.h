// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "meshhood/export.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Describes a mesh for which float is coarse: the mean edge is shorter than 64 steps from one float to the next at the
/// largest coordinate, so that rounding to float moves vertices by up to a hundredth of it, or onto each other.
struct CoarseFloat {
  double mean_edge;
  double step;
  double largest;  ///< coordinate, in magnitude

  /// Returns, for example, "the mean edge is 0.1, but floats are 0.5 apart at 5.41e+06".
  [[nodiscard]] std::string text() const;
};

/// This advice helps where a file declares float.
inline constexpr std::string_view kWriteOtherwise =
    "move the mesh to the origin before it is written as float, or write double";

/// Returns a value if float is coarse for a mesh with this mean edge length and largest coordinate. A mean of 0 is no
/// length to compare with, and gives none.
[[nodiscard]] std::optional<CoarseFloat> coarse_float(double mean_edge, double largest);

/// Does the same for a valid mesh, whatever the type of its positions. An edge counts once for each of its faces. Takes
/// O(#V), and reads only as many faces as show that float is not coarse: a few in most meshes.
[[nodiscard]] std::optional<CoarseFloat> coarse_float(const MeshView& mesh);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
