// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace meshhood {

/// The points `p` of a plane with `p . (x, y) <= offset - height * tilt`, for any height: a half plane whose boundary
/// moves as the height grows. The normal (x, y) is not normalised.
struct Halfplane {
  double x;
  double y;
  double tilt;
  double offset;  // at least 0, so that the origin lies in the half plane at height 0
};

/// The diamond angle: grows from 0 to 4 with the angle of (x, y), and needs no trigonometry, which every C library
/// rounds in its own way.
[[nodiscard]] inline double diamond_angle(double x, double y) {
  const double part = x / (std::abs(x) + std::abs(y) + std::numeric_limits<double>::min());
  return y < 0 ? 3 + part : 1 - part;
}

/// Every point of a polygon at the given height lies within `width + slope * |height|` of the origin.
struct PolygonExtent {
  double width = 0;
  double slope = 0;
};

/// The intersection of half planes, as a function of the height.
class HalfplanePolygon {
 public:
  /// Keeps the first `kMaxHalfplanes`: without the others the polygon is larger, and its extent still an upper bound.
  /// `edge_length` is the root of twice the offset.
  void add(const Halfplane& halfplane, double edge_length) {
    if (size_ == kMaxHalfplanes) return;
    const auto added = static_cast<std::uint8_t>(size_);
    lines_[added] = {diamond_angle(halfplane.x, halfplane.y), edge_length, halfplane};
    std::size_t i = size_++;
    for (; i > 0 && lines_[order_[i - 1]].angle > lines_[added].angle; --i) order_[i] = order_[i - 1];
    order_[i] = added;
  }

  /// An upper bound on the extent, which is infinite where the polygon is unbounded or nearly so. Removes redundant
  /// half planes. O(size^2) in the worst case, mostly O(size).
  [[nodiscard]] PolygonExtent extent() { return extent(rough_extent()); }

  /// The same, given the rough extent.
  [[nodiscard]] PolygonExtent extent(const PolygonExtent& rough) { return remove_redundant() ? rough_extent() : rough; }

  /// An upper bound too, from all half planes: faster, and larger where some are redundant. O(size).
  [[nodiscard]] PolygonExtent rough_extent() const;

  // A vertex has six neighbors on average; more would hardly make its polygon smaller.
  static constexpr std::size_t kMaxHalfplanes = 24;

 private:
  struct Line {
    double angle;
    double length;  // of the edge, where the offset is half the square of an edge's length
    Halfplane halfplane;
  };

  [[nodiscard]] const Line& line(std::size_t i) const { return lines_[order_[i]]; }
  [[nodiscard]] static bool have_corner(const Line& a, const Line& b);

  bool remove_redundant();
  [[nodiscard]] bool is_redundant(std::size_t i) const;
  void remove(std::size_t i);

  std::array<Line, kMaxHalfplanes> lines_;
  std::array<std::uint8_t, kMaxHalfplanes> order_;  // the first `size_` name the lines, by the angle of their normals
  std::size_t size_ = 0;
};

}  // namespace meshhood
