// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A mesh that tests can change. Its view has positions of either precision.
struct TestMesh {
  std::string name;
  bool single_precision = true;
  std::vector<double> positions;          // #V by 3; values of float where `single_precision`
  std::vector<float> single_positions;    // the same; filled by `finish`
  std::vector<std::uint64_t> offsets{0};  // #F + 1
  std::vector<std::uint32_t> corners;

  [[nodiscard]] std::size_t size() const { return positions.size() / 3; }
  [[nodiscard]] std::size_t face_count() const { return offsets.size() - 1; }

  [[nodiscard]] std::span<const std::uint32_t> face(std::size_t f) const {
    return std::span(corners).subspan(offsets[f], offsets[f + 1] - offsets[f]);
  }

  /// Returns the new vertex.
  std::uint32_t add_vertex(double x, double y, double z) {
    positions.insert(positions.end(), {x, y, z});
    return static_cast<std::uint32_t>(size() - 1);
  }

  void add_face(std::span<const std::uint32_t> face) {
    corners.insert(corners.end(), face.begin(), face.end());
    offsets.push_back(corners.size());
  }

  void add_face(std::initializer_list<std::uint32_t> face) { add_face(std::span(face.begin(), face.size())); }

  /// Rounds the positions to the precision. Call it after the last change.
  TestMesh& finish(bool single) {
    single_precision = single;
    single_positions.clear();
    if (!single) return *this;
    for (double& x : positions) {
      single_positions.push_back(static_cast<float>(x));
      x = static_cast<double>(single_positions.back());
    }
    return *this;
  }

  [[nodiscard]] PositionsView positions_view() const {
    return single_precision ? PositionsView(single_positions) : PositionsView(positions);
  }

  [[nodiscard]] MeshView view() const { return {positions_view(), FacesView::polygons(offsets, corners)}; }
};

}  // namespace meshhood::test
