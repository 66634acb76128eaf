// SPDX-License-Identifier: MIT
// Every readable mesh of the shared folder: built with few and with all levels, checked and queried.
#include <cstdio>
#include <optional>

#include "support/each_shared_mesh.h"
#include "support/real_mesh.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class AllMeshes : public testing::TestWithParam<const char*> {};

TEST_P(AllMeshes, AreBuiltCheckedAndQueried) {
  MESHHOOD_NEED_SHARED_MESHES();
  std::size_t meshes = 0;
  std::size_t refused = 0;
  std::size_t queries = 0;
  for (const ManifestRow& row : read_manifest()) {
    if (!row.file.starts_with(GetParam())) continue;
    SCOPED_TRACE(row.file);
    const std::optional<io::Mesh> mesh = readable_mesh(row.file);
    refused += static_cast<std::size_t>(!mesh);
    if (!mesh) continue;
    ++meshes;
    for (const int levels : {5, paper::BuildOptions::kAllLevels}) {
      RealMesh real(mesh->view(), {.levels = levels, .discard = levels == 5 ? 2 : 0});
      Random random(1);
      for (const double edges : {0, 2, 5, 10, 20, 40, 65, 90, 1000}) real.query(edges, scaled(30, 2), random);
      queries += real.tally().queries;
    }
  }
  std::printf("%s: %zu meshes, %zu refused by the readers, %zu queries\n", GetParam(), meshes, refused, queries);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Folders, AllMeshes,
                         testing::Values("scan/", "cad/", "nonmanifold/", "components/", "poly/", "boundary/",
                                         "broken/"),
                         shared_folder_case);

}  // namespace
}  // namespace meshhood::test
