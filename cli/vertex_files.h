// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace meshhood::cli {

/// Numbers by vertex, row by row.
struct Channels {
  std::vector<double> numbers;  ///< #V by channels
  std::size_t channels = 0;
};

/// Reads the values of a mesh of `vertices`: an array of NumPy (.npy) of one or two dimensions, told by its first
/// bytes; or a text with one line per vertex, all with as many numbers. Blank lines and the text after `#` are skipped.
///
/// Throws Error{InvalidOption} with the place and what was expected; Error{IoFailure, TooLarge}.
[[nodiscard]] Channels read_channels(const std::string& file, std::size_t vertices);

}  // namespace meshhood::cli
