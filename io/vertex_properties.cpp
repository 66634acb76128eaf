// SPDX-License-Identifier: MIT
#include "io/vertex_properties.h"

#include <algorithm>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "shared/unplaced.h"

namespace meshhood::inline v0_1::io {
namespace {

bool is_property_name(std::string_view name) {
  const auto is_good = [](char c) { return '!' <= c && c <= '~'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_good);
}

[[noreturn]] void refuse(const VertexProperty& property, std::string_view message) {
  raise(ErrorCode::InvalidOption, fmt::format("property {}{}", quote(property.name), message));
}

}  // namespace

void check_properties(std::span<const VertexProperty> properties, std::size_t vertices,
                      std::vector<std::string_view> taken) {
  for (const VertexProperty& property : properties) {
    if (!is_property_name(property.name)) refuse(property, ": expected printable ASCII without blanks");
    if (std::find(taken.begin(), taken.end(), property.name) != taken.end())
      refuse(property, " occurs twice, or is one that the file has of itself: expected another name");
    taken.push_back(property.name);
    const std::size_t values = property.values.size();
    if (values == vertices || values == 3 * vertices) continue;
    refuse(property, fmt::format(" has {} values, expected one or three for each of {} vertices", values, vertices));
  }
}

void check_walls(std::span<const std::uint8_t> walls, const MeshView& mesh) {
  if (walls.empty()) return;
  if (walls.size() != mesh.positions.size()) {
    raise(ErrorCode::InvalidOption,
          fmt::format("{} walls, expected one for each of {} vertices", walls.size(), mesh.positions.size()));
  }
  if (const auto used = first_corner_of(mesh.faces, walls)) raise(ErrorCode::InvalidMesh, used->text());
}

}  // namespace meshhood::inline v0_1::io
