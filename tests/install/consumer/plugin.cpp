// SPDX-License-Identifier: MIT
// A library that is loaded while a program runs, and contains what it uses of meshhood.
#include <vector>

#include <meshhood/io/weld.h>
#include <meshhood/meshhood.h>

/// How many vertices are within `radius` of the first one of a square; -1 for a radius that is refused.
extern "C" int count_in_square(double radius) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<int> triangles = {0, 1, 2, 1, 3, 2};
  const auto index = meshhood::build(positions, triangles);
  try {
    return static_cast<int>(meshhood::Searcher(index).count(0, radius));
  } catch (const meshhood::Error&) {
    return -1;
  }
}
