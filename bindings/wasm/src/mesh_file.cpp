// SPDX-License-Identifier: MIT
// Mesh files, and welding: JavaScript copies the arrays of the mesh, and drops the instance.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "answer.h"
#include "arguments.h"
#include "host.h"
#include "io/mesh_io.h"
#include "io/weld.h"

namespace meshhood::wasm {
namespace {

io::Mesh file_mesh;
std::string warnings;

}  // namespace

/// The ids of the answer are the corners, and the counts the offsets of polygons; none if all faces are triangles.
[[clang::export_name("read_mesh")]] void read_mesh(const void* file, std::size_t size, const char* name,
                                                   std::size_t name_size, io::Precision precision, bool strict) {
  file_mesh = io::read_mesh(view_bytes(file, size), std::string(name, name_size),
                            {.precision = precision, .strict = strict, .progress = report_progress});
  answer.ids = std::move(file_mesh.corners);
  answer.counts.assign(file_mesh.offsets.begin(), file_mesh.offsets.end());
}

[[clang::export_name("mesh_format")]] int mesh_format() { return static_cast<int>(file_mesh.format); }

[[clang::export_name("mesh_is_double")]] bool mesh_is_double() { return file_mesh.positions.index() == 1; }

[[clang::export_name("mesh_positions")]] const void* mesh_positions() {
  return std::visit([](const auto& xyz) { return static_cast<const void*>(xyz.data()); }, file_mesh.positions);
}

[[clang::export_name("mesh_positions_size")]] std::size_t mesh_positions_size() {
  return std::visit([](const auto& xyz) { return xyz.size(); }, file_mesh.positions);
}

/// Null if there are none.
[[clang::export_name("mesh_walls")]] const std::uint8_t* mesh_walls() { return file_mesh.walls.data(); }

[[clang::export_name("mesh_walls_size")]] std::size_t mesh_walls_size() { return file_mesh.walls.size(); }

/// One line for each warning.
[[clang::export_name("mesh_warnings")]] const char* mesh_warnings() {
  warnings.clear();
  for (const io::Warning& warning : file_mesh.warnings) warnings += warning.text() + '\n';
  return warnings.data();
}

[[clang::export_name("mesh_warnings_size")]] std::size_t mesh_warnings_size() { return warnings.size(); }

/// The positions of the mesh are those of the kept vertices. The ids of the answer are those that the vertices get, the
/// counts the new corners. The faces keep their offsets.
[[clang::export_name("weld")]] void weld(double eps) {
  io::WeldedMesh welded = io::weld(given, eps);
  file_mesh.positions = std::move(welded.positions);
  answer.ids = std::move(welded.ids);
  answer.counts = std::move(welded.corners);
}

}  // namespace meshhood::wasm
