// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "io/ply_header.h"

namespace meshhood::io {

/// How the rows of a PLY file in text lie in its lines. Writers put each row into a line of its own, but the format
/// does not require that.
enum class PlyLayout {
  Undecided,  ///< every row so far has ended with a line
  Lines,      ///< a row is a line, and may be followed by more numbers in it
  Running,    ///< line ends are blanks
};

/// What follows a row.
struct PlyRest {
  std::string_view text;
  bool is_cut;  ///< the file has more text
  const PlyHeader& header;
  const PlyElement& element;  ///< of the header
  std::uint64_t rows;         ///< of `element`, that follow
};

/// Whether `rest` consists of exactly the rows that must follow, each in a line of its own with `Lines`. If the text is
/// cut, whether it may.
[[nodiscard]] bool fits(const PlyRest& rest, PlyLayout layout);

}  // namespace meshhood::io
