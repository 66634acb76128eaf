// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::cli {

using Color = std::array<std::uint8_t, 3>;

/// The colors of the paper's Figure 4.
inline constexpr Color kExactColor{46, 160, 67};
inline constexpr Color kPaperColor{245, 190, 20};
inline constexpr Color kBallColor{45, 105, 215};
inline constexpr Color kQueryColor{225, 25, 25};
inline constexpr Color kOtherColor{222, 222, 222};

/// The colors of the vertices of a mesh, initially light gray.
class Painting {
 public:
  explicit Painting(std::size_t vertices);

  void paint(std::span<const VertexId> vertices, const Color& color);

  /// Writes the colored mesh as PLY. Throws as `io::write_ply`.
  void write(const std::string& file, const MeshView& mesh) const;

 private:
  std::vector<std::uint8_t> colors_;  // #V by 3
};

}  // namespace meshhood::cli
