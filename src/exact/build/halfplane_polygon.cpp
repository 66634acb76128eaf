// SPDX-License-Identifier: MIT
// Why the corners of consecutive lines bound the polygon: every point p of it lies, as a direction, between two
// consecutive normals a and b, so p = s a + t b with s, t >= 0. Let A and B be the right-hand sides of their half
// planes at some height, and c the corner where the two lines meet, so that c . a = A and c . b = B. Then
//     p . p = s (p . a) + t (p . b) <= s A + t B = p . c,
// so |p| <= |c|. This needs no line to be an edge of the polygon, only consecutive normals less than half a turn apart.
// The corner moves linearly with the height, c = c0 + height * g, so |p| <= max |c0| + |height| * max |g|.
#include "exact/build/halfplane_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshhood {
namespace {

constexpr PolygonExtent kUnboundedExtent{std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::infinity()};

// Lines whose cross product is smaller, in units of the longer edge, meet where rounding puts them: the mesh has size
// 1, a squared distance is rounded by about 1e-14, and the corner magnifies that by up to 2^22.
constexpr double kSmallestCross = 0x1p-22;

struct Vector2 {
  double x;
  double y;
};

double squared_length(const Vector2& v) { return v.x * v.x + v.y * v.y; }

double cross(const Halfplane& a, const Halfplane& b) { return a.x * b.y - a.y * b.x; }

/// The point p with `p . a = value_a` and `p . b = value_b`.
Vector2 solve(const Halfplane& a, const Halfplane& b, double value_a, double value_b) {
  const double determinant = cross(a, b);
  return {(value_a * b.y - value_b * a.y) / determinant, (value_b * a.x - value_a * b.x) / determinant};
}

}  // namespace

/// Whether the normal of `b` follows that of `a` by less than half a turn, with a well-defined corner.
bool HalfplanePolygon::have_corner(const Line& a, const Line& b) {
  return cross(a.halfplane, b.halfplane) > kSmallestCross * std::max(a.length, b.length);
}

PolygonExtent HalfplanePolygon::rough_extent() const {
  if (size_ < 3) return kUnboundedExtent;  // mutant: two-lines-make-a-polygon
  PolygonExtent squared;
  for (std::size_t i = 0; i < size_; ++i) {  // mutant: last-corner-ignored
    const Line& line_a = line(i);
    const Line& line_b = line(i + 1 < size_ ? i + 1 : 0);
    if (!have_corner(line_a, line_b)) return kUnboundedExtent;  // mutant: half-turn-gap-ignored
    const Halfplane& a = line_a.halfplane;
    const Halfplane& b = line_b.halfplane;
    squared.width = std::max(squared.width, squared_length(solve(a, b, a.offset, b.offset)));
    squared.slope = std::max(squared.slope, squared_length(solve(a, b, a.tilt, b.tilt)));  // mutant: slope-ignored
  }
  return {std::sqrt(squared.width), std::sqrt(squared.slope)};
}

/// Visits the lines in turn until all of them have been kept since the last removal. Returns whether it has removed
/// any.
bool HalfplanePolygon::remove_redundant() {
  const std::size_t before = size_;
  std::size_t kept_in_a_row = 0;
  for (std::size_t i = 0; size_ > 3 && kept_in_a_row < size_;) {
    i = i < size_ ? i : 0;
    if (is_redundant(i)) {
      remove(i);
      i = (i == 0 ? size_ : i) - 1;
      kept_in_a_row = 0;  // mutant: neighbors-of-removed-line-not-visited
    } else {
      ++i;
      ++kept_in_a_row;
    }
  }
  return size_ < before;
}

/// Whether, at height 0, the corner of the lines before and after lies in the half plane of line `i`. Both sides of the
/// comparison are multiplied by the determinant of the corner.
bool HalfplanePolygon::is_redundant(std::size_t i) const {
  const Line& line_before = line(i == 0 ? size_ - 1 : i - 1);
  const Line& line_after = line(i + 1 == size_ ? 0 : i + 1);
  if (!have_corner(line_before, line_after)) return false;
  const Halfplane& before = line_before.halfplane;
  const Halfplane& after = line_after.halfplane;
  const double x = before.offset * after.y - after.offset * before.y;
  const double y = after.offset * before.x - before.offset * after.x;
  const Halfplane& between = line(i).halfplane;
  return x * between.x + y * between.y <= between.offset * cross(before, after);  // mutant: needed-line-removed
}

void HalfplanePolygon::remove(std::size_t i) {
  const auto at = [this](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::copy(at(i + 1), at(size_), at(i));
  --size_;
}

}  // namespace meshhood
