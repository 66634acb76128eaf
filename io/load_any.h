// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <variant>

#include "meshhood/index.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "io/mesh_io.h"

/// Reading files whose content is not known in advance. The implementation is in index_io.cpp.
namespace meshhood::inline v0_1::io {

/// An index of either kind and the header of its file.
struct LoadedIndex {
  IndexHeader header;
  std::variant<Index, paper::Index> index;
};

/// Reads an index of either kind. As `load`.
[[nodiscard]] LoadedIndex load_any(const std::filesystem::path& path, const Run& run = {});

/// Reads a mesh or an index, detected by content; the file may be a pipe. Throws as `read_mesh` and `load`.
[[nodiscard]] std::variant<Mesh, LoadedIndex> read_mesh_or_index(const std::filesystem::path& path,
                                                                 const ReadOptions& options = {});

}  // namespace meshhood::inline v0_1::io
