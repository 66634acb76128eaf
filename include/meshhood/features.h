// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/curvature.h"
#include "meshhood/export.h"
#include "meshhood/run.h"

/// Describes a surface around each vertex at many scales: by feature vectors, and by how long a feature persists.
/// docs/curvature.md explains them.
///
///     const std::vector<double> radii = meshhood::geometric_radii(1.0, 16.0, 9);
///     const auto creases = meshhood::features(surface, {.radius = meshhood::BatchRadius::scales(radii)});
///     const meshhood::Persistence lasting = meshhood::persistence(creases, radii, 0.5);
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A feature is a number without unit that describes the neighborhood of one radius r. It does not change if mesh and
/// radius are scaled together, so that scales can be compared.
enum class Feature : std::uint8_t {
  Crease,      ///< r times the principal curvature of larger magnitude: > 0 on a ridge, < 0 in a valley
  Mean,        ///< r H
  Gaussian,    ///< r^2 K
  K1,          ///< r k1
  K2,          ///< r k2
  Curvedness,  ///< r times Koenderink's curvedness
  ShapeIndex,  ///< Koenderink's shape index
  Area,        ///< area of the patch (see patch.h) / (pi r^2): 1 on a plane
  Volume,      ///< volume behind the patch / that of the ball: 1/2 on a plane; NaN at a border
  Gap,         ///< distance of the gap / r; NaN where there is none
  Height,      ///< -4 / r times the height of the barycenter over the tangent plane: an integral estimate of r H
  Variation,   ///< surface variation of the neighborhood, weighted by area
};

struct FeatureOptions {
  /// The features to compute, at least one. Each has a column of the result.
  std::vector<Feature> kinds = {Feature::Crease};

  /// The area of each vertex, #V, for Height and Variation. If empty, the areas of the surface are used;
  /// Error{InvalidOption} if it has no faces.
  Borrowed<double> areas = {};

  /// As in `CurvatureOptions`.
  bool filter = true;
};

/// Returns the features of the neighborhood of each row at each of the scales of the query, #radii by #rows by #kinds.
/// There is one radius if the query has one for all rows, or one for each. A feature is NaN where a fit has no result
/// (see `CurvatureState`), where a row has no normal, or where the neighborhood has no area. By rings, a radius of r
/// edges counts as r times the mean length of an edge.
///
/// Each radius has a neighborhood of its own, which is searched once for all kinds; of an index with ignored vertices,
/// Area, Volume and Gap beside other kinds have a search of their own. The call takes the time of `curvatures`,
/// `principal_components`, `invariants` and `gaps` for each radius, as the kinds require. A row depends on surface,
/// areas, vertex and radius alone, bit for bit: not on the other rows of the call, earlier calls, threads or the
/// processor. Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, and InvalidMesh if the surface
/// has neither faces nor normals. A radius must be > 0 and finite. Area, Volume and Gap throw InvalidOption by another
/// metric than `Straight` and of a surface without faces.
[[nodiscard]] std::vector<double> features(const Surface& surface, const BatchQuery& query,
                                           const FeatureOptions& options = {}, const Run& run = {});

/// Returns `count` radii from `smallest` to `largest` with a constant ratio; a single one is `largest`. Throws
/// Error{InvalidRadius} unless 0 < smallest <= largest < infinity, and Error{InvalidOption} unless `count` is in [1,
/// 1000].
[[nodiscard]] std::vector<double> geometric_radii(double smallest, double largest, std::size_t count);

/// Over how many scales a feature lasts, one entry for each row.
struct Persistence {
  /// #rows: the length of the longest run of consecutive radii at which the feature is at least as strong as the
  /// threshold and keeps its sign; times -1 if the feature is negative there. If several runs have this length, the one
  /// with the smallest radii counts.
  std::vector<std::int32_t> scales;
  std::vector<double> strength;  ///< #rows: the feature of largest magnitude in this run; 0 if there is none
  std::vector<double> radius;    ///< #rows: the radius at which it has this strength; 0 if there is none
};

/// Finds over how many consecutive radii a feature lasts, for each of #rows = #values / #radii rows.
///
/// values     #radii by #rows, one kind of feature. A NaN ends a run. Error{InvalidOption} if #rows is not whole.
/// radii      >= 0, strictly ascending, or Error{InvalidRadius}; at least one, or Error{InvalidOption}.
/// threshold  > 0, or Error{InvalidOption}.
/// Takes O(#values), on one thread.
[[nodiscard]] Persistence persistence(std::span<const double> values, std::span<const double> radii, double threshold);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
