// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "meshhood/batch.h"

#include "curvature/quadric.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {

/// The curvature of one vertex, from the points of its neighborhood themselves. Slow, but right also where the normal
/// equations are not: for few or badly placed vertices. One object a thread.
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

  /// The vertex at `place` in index order. `frame` is that of its normal, for a quadric.
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
