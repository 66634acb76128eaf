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

/// Random queries of differential tests, mostly where errors are likely.
namespace meshhood::test {

template <class T>
T pick(Random& random, std::initializer_list<T> choices) {
  return *(choices.begin() + random.below(choices.size()));
}

/// Mostly small sizes, and a few large ones.
inline std::size_t draw_size(std::uint64_t seed) {
  if (seed == 0) return 5000;
  if (seed % 40 == 0) return 1500;
  return 10 + (seed * 37) % (seed % 5 == 0 ? 400 : 80);
}

/// Zero, infinity, the paper's multiples of the mean edge length, and distances to vertices with their adjacent
/// doubles.
inline std::vector<double> draw_radii(Random& random, const Oracle& oracle, std::uint32_t v) {
  std::vector<double> radii{0.0, kInfinity};
  for (const double edges : {2, 5, 10, 20, 40, 65, 90}) radii.push_back(edges * oracle.mean_edge());
  for (int i = 0; i < 3; ++i) {
    const double tie = oracle.distance(v, random.below(oracle.size()));
    radii.insert(radii.end(), {tie, std::nextafter(tie, kInfinity), std::nextafter(tie, 0.0)});
  }
  return radii;
}

}  // namespace meshhood::test
