// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"

#include "filter_files.h"
#include "input.h"
#include "options.h"
#include "vertex_files.h"

/// The words of every command that computes a row for each vertex: which rows, their radii, and what the searches may
/// pass.
namespace meshhood::cli {

struct RowOptions {
  std::string vertices;  ///< a file with a list; empty for all
  Radii radii;
  FilterFiles filter;
  unsigned threads = kAllThreads;

  /// `files` and those that these options name: all that a command reads.
  [[nodiscard]] std::vector<std::string> with_files(std::vector<std::string> files) const;
};

/// --radius, --unit, --vertices, --walls, --ignored and --threads. Returns the first, which is required unless made
/// optional.
CLI::Option* add_rows(CLI::App& command, RowOptions& options);

/// What these options mean for an input.
class RowQuery {
 public:
  /// Borrows from `input`. Throws as `resolve` and `read_vertex_list`.
  RowQuery(const RowOptions& options, Input& input);

  /// In the unit of the positions; empty if --radius is optional and was not given.
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }

  [[nodiscard]] const FilterMasks& masks() const { return masks_; }

  /// The number of rows.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The query of all radii, for calls whose results have a leading axis for them; or of other ones. Borrows from this
  /// object.
  [[nodiscard]] BatchQuery query() const { return query(BatchRadius::scales(radii_)); }
  [[nodiscard]] BatchQuery query(BatchRadius radius) const;

  /// For the array `vertices` of the result: none if the rows are those of all vertices. Borrows from this object.
  [[nodiscard]] BatchVertices listed() const { return vertices_.listed(); }

 private:
  std::vector<double> radii_;
  QueryVertices vertices_;
  FilterMasks masks_;
  std::size_t size_;
};

}  // namespace meshhood::cli
