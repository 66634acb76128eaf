// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshhood/mesh.h"

#include "input.h"
#include "io/mesh_io.h"

/// The meshes that commands write, and their colors.
namespace meshhood::cli {

using Color = std::array<std::uint8_t, 3>;

/// Green, yellow and blue, as in the paper's Figure 4, in shades that color-blind people can distinguish. The same are
/// in viewer/src/colors.ts and tools/render_ply.py.
inline constexpr Color kExactColor{0, 158, 115};
inline constexpr Color kPaperColor{240, 228, 66};
inline constexpr Color kBallColor{0, 114, 178};
inline constexpr Color kQueryColor{213, 94, 0};
inline constexpr Color kOtherColor{217, 219, 224};

/// Writes a mesh as PLY, with progress. Throws as `io::write_ply`.
void write_ply(const std::string& file, const MeshView& mesh, io::PlyOptions options = {});

/// A value of a vertex as the float that `holder` ("a page") holds. Throws Error{InvalidOption}, naming `values`, if a
/// finite one would become infinite.
[[nodiscard]] float to_float(double value, std::string_view values, std::size_t vertex, std::string_view holder);

/// Vertices of one color.
struct Layer {
  std::span<const VertexId> vertices;
  Color color;
};

/// The same of the surface of `input`, light gray below the layers, of which the last is on top.
void write_painting(const std::string& file, Input& input, const std::vector<Layer>& layers);

}  // namespace meshhood::cli
