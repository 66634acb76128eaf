// SPDX-License-Identifier: MIT
// The first program of the README and of docs/cpp.md: the neighborhood of a vertex of hand.ply, a mesh in this folder.
// NOLINTBEGIN(bugprone-exception-escape): the runtime prints the error
// [readme]
#include <iostream>

#include <meshhood/io/mesh_io.h>
#include <meshhood/meshhood.h>

int main() {
  const auto mesh = meshhood::io::read_mesh("hand.ply");  // PLY, OBJ, OFF, STL, VTK or FreeSurfer
  const auto index = meshhood::build(mesh.view());        // once for each mesh
  meshhood::Searcher searcher(index);                     // one for each thread; answers any number of queries
  const auto near = searcher.neighborhood(42, 1.5);       // of vertex 42; the radius has the unit of the positions
  std::cout << near.size() << " vertices\n";
}
// [readme]
// NOLINTEND(bugprone-exception-escape)
