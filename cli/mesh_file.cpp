// SPDX-License-Identifier: MIT
#include "mesh_file.h"

#include "system.h"
#include "task.h"

namespace meshhood::cli {

void write_ply(const std::string& file, const MeshView& mesh, io::PlyOptions options) {
  Task task("writing " + file);
  options.progress = task.progress();
  io::write_ply(path_of(file), mesh, options);
}

void write_painting(const std::string& file, Input& input, const std::vector<Layer>& layers) {
  std::vector<Color> colors(input.vertex_count(), kOtherColor);
  for (const auto& [vertices, color] : layers) {
    for (const VertexId v : vertices) colors[v] = color;
  }
  const std::span<const std::uint8_t> bytes(colors.empty() ? nullptr : colors.front().data(), 3 * colors.size());
  write_ply(file, input.surface(), {.colors = bytes, .properties = {}, .walls = input.unplaced()});
}

}  // namespace meshhood::cli
