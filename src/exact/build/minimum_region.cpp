// SPDX-License-Identifier: MIT
// Let `e` be the edge from vertex u to a neighbour w, and let the query vertex stand at `u + x`. Then w is nearer than
// u where `x . e > e . e / 2`. Split x into its height n over the leaf's plane and a vector p in that plane, and e
// likewise into h and d: w is nearer where
//     p . d > e . e / 2 - n h.
// The p from which no neighbour is nearer make a polygon, at n = 0 about the Voronoi cell of u among its neighbours.
// Its corners lie where two of these lines cross, at `c + n g` with c and g that do not depend on n. So the polygon has
// no point farther from u than `max |c| + max |g| |n|`, over the pairs of lines that meet at its corners at n = 0; or
// over any lines that enclose the origin: they need not all be corners of the polygon. |g| is the slope of the triangle
// that u makes with the two neighbours.
#include "exact/build/minimum_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/vector.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// An axis longer than this, of a region that opens wide, would cost the search its margin (see search/simd.h).
constexpr double kLongestAxis = 4;

// Lines that meet at a smaller angle, as seen along the shorter edge, put the corner where rounding would. The mesh has
// size 1, a squared distance is rounded by some 1e-14, and here that is magnified by up to 2^22.
constexpr double kSmallestCross = 0x1p-22;

// More edges of one vertex would hardly make its polygon smaller.
constexpr std::size_t kMostEdges = 24;

// Rows of a symmetric matrix.
using Symmetric = std::array<Point, 3>;

Symmetric covariance(std::span<const Point> points, const Point& centre) {
  Symmetric sum{};
  for (const Point& p : points) {
    const Point d = p - centre;
    sum[0] = sum[0] + d.x * d;
    sum[1] = sum[1] + d.y * d;
    sum[2] = sum[2] + d.z * d;
  }
  return sum;
}

