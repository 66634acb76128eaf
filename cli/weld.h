// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "io/mesh_io.h"

/// --weld: the mesh with vertices at the same place joined (io/weld.h), in the numbering of the file. The faces name
/// only kept vertices. The others have their positions, and are in no face; where an option names one, the kept vertex
/// is taken.
namespace meshhood::cli {

/// Stores what was typed: "" without the option.
CLI::Option* add_weld(CLI::App& command, std::string& weld);

/// What was typed, as a number; 0 if none was.
[[nodiscard]] double eps_of(const std::string& weld);

/// EPS for positions that differ by rounding, as a note names it: a thousandth of the mean edge, in one digit.
[[nodiscard]] std::string rounding_eps(double mean_edge);

/// For each vertex the one that it becomes, itself if it is kept. Throws as `io::welded_ids`.
[[nodiscard]] std::vector<VertexId> kept_vertices(const PositionsView& positions, double eps);

/// The same of a mesh, whose walls are kept: they are where they are because they have no position.
[[nodiscard]] std::vector<VertexId> kept_vertices(const io::Mesh& mesh, double eps);

/// Which vertices of a mesh have become others.
class Welding {
 public:
  /// Nothing is welded.
  Welding() = default;

  /// Welds the mesh of `file`, as `weld` says, and prints a note. Throws Error{InvalidOption, InvalidMesh}.
  Welding(io::Mesh& mesh, const std::string& weld, const std::string& file);

  /// The vertex that `v` has become.
  [[nodiscard]] VertexId kept(VertexId v) const { return kept_.empty() ? v : kept_[v]; }

  /// By vertex: the one that it has become; empty if all are kept.
  [[nodiscard]] const std::vector<VertexId>& kept() const { return kept_; }

  /// How many are not kept.
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::vector<VertexId> kept_;
  std::size_t count_ = 0;
};

/// Throws Error{InvalidOption} if both are given: `method` is "ball", which knows no faces.
void check_weld(const std::string& weld, const std::string& method);

}  // namespace meshhood::cli
