// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"

#include "building.h"
#include "io/mesh_io.h"

namespace meshhood::cli {

/// FILE: a mesh, or an index, which stands for the mesh it was built from. Told apart by content.
///
/// Commands ask for what they need; what the file does not hold is made from what it does, when first asked for. Faces
/// only a mesh has; an index of the paper keeps no edges either, and whoever wants them says so by `need_edges`.
class Input {
 public:
  /// Reads `file`. What the reader finds odd is said on standard error. Throws what `io::read_mesh` and `io::load`
  /// throw.
  explicit Input(std::string file);

  /// As on the command line.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// The mesh, if that is what the file holds; null where it is an index.
  [[nodiscard]] const io::Mesh* mesh() const { return mesh_ ? &*mesh_ : nullptr; }

  [[nodiscard]] std::size_t vertex_count() const;

  /// Throws Error{InvalidOption} where the file does not tell the edges, which `purpose` needs: "--method bfs".
  void need_edges(const std::string& purpose) const;

  /// Of the mesh, in its numbering. Borrowed.
  [[nodiscard]] PositionsView positions();

  /// The same and the edges, which must be there.
  [[nodiscard]] GraphView graph();

  /// What can be drawn of it: the mesh, or its vertices alone, which is said on standard error.
  [[nodiscard]] MeshView surface();

  /// The edges must be there.
  [[nodiscard]] const Index& exact_index(unsigned threads = kAllThreads);

  /// The edges must be there, unless this is what the file holds.
  [[nodiscard]] const paper::Index& paper_index();

 private:
  std::string name_;
  std::optional<io::Mesh> mesh_;
  std::optional<Adjacency> adjacency_;  // of the mesh
  std::optional<Index> exact_;
  std::optional<GraphData> graph_;  // where that is what the file holds
  std::optional<paper::Index> paper_;
  std::optional<PositionsData> positions_;  // where that is
};

/// Reads a mesh where an index will not do. As above.
[[nodiscard]] io::Mesh read_mesh(const std::string& file);

/// Reads an index where a mesh will not do, and verifies it, with progress. Throws what `io::load` throws.
[[nodiscard]] Index load_exact_index(const std::string& file);
[[nodiscard]] paper::Index load_paper_index(const std::string& file);

/// Throws Error{InvalidOption} where `output` is a file that it is made from. Either may not exist.
void refuse_same_file(const std::string& input, const std::string& output);

}  // namespace meshhood::cli
