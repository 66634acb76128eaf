// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

#include "support/oracle.h"
#include "support/random.h"

/// What a differential test asks: drawn at random, but mostly where something can go wrong.
namespace meshhood::test {

template <class T>
T pick(Random& random, std::initializer_list<T> choices) {
  return *(choices.begin() + random.below(choices.size()));
}

/// Mostly small meshes, in which everything happens close together, and a few large ones.
inline std::size_t draw_size(std::uint64_t seed) {
  if (seed == 0) return 5000;
  if (seed % 40 == 0) return 1500;
  return 10 + (seed * 37) % (seed % 5 == 0 ? 400 : 80);
}

/// Zero, infinity, the paper's multiples of the mean edge, and distances that occur with their neighbours in double.
inline std::vector<double> draw_radii(Random& random, const Oracle& oracle, std::uint32_t v) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> radii{0.0, kInfinity};
  for (const double edges : {2, 5, 10, 20, 40, 65, 90}) radii.push_back(edges * oracle.mean_edge());
  for (int i = 0; i < 3; ++i) {
    const double tie = oracle.distance(v, random.below(oracle.size()));
    radii.insert(radii.end(), {tie, std::nextafter(tie, kInfinity), std::nextafter(tie, 0.0)});
  }
  return radii;
}

}  // namespace meshhood::test
