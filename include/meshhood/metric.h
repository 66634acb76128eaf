// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// How the distance of a vertex is measured, for radii and smoothing kernels. `Searcher` defines the metrics.
enum class Metric : std::uint8_t {
  Straight,  ///< what is connected within the ball, and straight lines
  Path,      ///< what is within the radius along the edges, and the lengths of shortest paths
  Rings,     ///< what at most `radius` edges, rounded down, separate from a vertex, and numbers of edges
  Space,     ///< what is within the radius in space, connected or not, and straight lines
};

/// The type of a radius: any integer or floating-point type, but not bool.
template <class Number>
concept RadiusNumber = std::is_arithmetic_v<Number> && !std::same_as<Number, bool>;

/// The radius of one query. A call that takes it refuses NaN and negative ones: Error{InvalidRadius}.
class Radius {
 public:
  template <RadiusNumber Number>
  Radius(Number radius) : value_(static_cast<double>(radius)) {}
  operator double() const { return value_; }

 private:
  double value_;
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
