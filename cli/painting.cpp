// SPDX-License-Identifier: MIT
#include "painting.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "io/mesh_io.h"
#include "system.h"
#include "task.h"

namespace meshhood::cli {

Painting::Painting(std::size_t vertices) : colors_(3 * vertices) {
  for (std::size_t i = 0; i < colors_.size(); ++i) colors_[i] = kOtherColor[i % 3];
}

void Painting::paint(std::span<const VertexId> vertices, const Color& color) {
  for (const VertexId v : vertices) {
    std::copy(color.begin(), color.end(), colors_.begin() + static_cast<std::ptrdiff_t>(3 * std::size_t{v}));
  }
}

void Painting::write(const std::string& file, Input& input) const {
  Task task("writing " + file);
  io::write_ply(path_of(file), input.surface(),
                {.colors = colors_, .properties = {}, .walls = input.unplaced(), .progress = task.progress()});
}

}  // namespace meshhood::cli
