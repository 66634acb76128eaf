// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "meshhood/index.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "io/mesh_io.h"

/// One reader for each format. Each begins at the front of `input` and throws as `read_mesh` does. And readers of files
/// that may be an index.
namespace meshhood::inline v0_1::io {

/// Reads a file of any format.
[[nodiscard]] Mesh read_mesh(FileSource& file, const std::string& name, const ReadOptions& options);

struct ReaderOptions : ReadOptions {
  /// Rows are parsed in blocks of about this size; with 0, each by itself. The result does not depend on it.
  std::size_t block_bytes = std::size_t{1} << 16;
};

[[nodiscard]] Mesh read_ply(InputBuffer& input, const ReaderOptions& options);
[[nodiscard]] Mesh read_obj(InputBuffer& input, const ReaderOptions& options);
[[nodiscard]] Mesh read_off(InputBuffer& input, const ReaderOptions& options);
[[nodiscard]] Mesh read_stl(InputBuffer& input, const ReaderOptions& options);
[[nodiscard]] Mesh read_vtk(InputBuffer& input, const ReaderOptions& options);
[[nodiscard]] Mesh read_freesurfer(InputBuffer& input, const ReaderOptions& options);

/// The reader of a format.
[[nodiscard]] Mesh read_format(Format format, InputBuffer& input, const ReaderOptions& options);

/// Detects the format by content or, if the content fits none, by the extension of `name`. Removes a byte-order mark
/// from the front of `input`. Throws Error{UnsupportedFormat, MalformedFile}.
[[nodiscard]] Format detect_format(InputBuffer& input, const std::string& name);

/// The first bytes of files of VTK's legacy format, and of FreeSurfer's triangles.
inline constexpr std::string_view kVtkMark = "# vtk DataFile Version ";
inline constexpr std::string_view kFreeSurferMark = "\xff\xff\xfe";

/// Whether a line of an OBJ file may begin with `word`.
[[nodiscard]] bool is_obj_statement(std::string_view word);

/// Whether an OFF file may begin with `word`: `[ST][C][N][4][n]OFF`, or this and the number of vertices (`OFF8`).
[[nodiscard]] bool is_off_keyword(std::string_view word);

/// Whether the file has exactly the size that the number of facets in a binary STL header requires.
[[nodiscard]] bool has_binary_stl_size(InputBuffer& input);

/// Whether it has this size, or a header that is no text and at least this size, as far as it is known.
[[nodiscard]] bool is_binary_stl(InputBuffer& input);

// In index_io.cpp.

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
