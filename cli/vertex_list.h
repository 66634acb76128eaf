// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::cli {

/// Reads vertices of a mesh of `vertices` from a text, one a line, in any order, repeats allowed. Blank lines and what
/// follows a `#` do not count.
///
/// Throws Error{InvalidOption}, naming the line and what was expected; Error{IoFailure, MalformedFile} where the file
/// cannot be read or is no text.
[[nodiscard]] std::vector<VertexId> read_vertex_list(const std::string& file, std::size_t vertices);

}  // namespace meshhood::cli
