// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "output.h"

/// The files of a command that computes values of vertices: the arrays, and the mesh with the values for ParaView,
/// PyVista and MeshLab.
namespace meshhood::cli {

/// The names of the files; "" for one that was not requested.
struct ValueFiles {
  std::string npz;
  std::string ply;
  std::string vtk;

  [[nodiscard]] bool has_mesh() const { return !ply.empty() || !vtk.empty(); }
  [[nodiscard]] const std::string& first() const { return !npz.empty() ? npz : !ply.empty() ? ply : vtk; }
};

/// --output, --ply and --vtk. `shown` is the value that a program shows at once. A mesh has values of all vertices, so
/// the last two exclude --vertices, if the command has that option already.
void add_value_files(CLI::App& command, ValueFiles& files, const std::string& shown);

/// As `check_outputs`. Throws also if no file was requested.
void check_value_files(const ValueFiles& files);

/// The requested files, for a message and for JSON.
[[nodiscard]] std::string names_of(const ValueFiles& files);
[[nodiscard]] Json to_json(const ValueFiles& files);

/// Values and vectors of all vertices, with a name each.
class VertexValues {
 public:
  explicit VertexValues(std::size_t vertices) : vertices_(vertices) {}

  /// Adds `value_of(vertex)` of each vertex.
  template <class F>
  void add(std::string name, F&& value_of) {
    std::vector<float>& values = columns_.emplace_back(std::move(name), std::vector<float>(vertices_)).second;
    for (std::size_t v = 0; v < vertices_; ++v) values[v] = to_float(value_of(v));
  }

  /// `vectors`: #V by 3.
  void add_vectors(std::string name, std::span<const double> vectors);

  /// Writes the requested meshes, with the values of column `shown` first, which MeshLab knows as `quality`. `colors`
  /// are for PLY: #V by 3, or empty.
  void write(const ValueFiles& files, const MeshView& mesh, std::size_t shown,
             std::span<const std::uint8_t> colors = {}) const;

 private:
  /// Infinite if it is too large.
  [[nodiscard]] static float to_float(double value);

  std::size_t vertices_;
  std::vector<std::pair<std::string, std::vector<float>>> columns_;
};

}  // namespace meshhood::cli
