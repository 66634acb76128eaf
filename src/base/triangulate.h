// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// The triangles of a polygon, by the numbers of its corners, in its orientation.
using Triangulation = std::vector<std::array<std::uint32_t, 3>>;

/// Refills `out` with the #corners - 2 triangles of a polygon, or with none if it has fewer than three corners.
///
/// A convex one is the fan of its corners 0, i and i + 1. Any other is cut at ears (Meisters, "Polygons have ears",
/// 1975), so that its triangles cover what it covers. Both are seen along its vector area, so it need not be flat. One
/// that crosses itself gives some triangles. O(#corners * (1 + #reflex corners)), and more only where ears are rare.
void triangulate(std::span<const Point> corners, Triangulation& out);

}  // namespace meshhood::inline v0_1
