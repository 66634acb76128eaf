// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "meshhood/error.h"

namespace meshhood {

/// Throws Error{code} about a vertex that the mesh does not have. `where` tells what named it, as in `edge 3: vertex `,
/// and `vertex` is its number as it was given, with its sign.
[[noreturn]] inline void raise_no_such_vertex(ErrorCode code, std::string_view where, std::string_view vertex,
                                              std::size_t vertices) {
  raise(code, std::string(where).append(vertex) + ", but the mesh has " + std::to_string(vertices) + " vertices");
}

}  // namespace meshhood
