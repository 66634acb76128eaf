// SPDX-License-Identifier: MIT
// The gyroid, sin x cos y + sin y cos z + sin z cos x = 0, by surface nets (Gibson 1998): a vertex in every lattice
// cell that the surface crosses, and two triangles for every lattice edge that it crosses, with corners in the cells
// around the edge.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "assemble.h"
#include "families.h"
#include "geometry.h"

namespace meshhood::shapes {
namespace {

constexpr double kPeriod = 10.4;

/// The field whose zeros are the surface; its period is 1.
double field(const Point& p) {
  const Direction x = direction(p.x);
  const Direction y = direction(p.y);
  const Direction z = direction(p.z);
  return x.sin * y.cos + y.sin * z.cos + z.sin * x.cos;
}

/// The surface in a square column of cells, layer by layer from below.
class Net {
 public:
  explicit Net(std::size_t side) : side_(side), upper_(plane()), cells_(side * side) {}

  void add_layer() {
    lower_ = std::exchange(upper_, plane());
    cells_below_ = std::exchange(cells_, layer());
    for (std::size_t j = 0; j <= side_; ++j) {
      for (std::size_t i = 0; i <= side_; ++i) {
        join_along_x(i, j);
        join_along_y(i, j);
        join_along_z(i, j);
      }
    }
  }

  [[nodiscard]] const Shape& shape() const { return shape_; }

 private:
  static constexpr std::size_t kUnused = SIZE_MAX;

  struct Cell {
    Point center;
    std::size_t vertex = kUnused;  // once a face has used it
  };

  using Cells = std::vector<Cell>;

  /// The field at the nodes of the next plane.
  std::vector<double> plane() {
    std::vector<double> values;
    for (std::size_t j = 0; j <= side_; ++j) {
      for (std::size_t i = 0; i <= side_; ++i) values.push_back(field((1 / kPeriod) * node(i, j, planes_)));
    }
    ++planes_;
    return values;
  }

  static Point node(std::size_t i, std::size_t j, std::size_t k) {
    return {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }

  /// The cells between the two planes.
  [[nodiscard]] Cells layer() const {
    Cells cells(side_ * side_);
    for (std::size_t j = 0; j < side_; ++j) {
      for (std::size_t i = 0; i < side_; ++i) cells[j * side_ + i].center = center(i, j);
    }
    return cells;
  }

  /// The mean of the points where the surface crosses the edges of a cell.
  [[nodiscard]] Point center(std::size_t i, std::size_t j) const {
    Point sum;
    double cross_edges = 0;
    for (const unsigned axis : {1U, 2U, 4U}) {
      for (unsigned corner = 0; corner < 8; ++corner) {
        if ((corner & axis) != 0) continue;
        const double a = value(i, j, corner);
        const double b = value(i, j, corner | axis);
        if ((a < 0) == (b < 0)) continue;
        const Point from = offset(corner);
        sum = sum + from + (a / (a - b)) * (offset(corner | axis) - from);
        ++cross_edges;
      }
    }
    return node(i, j, planes_ - 2) + (cross_edges > 0 ? 1 / cross_edges : 0) * sum;
  }

  static Point offset(unsigned corner) { return node(corner & 1U, corner >> 1U & 1U, corner >> 2U); }

  [[nodiscard]] double value(std::size_t i, std::size_t j, unsigned corner) const {
    const auto& values = corner < 4 ? lower_ : upper_;
    return values[(j + (corner >> 1U & 1U)) * (side_ + 1) + i + (corner & 1U)];
  }

  void join_along_x(std::size_t i, std::size_t j) {
    if (i == side_ || j == 0 || j == side_ || planes_ == 2) return;
    join(value(i, j, 0), value(i, j, 1), {below(i, j - 1), below(i, j), here(i, j), here(i, j - 1)});
  }

  void join_along_y(std::size_t i, std::size_t j) {
    if (j == side_ || i == 0 || i == side_ || planes_ == 2) return;
    join(value(i, j, 0), value(i, j, 2), {below(i, j), below(i - 1, j), here(i - 1, j), here(i, j)});
  }

  void join_along_z(std::size_t i, std::size_t j) {
    if (i == 0 || i == side_ || j == 0 || j == side_) return;
    join(value(i, j, 0), value(i, j, 4), {here(i - 1, j - 1), here(i, j - 1), here(i, j), here(i - 1, j)});
  }

  Cell* here(std::size_t i, std::size_t j) { return &cells_[j * side_ + i]; }
  Cell* below(std::size_t i, std::size_t j) { return &cells_below_[j * side_ + i]; }

  /// Adds two triangles between the cells around an edge from a node of value `a` to one of value `b`.
  void join(double a, double b, const std::array<Cell*, 4>& ring) {
    if ((a < 0) == (b < 0)) return;
    const std::size_t first = vertex(*ring[0]);
    const std::size_t second = vertex(*ring[a < b ? 1 : 3]);
    const std::size_t third = vertex(*ring[2]);
    add_cell(shape_, first, second, third, vertex(*ring[a < b ? 3 : 1]));
  }

  std::size_t vertex(Cell& cell) {
    if (cell.vertex == kUnused) {
      cell.vertex = shape_.positions.size() / 3;
      add_vertex(shape_, cell.center);
    }
    return cell.vertex;
  }

  std::size_t side_;
  std::size_t planes_ = 0;
  std::vector<double> lower_;  // the field at the nodes below and above the current layer, row after row
  std::vector<double> upper_;
  Cells cells_below_;
  Cells cells_;
  Shape shape_;
};

}  // namespace

// The column is about twice as high as wide; the number of layers is that whose size is nearest to `n`.
Shape gyroid(std::size_t n) {
  constexpr std::size_t kSmallest = 4;
  Net net(std::max(kSmallest, cube_root(n)));  // about 0.45 vertices a cell
  std::size_t corners = 0;
  std::size_t vertices = 0;
  while (net.shape().positions.size() < 3 * n) {
    corners = net.shape().corners.size();
    vertices = net.shape().positions.size() / 3;
    net.add_layer();
  }
  Shape shape = net.shape();
  if (vertices > 0 && n - vertices < shape.positions.size() / 3 - n) {
    shape.positions.resize(3 * vertices);
    shape.corners.resize(corners);
  }
  return shape;
}

}  // namespace meshhood::shapes
