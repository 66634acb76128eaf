// SPDX-License-Identifier: MIT
#include "painting.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "interrupt.h"
#include "io/mesh_io.h"

namespace meshhood::cli {
namespace {

void put(std::vector<std::uint8_t>& colors, std::size_t vertex, const Color& color) {
  std::copy(color.begin(), color.end(), colors.begin() + static_cast<std::ptrdiff_t>(3 * vertex));
}

}  // namespace

Painting::Painting(std::size_t vertices) : colors_(3 * vertices) {
  for (std::size_t v = 0; v < vertices; ++v) put(colors_, v, kRestColor);
}

void Painting::paint(std::span<const VertexId> vertices, const Color& color) {
  for (const VertexId v : vertices) put(colors_, v, color);
}

void Painting::write(const std::string& file, const MeshView& mesh) const {
  const Interrupt interrupt;  // outlives the file that it is to leave no trace of
  io::write_ply(file, mesh, {.colors = colors_, .properties = {}, .progress = interrupt.watch()});
}

}  // namespace meshhood::cli
