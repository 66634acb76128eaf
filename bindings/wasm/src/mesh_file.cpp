// SPDX-License-Identifier: MIT
// Mesh files: JavaScript copies the arrays of the mesh, and drops the instance.
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "answer.h"
#include "arguments.h"
#include "host.h"
#include "workspace.h"

namespace meshhood::wasm {
namespace {

std::string warnings;

}  // namespace

extern "C" {

[[clang::export_name("read_mesh")]] void read_mesh(const void* file, std::size_t size, const char* name,
                                                   std::size_t name_size, int precision, bool strict) {
  workspace.read(view_bytes(file, size), std::string(name, name_size),
                 {.precision = static_cast<io::Precision>(precision), .strict = strict, .progress = report_progress});
}

[[clang::export_name("mesh_format")]] int mesh_format() { return static_cast<int>(workspace.mesh().format); }

[[clang::export_name("mesh_is_double")]] bool mesh_is_double() { return workspace.mesh().positions.index() == 1; }

[[clang::export_name("mesh_positions")]] const void* mesh_positions() {
  return std::visit([](const auto& xyz) { return static_cast<const void*>(xyz.data()); }, workspace.mesh().positions);
}

[[clang::export_name("mesh_scalar_count")]] std::size_t mesh_scalar_count() {
  return std::visit([](const auto& xyz) { return xyz.size(); }, workspace.mesh().positions);
}

[[clang::export_name("mesh_corners")]] const std::uint32_t* mesh_corners() { return workspace.mesh().corners.data(); }

[[clang::export_name("mesh_corner_count")]] std::size_t mesh_corner_count() { return workspace.mesh().corners.size(); }

/// Of polygons; none if all faces are triangles.
[[clang::export_name("mesh_offsets")]] const std::uint32_t* mesh_offsets() {
  answer.counts.assign(workspace.mesh().offsets.begin(), workspace.mesh().offsets.end());
  return answer.counts.data();
}

[[clang::export_name("mesh_offset_count")]] std::size_t mesh_offset_count() { return workspace.mesh().offsets.size(); }

/// Null if there are none.
[[clang::export_name("mesh_walls")]] const std::uint8_t* mesh_walls() { return workspace.mesh().walls.data(); }

[[clang::export_name("mesh_wall_count")]] std::size_t mesh_wall_count() { return workspace.mesh().walls.size(); }

/// One line for each warning, and their length.
[[clang::export_name("mesh_warnings")]] const char* mesh_warnings() {
  warnings.clear();
  for (const io::Warning& warning : workspace.mesh().warnings) {
    warnings += warning.first_place + (warning.first_place.empty() ? "" : ": ") + warning.what;
    if (warning.count > 1) warnings += " (" + std::to_string(warning.count) + " times)";
    warnings += '\n';
  }
  return warnings.data();
}

[[clang::export_name("warnings_size")]] std::size_t warnings_size() { return warnings.size(); }

}  // extern "C"

}  // namespace meshhood::wasm
