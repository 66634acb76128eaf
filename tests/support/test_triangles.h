// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/triangulate.h"
#include "base/vector.h"
#include "support/test_mesh.h"

namespace meshhood::test {

[[nodiscard]] inline Point corner_of(const TestMesh& mesh, std::uint32_t v) {
  return {mesh.positions[3 * std::size_t{v}], mesh.positions[3 * std::size_t{v} + 1],
          mesh.positions[3 * std::size_t{v} + 2]};
}

/// The smallest number of a face with the vertex; #F without one.
[[nodiscard]] inline std::size_t first_face_of(const TestMesh& mesh, std::uint32_t v) {
  std::size_t face = 0;
  while (face < mesh.face_count() && std::ranges::count(mesh.face(face), v) == 0) ++face;
  return face;
}

/// The triangles of the faces of a mesh, face after face. How polygons are divided is tested by itself; where squares
/// of lengths vanish, it depends on the scale.
struct TestTriangles {
  explicit TestTriangles(const TestMesh& mesh, double scale = 1) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<Point> points;
      for (const std::uint32_t v : mesh.face(f)) points.push_back(scale * corner_of(mesh, v));
      Triangulation parts;
      triangulate(points, parts);
      const auto owner = [&](std::size_t a, std::size_t b) {
        const bool is_side = (a + 1) % points.size() == b || (b + 1) % points.size() == a;
        return static_cast<std::uint32_t>(is_side ? 0 : f + 1);
      };
      for (const auto& [a, b, c] : parts) {
        corners.push_back({mesh.face(f)[a], mesh.face(f)[b], mesh.face(f)[c]});
        owners.push_back({owner(a, b), owner(b, c), owner(c, a)});
        faces.push_back(f);
      }
    }
  }

  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<std::array<std::uint32_t, 3>> owners;  // of each side: 1 + the face of a diagonal, or 0
  std::vector<std::size_t> faces;

  [[nodiscard]] std::vector<std::size_t> faces_of(const std::vector<std::size_t>& triangles) const {
    std::vector<std::size_t> result;
    for (const std::size_t t : triangles) result.push_back(faces[t]);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
};

}  // namespace meshhood::test
