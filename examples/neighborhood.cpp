// SPDX-License-Identifier: MIT
// The neighborhood of a vertex of a mesh file: `example_neighborhood FILE VERTEX RADIUS`.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

// NOLINTBEGIN(misc-use-internal-linkage): as the README shows it
// [readme]
#include <meshhood/io/mesh_io.h>
#include <meshhood/meshhood.h>

std::vector<meshhood::VertexId> near(const char* file, meshhood::VertexId vertex, double radius) {
  const auto mesh = meshhood::io::read_mesh(file);  // PLY, OBJ, OFF or STL
  const auto index = meshhood::build(mesh.view());  // once for each mesh
  meshhood::Searcher searcher(index);               // one for each thread; answers any number of queries
  return searcher.neighborhood(vertex, radius);     // the radius has the unit of the positions
}
// [readme]
// NOLINTEND(misc-use-internal-linkage)

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: %s FILE VERTEX RADIUS\n", argv[0]);
    return 2;
  }
  const auto vertex = static_cast<meshhood::VertexId>(std::strtoul(argv[2], nullptr, 10));
  const double radius = std::strtod(argv[3], nullptr);
  std::printf("%zu vertices connected to vertex %u within distance %g\n", near(argv[1], vertex, radius).size(),
              unsigned{vertex}, radius);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
