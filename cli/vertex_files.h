// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"
#include "meshhood/start.h"

#include "input.h"

/// Files that list vertices, or that have values for them. In a text, blank lines and what follows `#` are skipped.
/// Every reader throws Error{InvalidOption} with the place and what was expected, and Error{IoFailure, TooLarge}.
namespace meshhood::cli {

/// Reads vertices of a mesh of `vertices`: a text with one vertex per line, or `columns`; in any order, repeats
/// allowed. A first line `vertex` or `neighbor`, the name of a column of a table, is skipped.
[[nodiscard]] std::vector<VertexId> read_vertex_list(const std::string& file, std::size_t vertices,
                                                     std::size_t columns = 1);

/// Numbers by vertex, row by row.
struct Channels {
  std::vector<double> numbers;  ///< #V by channels
  std::size_t channels = 0;
};

/// Reads the values of a mesh of `vertices`, or of any number of rows without: an array of NumPy (.npy) of one or two
/// dimensions, recognized by its first bytes; or a text with one line per vertex, all with as many numbers.
[[nodiscard]] Channels read_channels(const std::string& file, std::optional<std::size_t> vertices);

/// The same for points in space, three numbers in each row.
[[nodiscard]] std::vector<SpacePoint> read_points(const std::string& file);

/// The same for values of one channel. `values` names them in the message: "weights".
[[nodiscard]] std::vector<double> read_channel(const std::string& file, std::size_t vertices, std::string_view values);

/// The names of the files of --walls and --ignored; "" without.
struct MaskFiles {
  std::string walls;
  std::string ignored;

  [[nodiscard]] bool empty() const { return walls.empty() && ignored.empty(); }
};

/// --walls and --ignored.
void add_masks(CLI::App& command, MaskFiles& files);

/// The masks that these files describe. Throws as `read_vertex_list`.
[[nodiscard]] OwnedMasks read_masks(const MaskFiles& files, const Input& input);

}  // namespace meshhood::cli
