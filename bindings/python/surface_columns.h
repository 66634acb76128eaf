// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "meshhood/surface.h"

#include "arrays.h"

namespace meshhood::python {

/// Points of a surface in memory of NumPy, a column for each property. Made with the interpreter lock.
class SurfaceColumns {
 public:
  explicit SurfaceColumns(std::size_t rows)
      : distances_(rows, "float64"),
        faces_(rows, "int64"),
        corners_(rows, "int32", 3),
        barycentric_(rows, "float64", 3),
        points_(rows, "float64", 3) {}

  /// On any thread. `corners`: of its triangle.
  void set(std::size_t row, const SurfacePoint& found, const std::array<VertexId, 3>& corners) {
    static_assert(static_cast<std::int64_t>(kNoFace) == -1);
    distances_.values[row] = found.distance;
    faces_.values[row] = static_cast<std::int64_t>(found.face);
    corners_.values[row] = corners;
    barycentric_.values[row] = found.barycentric;
    points_.values[row] = found.point;
  }

  /// Distances, faces, the corners of their triangles, barycentric coordinates and points.
  [[nodiscard]] auto arrays() const {
    return std::tuple(distances_.array, faces_.array, corners_.array, barycentric_.array, points_.array);
  }

 private:
  template <class Value>
  struct Column {
    nanobind::object array;
    std::span<Value> values;

    Column(std::size_t rows, const char* dtype, std::size_t columns = 0)
        : array(unset(rows, dtype, columns)), values(values_of<Value>(array)) {}
  };

  Column<double> distances_;
  Column<std::int64_t> faces_;
  Column<std::array<VertexId, 3>> corners_;
  Column<std::array<double, 3>> barycentric_;
  Column<SpacePoint> points_;
};

}  // namespace meshhood::python
