// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

#include "input.h"

namespace meshhood::cli {

using Color = std::array<std::uint8_t, 3>;

/// Green, yellow and blue, as in the paper's Figure 4, in shades that color-blind people can distinguish. The same are
/// in viewer/src/colors.ts and tools/render_ply.py.
inline constexpr Color kExactColor{0, 158, 115};
inline constexpr Color kPaperColor{240, 228, 66};
inline constexpr Color kBallColor{0, 114, 178};
inline constexpr Color kQueryColor{213, 94, 0};
inline constexpr Color kOtherColor{217, 219, 224};

/// The colors of the vertices of a mesh, initially light gray.
class Painting {
 public:
  explicit Painting(std::size_t vertices);

  void paint(std::span<const VertexId> vertices, const Color& color);

  /// Writes the colored surface as PLY. Throws as `io::write_ply`.
  void write(const std::string& file, Input& input) const;

 private:
  std::vector<std::uint8_t> colors_;  // #V by 3
};

}  // namespace meshhood::cli
