// SPDX-License-Identifier: MIT
#include "mesh_file.h"

#include <cmath>
#include <limits>

#include "output.h"
#include "system.h"
#include "task.h"

namespace meshhood::cli {

void write_ply(const std::string& file, const MeshView& mesh, io::PlyOptions options) {
  Task task("writing " + file);
  options.progress = task.progress();
  io::write_ply(path_of(file), mesh, options);
}

float to_float(double value, std::string_view values, std::size_t vertex, std::string_view holder) {
  constexpr double kMost = std::numeric_limits<float>::max();
  if (std::abs(value) <= kMost || !std::isfinite(value)) return static_cast<float>(value);
  wrong_option("{}: vertex {}: {}, but {} holds numbers of at most {:.3g}", values, vertex, value, holder, kMost);
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
