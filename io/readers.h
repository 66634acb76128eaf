// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "io/input.h"
#include "io/mesh_io.h"

/// One reader a format. Each begins at the front of `input` and throws as `read_mesh` does.
namespace meshhood::io {

[[nodiscard]] Mesh read_ply(Input& input, const ReadOptions& options);
[[nodiscard]] Mesh read_obj(Input& input, const ReadOptions& options);
[[nodiscard]] Mesh read_off(Input& input, const ReadOptions& options);
[[nodiscard]] Mesh read_stl(Input& input, const ReadOptions& options);

/// Tells the format by content, and where that fits none by the ending of `name`. Takes a byte-order mark off the front
/// of `input`. Throws Error{UnsupportedFormat, MalformedFile}.
[[nodiscard]] Format detect_format(Input& input, const std::string& name);

/// Whether a line of an OBJ file may begin so.
[[nodiscard]] bool is_obj_statement(std::string_view word);

/// Whether an OFF file may begin so: `[ST][C][N][4][n]OFF`.
[[nodiscard]] bool is_off_keyword(std::string_view word);

/// Whether a file of known size is, to the byte, as long as the number of facets in a binary STL header asks for.
[[nodiscard]] bool has_binary_stl_size(Input& input);

}  // namespace meshhood::io
