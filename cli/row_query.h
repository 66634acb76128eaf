// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"

#include "input.h"
#include "io/npz_writer.h"
#include "options.h"
#include "vertex_files.h"

/// The words of every command that computes a row for each vertex: which rows, their radii, and what the searches may
/// pass.
namespace meshhood::cli {

struct RowOptions {
  std::string vertices;  ///< a file with a list; empty for all
  Radii radii;
  std::string row_radii;  ///< a file with a radius for each row, instead
  MaskFiles masks;
  std::string metric = "straight";
  unsigned threads = kAllProcessors;

  [[nodiscard]] bool has_radii() const { return !radii.values.empty() || !row_radii.empty(); }

  /// The length of the first axis of the result.
  [[nodiscard]] std::size_t scale_count() const { return row_radii.empty() ? radii.values.size() : 1; }
};

/// --radius, --radii, --unit, --vertices, --walls, --ignored and --threads. See `add_metric` for the metric.
void add_rows(CLI::App& command, RowOptions& options);

/// Throws Error{InvalidOption} without radii.
void need_radii(const RowOptions& options);

/// What these options mean for an input.
class RowQuery {
 public:
  /// Borrows from `input`, whose masks it sets. Throws as `resolve`, `read_vertex_list` and `read_channel`.
  RowQuery(const RowOptions& options, Input& input);
  RowQuery(const RowQuery&) = delete;  // `rows_` may borrow from `list_`
  RowQuery& operator=(const RowQuery&) = delete;

  /// In the unit of the positions: those of all rows, or one for each row. Empty if none were given.
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }

  /// The number of rows. A row of a vertex that was welded is that of the one that it has become.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The query of all scales, for calls whose results have a leading axis for them; of the first of them; or of another
  /// radius. Borrows from this object.
  [[nodiscard]] BatchQuery query() const { return query(are_of_rows_ ? of_rows() : BatchRadius::scales(radii_)); }
  [[nodiscard]] BatchQuery query_of_first() const { return query(are_of_rows_ ? of_rows() : radii_[0]); }
  [[nodiscard]] BatchQuery query(BatchRadius radius) const;

  /// For the array `vertices` of the result: none if the rows are those of all vertices. Borrows from this object.
  [[nodiscard]] BatchVertices listed() const { return list_ ? BatchVertices(*list_) : BatchVertices(); }

 private:
  [[nodiscard]] BatchRadius of_rows() const { return radii_; }

  std::optional<std::vector<VertexId>> list_;
  BatchVertices rows_;
  Metric metric_;
  std::size_t size_;
  bool are_of_rows_;
  std::vector<double> radii_;
};

/// Writes the array `vertices`, if the query vertices are listed.
void write_vertices(io::NpzWriter& npz, const BatchVertices& rows);

/// Writes the array `radii`: (scales,), or (1, rows) if each row has its own.
void write_radii(io::NpzWriter& npz, const BatchRadius& radius);

}  // namespace meshhood::cli
