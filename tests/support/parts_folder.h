// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/search.h"

#include "io/index_io.h"
#include "io/mesh_io.h"
#include "io/npy.h"
#include "parts/chunked_mesh.h"
#include "parts/manifest.h"
#include "parts/partition.h"
#include "support/families.h"
#include "support/scratch.h"
#include "support/test_mesh.h"

namespace meshhood::test {

inline io::Mesh as_file_mesh(const TestMesh& mesh) {
  io::Mesh result;
  if (mesh.single_precision) {
    result.positions = mesh.single_positions;
  } else {
    result.positions = mesh.positions;
  }
  result.offsets = mesh.offsets;
  result.corners = mesh.corners;
  return result;
}

inline std::unique_ptr<parts::ChunkedMesh> chunked(const TestMesh& mesh) {
  return parts::chunked(as_file_mesh(mesh), mesh.name);
}

template <class T>
std::vector<T> read_array(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const io::NpyHeader header = io::parse_npy_header(bytes, path.string());
  std::vector<T> values((bytes.size() - header.bytes) / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data() + header.bytes, values.size() * sizeof(T));
  return values;
}

/// A part, read from its folder.
struct OpenPart {
  explicit OpenPart(const std::filesystem::path& folder)
      : index(io::load(folder / parts::kIndexFile)),
        ids(read_array<std::int64_t>(folder / parts::kVerticesFile)),
        owned(read_array<std::int32_t>(folder / parts::kOwnedFile)),
        corners(read_array<std::int32_t>(folder / parts::kCornersFile)),
        offsets(read_array<std::int64_t>(folder / parts::kOffsetsFile)) {}

  Index index;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> owned;
  std::vector<std::int32_t> corners;
  std::vector<std::int64_t> offsets;
};

/// Name -> content of all files below a folder.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[relative(entry.path(), folder).generic_string()] = read_file(entry.path());
  }
  return files;
}

inline const parts::PartitionOptions kOptions{.parts = 4, .halo = 3};

/// Runs that write a mesh in four parts into a folder.
class PartsFolder : public testing::Test {
 protected:
  parts::PartitionResult run(const std::filesystem::path& target, const Progress& progress = {}) const {
    return partition(*chunked(mesh), target, kOptions, {.progress = progress});
  }

  /// A complete folder.
  std::map<std::string, std::string> whole() const {
    run(scratch.path() / "whole");
    return contents(scratch.path() / "whole");
  }

  Scratch scratch;
  std::filesystem::path folder = scratch.path() / "parts";
  TestMesh mesh = bumpy_grid(30);
};

}  // namespace meshhood::test
