// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mesh_io.h"

/// The meshes in `../shared/meshes`, beside the repository. A test that needs them begins with
/// `MESHHOOD_NEED_SHARED_MESHES()` and is skipped by name without them.
namespace meshhood::test {

/// The folder of the meshes: `$MESHHOOD_SHARED/meshes`, or else `meshes` in `shared` beside the source tree.
[[nodiscard]] std::filesystem::path shared_meshes_dir();

[[nodiscard]] bool have_shared_meshes();

/// The bytes of a file of that folder ("scan/lucy_50k.ply.zst"), decompressed if the name ends in ".zst"; empty if
/// there is no such file.
[[nodiscard]] std::optional<std::vector<std::byte>> shared_mesh_bytes(const std::string& name);

/// That file as a mesh. Throws `std::runtime_error` if there is no such file.
[[nodiscard]] io::Mesh shared_mesh(const std::string& name, const io::ReadOptions& options = {});

/// The name of a test case whose parameter is such a file: "lucy_50k".
[[nodiscard]] std::string shared_mesh_case(const testing::TestParamInfo<const char*>& file);

/// A row of the tables of `MANIFEST.md`: the expected result of reading. Figures missing in the table are empty.
struct ManifestRow {
  std::string file;
  std::optional<std::size_t> vertices;
  std::optional<std::size_t> faces;
  std::string sides;  ///< "3", "3: 32, 4: 468", "3 to 8", "-"
};

[[nodiscard]] std::vector<ManifestRow> read_manifest();

/// `name` without ".zst": the file name for the reader.
[[nodiscard]] std::string plain_name(const std::string& name);

}  // namespace meshhood::test

#define MESHHOOD_NEED_SHARED_MESHES()                                       \
  if (!meshhood::test::have_shared_meshes()) {                              \
    GTEST_SKIP() << "no meshes at " << meshhood::test::shared_meshes_dir(); \
  }                                                                         \
  static_assert(true)
