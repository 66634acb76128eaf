// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "meshhood/export.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A mesh for which float is coarse: the mean edge is shorter than 64 steps from one float to the next at the largest
/// coordinate, so that rounding to float moves vertices by up to a hundredth of it, or onto each other.
struct CoarseFloat {
  double mean_edge;
  double step;
  double largest;  ///< coordinate, in magnitude

  /// "the mean edge is 0.1, but floats are 0.5 apart at 5.41e+06"
  [[nodiscard]] std::string text() const;
};

/// What helps where a file declares float.
inline constexpr std::string_view kWriteOtherwise =
    "move the mesh to the origin before it is written as float, or write double";

/// Whether float is coarse for a mesh with edges of this mean length, and this largest coordinate. Not if the mean is
/// 0: then there is no length to compare with.
[[nodiscard]] std::optional<CoarseFloat> coarse_float(double mean_edge, double largest);

/// The same of a valid mesh, whatever the type of its positions. An edge counts once for each of its faces. O(#V), and
/// of the faces as many as show that float is not coarse: a few in most meshes.
[[nodiscard]] std::optional<CoarseFloat> coarse_float(const MeshView& mesh);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
