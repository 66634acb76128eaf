// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"
#include "meshhood/start.h"

#include "input.h"
#include "io/npz_writer.h"

/// Files that list vertices, or that have values for them. In a text, blank lines and what follows `#` are skipped.
/// Every reader throws Error{InvalidOption} with the place and what was expected, and Error{IoFailure, TooLarge}.
namespace meshhood::cli {

/// Reads vertices of a mesh of `vertices`: a text with one vertex per line, or `columns`; in any order, repeats
/// allowed.
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

/// --vertices: a file with the query vertices of a command that writes a row for each.
void add_vertices(CLI::App& command, std::string& file);

/// The query vertices of such a command. A row of a vertex that was welded is that of the one that it has become.
class QueryVertices {
 public:
  /// The vertices that `file` lists, or all if it is "". Borrows from `input`.
  QueryVertices(const std::string& file, const Input& input);
  QueryVertices(const QueryVertices&) = delete;  // `rows_` may borrow from `list_`
  QueryVertices& operator=(const QueryVertices&) = delete;

  /// For the search. Borrows from this object, as the next.
  [[nodiscard]] BatchVertices view() const { return rows_; }

  /// For the array `vertices` of the result: none if the rows are those of all vertices.
  [[nodiscard]] BatchVertices listed() const { return are_listed_ ? rows_ : BatchVertices(); }

 private:
  bool are_listed_;
  std::vector<VertexId> list_;
  BatchVertices rows_;
};

/// Writes the array `vertices`, if the query vertices are listed.
void write_vertices(io::NpzWriter& npz, const BatchVertices& rows);

}  // namespace meshhood::cli
