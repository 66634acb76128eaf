// SPDX-License-Identifier: MIT
#include <vector>

#include <meshhood/meshhood.h>
#ifdef USE_IO
#include <meshhood/io/mesh_io.h>
#endif

int main() {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<unsigned> triangles = {0, 1, 2, 1, 3, 2};
#ifdef USE_IO
  meshhood::io::write_ply("square.ply", {positions, meshhood::FacesView::triangles(triangles)});
#endif
  const auto index = meshhood::build(positions, triangles);
  return meshhood::Searcher(index).count(0, 1.0) == 3 ? 0 : 1;
}
