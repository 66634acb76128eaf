// SPDX-License-Identifier: MIT
// Uses every installed library, so that a missing dependency of the package is an error of the linker.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <meshhood/io/index_io.h>
#include <meshhood/io/mesh_io.h>
#include <meshhood/io/weld.h>
#include <meshhood/meshhood.h>

static_assert(MESHHOOD_VERSION >= 100 && MESHHOOD_VERSION < 1000000);

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::vector<float> xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 1, 3, 2};
  const auto file = std::filesystem::path(argv[1]) / "square.ply";
  meshhood::io::write_ply(file, {xyz, meshhood::FacesView::triangles(triangles)});

  const auto mesh = meshhood::io::read_mesh(file);
  const auto index = meshhood::build(mesh.view());
  meshhood::Searcher searcher(index);
  std::printf("meshhood %s: %zu of %zu vertices within 1\n", std::string(meshhood::kVersion).c_str(),
              searcher.count(0, 1.0), index.vertex_count());
  return searcher.count(0, 2.0) == 4 && meshhood::exact_neighborhood(mesh.view(), 0, 1.0).size() == 3 ? 0 : 1;
}
