// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "io/input_buffer.h"
#include "io/mesh_builder.h"
#include "io/ply_header.h"
#include "io/readers.h"
#include "io/text.h"

namespace meshhood::inline v0_1::io {

/// The plain rows of an element of a PLY file (see `PlainRows`): takes some, up to `most`, and appends what they hold.
/// Returns how many there were: the next row, if there is one, is to be read value by value. Empty if none is plain.
using PlyRows = std::function<std::uint64_t(std::uint64_t most)>;

/// The vertices, whose properties x, y, z are at `axes`. All four functions borrow their arguments.
[[nodiscard]] PlyRows vertex_rows(Text& text, const ReaderOptions& options, const PlyElement& element,
                                  const std::array<std::size_t, 3>& axes, Positions& positions);

/// The faces, whose vertices are in the property `list`, each below `vertices`.
[[nodiscard]] PlyRows face_rows(Text& text, const ReaderOptions& options, const PlyElement& element, std::size_t list,
                                std::uint64_t vertices, Faces& faces);

/// The same in a binary file in the byte order of the processor.
[[nodiscard]] PlyRows vertex_rows(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
                                  const std::array<std::size_t, 3>& axes, Positions& positions);
[[nodiscard]] PlyRows face_rows(InputBuffer& input, const ReaderOptions& options, const PlyElement& element,
                                std::size_t list, std::uint64_t vertices, Faces& faces);

}  // namespace meshhood::inline v0_1::io
