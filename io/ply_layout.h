// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "io/ply_header.h"

namespace meshhood::inline v0_1::io {

/// How the rows of a PLY file in text lie in its lines. Writers put each row into a line of its own, but the format
/// does not require that.
enum class PlyLayout {
  Undecided,  ///< every row so far has ended with a line
  Lines,      ///< a row is a line, and may be followed by more numbers in it
  Running,    ///< line ends are blanks
};

/// Rows that must follow, and the text that does.
struct PlyRest {
  std::string_view text;  ///< up to the end of the file
  const PlyHeader& header;
  const PlyElement& element;  ///< of the header
  std::uint64_t row;          ///< of the element, the first that follows
};

/// Whether the text consists of exactly these rows. With `Lines`, each must have a line of its own. A writer that adds
/// numbers to a row adds as many to each row of the element, so that one row with more numbers proves nothing.
[[nodiscard]] bool fits(const PlyRest& rest, PlyLayout layout);

}  // namespace meshhood::inline v0_1::io
