// SPDX-License-Identifier: MIT
#include "shared/coarse_float.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/adjacency.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr double kLeastSteps = 64;

// Returns the difference between a float of this magnitude and the next.
double step_at(double largest) {
  using Limits = std::numeric_limits<float>;
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, std::max(exponent, Limits::min_exponent) - Limits::digits);
}

template <class Real>
double largest_coordinate(const StridedPositions<Real>& xyz) {
  std::array<Real, 3> largest = {};
  for (std::size_t v = 0; v < xyz.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) largest[axis] = std::max(largest[axis], std::abs(xyz(v, axis)));
  }
  return static_cast<double>(*std::max_element(largest.begin(), largest.end()));
}

// Returns the mean length of the sides of the faces; nothing if there are none, or if it is at least `least`.
template <class Real>
std::optional<double> mean_side_below(double least, const StridedPositions<Real>& xyz, const FacesView& faces) {
  constexpr std::size_t kFaces = 1024;
  const double enough = least * static_cast<double>(faces.corner_count());
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < faces.size() && sum < enough; begin += kFaces) {
    for_each_side(faces, begin, std::min(begin + kFaces, faces.size()), [&](VertexId v, VertexId w) {
      sum += std::sqrt(squared_distance(point(xyz, v), point(xyz, w)));
      ++count;
    });
  }
  if (count == 0 || sum >= least * static_cast<double>(count)) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::string three_digits(double value) {
  std::array<char, 32> buffer{};
  constexpr auto kForm = std::chars_format::general;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, kForm, 3).ptr};
}

}  // namespace

std::string CoarseFloat::text() const {
  return "the mean edge is " + three_digits(mean_edge) + ", but floats are " + three_digits(step) + " apart at " +
         three_digits(largest);
}

std::optional<CoarseFloat> coarse_float(double mean_edge, double largest) {
  const double step = step_at(largest);
  if (mean_edge >= kLeastSteps * step || mean_edge == 0) return std::nullopt;
  return CoarseFloat{mean_edge, step, largest};
}

std::optional<CoarseFloat> coarse_float(const MeshView& mesh) {
  return mesh.positions.visit([&](const auto& xyz) -> std::optional<CoarseFloat> {
    const double largest = largest_coordinate(xyz);
    const auto mean = mean_side_below(kLeastSteps * step_at(largest), xyz, mesh.faces);
    if (!mean) return std::nullopt;
    return coarse_float(*mean, largest);
  });
}

}  // namespace meshhood::inline v0_1
