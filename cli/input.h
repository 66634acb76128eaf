// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

#include "io/mesh_io.h"

namespace meshhood::cli {

/// A mesh file with its graph, as every command that reads one needs it.
struct Input {
  std::string name;  ///< as on the command line
  io::Mesh mesh;
  Adjacency adjacency;

  [[nodiscard]] MeshView view() const { return mesh.view(); }
  [[nodiscard]] GraphView graph() const { return {view().positions, adjacency.view()}; }
  [[nodiscard]] std::size_t vertex_count() const { return view().positions.size(); }
};

/// Reads `file`. What the reader finds odd is said on standard error. Throws what `io::read_mesh` throws.
[[nodiscard]] Input read_input(const std::string& file);

/// Throws Error{InvalidOption} where `output` is a file that it is made from. Either may not exist.
void refuse_same_file(const std::string& input, const std::string& output);

}  // namespace meshhood::cli