Point mean(std::span<const Point> points) {
  Point sum{};
  for (const Point& p : points) sum = sum + p;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

/// The direction in which the points spread least, or any where they leave it open. The cofactors of the covariance
/// have the same eigenvectors in reverse order; squaring them again and again leaves the one that is wanted.
Point flattest_direction(std::span<const Point> points) {
  const Symmetric c = covariance(points, mean(points));
  Symmetric power = {cross(c[1], c[2]), cross(c[2], c[0]), cross(c[0], c[1])};
  for (int i = 0; i < 5; ++i) {
    const double trace = power[0].x + power[1].y + power[2].z;
    if (!(trace > 1e-280)) return {0, 0, 1};
    for (Point& row : power) row = 1 / trace * row;
    const Symmetric m = power;
    for (std::size_t k = 0; k < 3; ++k) power[k] = {dot(m[k], m[0]), dot(m[k], m[1]), dot(m[k], m[2])};
  }
  const Point& longest = *std::max_element(power.begin(), power.end(),
                                           [](const Point& a, const Point& b) { return dot(a, a) < dot(b, b); });
  const double norm = length(longest);
  return norm > 0 ? 1 / norm * longest : Point{0, 0, 1};
}

/// An orthonormal frame with the given third axis.
struct Axes {
  Point first;
  Point second;
  Point normal;

  explicit Axes(const Point& direction) : first{}, second{}, normal(direction) {
    const Point other = std::abs(direction.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point across = cross(direction, other);
    first = 1 / length(across) * across;
    second = cross(direction, first);
  }
};

/// How wide a region over one vertex must be.
struct Bound {
  double width = 0;
  double slope = 0;
};

constexpr Bound kUnbounded{kInfinity, kInfinity};

/// An edge as a line that bounds the polygon.
struct Line {
  double angle;  // grows with the angle from 0 to 4
  double x;
  double y;
  double height;
  double offset;  // half the square of the length
};

Line make_line(double x, double y, double height) {
  const double part = x / (std::abs(x) + std::abs(y) + std::numeric_limits<double>::min());
  return {y < 0 ? 3 + part : 1 - part, x, y, height, (x * x + y * y + height * height) / 2};
}

double cross(const Line& a, const Line& b) { return a.x * b.y - a.y * b.x; }

/// Where the lines meet, if `a` is followed by `b` after less than half a turn.
struct Corner {
  double x;
  double y;
};

Corner corner(const Line& a, const Line& b, double value_a, double value_b) {
  const double determinant = cross(a, b);
  return {(value_a * b.y - value_b * a.y) / determinant, (value_b * a.x - value_a * b.x) / determinant};
}

/// The polygon of one vertex.
class Polygon {
 public:
  void add(const Line& line) {
    if (size_ == kMostEdges) return;
    std::size_t i = size_++;
    for (; i > 0 && lines_[i - 1].angle > line.angle; --i) lines_[i] = lines_[i - 1];
    lines_[i] = line;
  }

  [[nodiscard]] Bound bound() {
    drop_redundant_lines();
    if (size_ < 3) return kUnbounded;
    Bound result;
    for (std::size_t i = 0; i < size_; ++i) {
      const Line& a = lines_[i];
      const Line& b = lines_[i + 1 < size_ ? i + 1 : 0];
      if (!(cross(a, b) > kSmallestCross * std::sqrt(2 * std::max(a.offset, b.offset)))) return kUnbounded;
      const Corner centre = corner(a, b, a.offset, b.offset);
      const Corner gradient = corner(a, b, a.height, b.height);
      result.width = std::max(result.width, centre.x * centre.x + centre.y * centre.y);
      result.slope = std::max(result.slope, gradient.x * gradient.x + gradient.y * gradient.y);
    }
    return {std::sqrt(result.width), std::sqrt(result.slope)};
  }

 private:
  /// A line is redundant where the corner of its neighbours lies on its near side.
  void drop_redundant_lines() {
    std::size_t kept_in_a_row = 0;
    for (std::size_t i = 0; size_ > 3 && kept_in_a_row < size_;) {
      i = i < size_ ? i : 0;
      if (is_redundant(i)) {
        std::copy(lines_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  lines_.begin() + static_cast<std::ptrdiff_t>(size_), lines_.begin() + static_cast<std::ptrdiff_t>(i));
        --size_;
        i = (i == 0 ? size_ : i) - 1;
        kept_in_a_row = 0;
      } else {
        ++i;
        ++kept_in_a_row;
      }
    }
  }

  [[nodiscard]] bool is_redundant(std::size_t i) const {
    const Line& before = lines_[i == 0 ? size_ - 1 : i - 1];
    const Line& after = lines_[i + 1 == size_ ? 0 : i + 1];
    const double determinant = cross(before, after);
    if (!(determinant > kSmallestCross * std::sqrt(2 * std::max(before.offset, after.offset)))) return false;
    const double x = before.offset * after.y - after.offset * before.y;
    const double y = after.offset * before.x - before.offset * after.x;
    return x * lines_[i].x + y * lines_[i].y <= lines_[i].offset * determinant;
  }

  std::array<Line, kMostEdges> lines_;  // the first `size_`
  std::size_t size_ = 0;
};

MinimumRegion make_column(const Point& direction, double width, double slope) {
  const double stretch = std::sqrt(1 + slope * slope);
  if (!(stretch <= kLongestAxis) || !(width < kInfinity)) return kUnboundedRegion;
  return {stretch * direction, width};
}

}  // namespace

MinimumRegion leaf_minimum_region(std::span<const Point> points, std::size_t first, std::size_t size,
                                  std::span<const LeafEdge> edges, const Point& centre) {
  const std::span<const Point> own = points.subspan(first, size);
  const Axes axes(flattest_direction(own));
  std::array<Polygon, kLeafCapacity> polygons;
  for (const LeafEdge& edge : edges) {
    const Point e = points[edge.neighbor] - own[edge.lane];
    polygons[edge.lane].add(make_line(dot(e, axes.first), dot(e, axes.second), dot(e, axes.normal)));
  }
  double width = 0;
  double slope = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Bound bound = polygons[i].bound();
    const Point offset = own[i] - centre;
    const double height = std::abs(dot(offset, axes.normal));
    const double u = dot(offset, axes.first);
    const double v = dot(offset, axes.second);
    // No std::hypot, which every C library rounds in its own way.
    const double distance = std::sqrt(u * u + v * v);
    width = std::max(width, distance + bound.width + bound.slope * height);
    slope = std::max(slope, bound.slope);
  }
  // So far |x's part in the plane| <= width + slope |height|. With the height as the other leg, the triangle
  // inequality makes |x| <= width + sqrt(1 + slope^2) |height| of it.
  return make_column(axes.normal, width, slope);
}

MinimumRegion enclosing_minimum_region(std::span<const MinimumRegion> children, std::span<const Point> centres,
                                       const Point& centre) {
  Point sum{};
  // An axis has no direction: each is turned to the side of those before.
  for (const MinimumRegion& child : children) sum = dot(child.axis, sum) < 0 ? sum - child.axis : sum + child.axis;
  const double norm = length(sum);
  if (!(norm > 0)) return kUnboundedRegion;
  const Point axis = 1 / norm * sum;
  double reach = 0;
  double stretch = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    // |x . child.axis| <= cosine |x . axis| + sine |x|, both times the length of child.axis; solved for |x|.
    const double cosine = std::abs(dot(children[i].axis, axis));
    const double rest = 1 - length(cross(children[i].axis, axis));
    if (!(rest > 0) || !(children[i].reach < kInfinity)) return kUnboundedRegion;
    const Point offset = centres[i] - centre;
    reach = std::max(reach, length(offset) + (children[i].reach + cosine * std::abs(dot(offset, axis))) / rest);
    stretch = std::max(stretch, cosine / rest);
  }
  if (!(stretch <= kLongestAxis)) return kUnboundedRegion;
  return {stretch * axis, reach};
}

}  // namespace meshhood
