// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/mesh_io.h"

/// The meshes that lie beside the repository, in `../shared/meshes`. They are no part of it: a test that needs them
/// begins with `MESHHOOD_NEED_SHARED_MESHES()` and is skipped by name where they are absent.
namespace meshhood::test {

/// The folder of the meshes: `$MESHHOOD_SHARED/meshes`, else `meshes` in the `shared` that lies beside the source tree.
[[nodiscard]] std::filesystem::path shared_meshes_dir();

[[nodiscard]] bool have_shared_meshes();

/// The bytes of a file of that folder ("scan/lucy_50k.ply.zst"), decompressed where the name ends in ".zst"; nothing
/// where there is no such file.
[[nodiscard]] std::optional<std::vector<std::byte>> shared_mesh_bytes(const std::string& name);

/// That file as a mesh. Throws `std::runtime_error` where there is no such file.
[[nodiscard]] io::Mesh shared_mesh(const std::string& name, const io::ReadOptions& options = {});

/// A row of the tables of `MANIFEST.md`: what a reader should find. A figure that the table leaves open is missing.
struct ManifestRow {
  std::string file;
  std::optional<std::size_t> vertices;
  std::optional<std::size_t> faces;
  std::string sides;  ///< "3", "3: 32, 4: 468", "3 to 8", "-"
};

[[nodiscard]] std::vector<ManifestRow> read_manifest();

/// `name` without ".zst": what the reader is to take for the file's name.
[[nodiscard]] std::string plain_name(const std::string& name);

}  // namespace meshhood::test

#define MESHHOOD_NEED_SHARED_MESHES()                                       \
  if (!meshhood::test::have_shared_meshes()) {                              \
    GTEST_SKIP() << "no meshes at " << meshhood::test::shared_meshes_dir(); \
  }                                                                         \
  static_assert(true)
