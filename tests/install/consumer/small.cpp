// SPDX-License-Identifier: MIT
// What a program of ten lines takes from the library.
#include <cstdio>
#include <vector>

#include <meshhood/meshhood.h>

int main() {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<int> triangles = {0, 1, 2, 1, 3, 2};
  const auto index = meshhood::build(positions, triangles);
  meshhood::Searcher searcher(index);
  std::printf("%zu vertices within 1\n", searcher.neighborhood(0, 1.0).size());
  return searcher.count(0, 1.0) == 3 ? 0 : 1;
}
