// SPDX-License-Identifier: MIT
// Let `e` be the edge from vertex u to a neighbour w, and let the query vertex stand at `u + x`. Then w is nearer than u
// where `x . e > e . e / 2`. Split x into its height n over the leaf's plane and a part of length s in the direction t
// of that plane, and e likewise, with height h: w is nearer where
//     s > (e.e / 2 + |n h|) / (t . e).
// So for every t, an edge with t . e > 0 bounds how far from the axis a column must reach at height n: `width + slope
// |n|`. Directions are taken by sectors, each with the edge that does best there and its worst direction within.
#include "index/column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meshhood {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// An axis longer than this, of a column that opens wide, would cost the search its margin (see kernels.h).
constexpr double kLongestAxis = 4;

// Edges shorter than this, along the sector's direction, cannot tell nearer from farther: the mesh has size 1, and a
// squared distance is rounded by some 1e-14.
constexpr float kShortestEdge = 1e-7F;

// Of the single-precision arithmetic below, relative to the edge.
constexpr float kRounding = 1e-6F;

constexpr std::size_t kSectors = 16;
using Sectors = std::array<float, kSectors>;

struct Directions {
  Sectors cosine;
  Sectors sine;
  float half_cosine;
  float half_sine;
};

Directions make_directions() {
  Directions result{};
  const double half = std::acos(-1.0) / kSectors;
  for (std::size_t k = 0; k < kSectors; ++k) {
    result.cosine[k] = static_cast<float>(std::cos(2 * half * static_cast<double>(k)));
    result.sine[k] = static_cast<float>(std::sin(2 * half * static_cast<double>(k)));
  }
  result.half_cosine = static_cast<float>(std::cos(half));
  result.half_sine = static_cast<float>(std::sin(half));
  return result;
}

const Directions kDirections = make_directions();

Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Matrix = std::array<Point, 3>;

Matrix covariance(std::span<const Point> points, const Point& centre) {
  Matrix sum{};
  for (const Point& p : points) {
    const Point d = p - centre;
    sum[0] = sum[0] - -d.x * d;
    sum[1] = sum[1] - -d.y * d;
    sum[2] = sum[2] - -d.z * d;
  }
  return sum;
}

Point mean(std::span<const Point> points) {
  Point sum{};
  for (const Point& p : points) sum = sum - -1.0 * p;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

/// The direction in which the points spread least, or any where they leave it open. The cofactors of the covariance
/// have the same eigenvectors in reverse order; squaring them again and again leaves the one that is wanted.
Point flattest_direction(std::span<const Point> points) {
  const Matrix c = covariance(points, mean(points));
  Matrix power = {cross(c[1], c[2]), cross(c[2], c[0]), cross(c[0], c[1])};
  for (int i = 0; i < 5; ++i) {
    const double trace = power[0].x + power[1].y + power[2].z;
    if (!(trace > 1e-280)) return {0, 0, 1};
    for (Point& row : power) row = 1 / trace * row;
    const Matrix m = power;
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

/// How wide a column over one vertex must be.
struct Bound {
  float width;
  float slope;
};

/// Of all edges of a vertex, the best for every sector.
class VertexBound {
 public:
  explicit VertexBound(float leaf_radius) : leaf_radius_(leaf_radius) {}

  void add_edge(float x, float y, float height) {
    const float square = x * x + y * y + height * height;
    // What counts is the width, and the slope at heights about the size of the leaf.
    const float weight = 1 / (square / (2 * leaf_radius_) + std::abs(height) + std::numeric_limits<float>::min());
    const float rounding = kRounding * std::sqrt(square) + kShortestEdge;
    for (std::size_t k = 0; k < kSectors; ++k) {
      const float along = x * kDirections.cosine[k] + y * kDirections.sine[k];
      const float across = std::abs(y * kDirections.cosine[k] - x * kDirections.sine[k]);
      // The smallest t . e over the sector.
      const float advance = along * kDirections.half_cosine - across * kDirections.half_sine - rounding;
      const float score = advance * weight;
      const bool better = score > score_[k];
      score_[k] = better ? score : score_[k];
      advance_[k] = better ? advance : advance_[k];
      square_[k] = better ? square : square_[k];
      height_[k] = better ? std::abs(height) : height_[k];
    }
  }

  /// Infinite where some sector has no edge.
  [[nodiscard]] Bound bound() const {
    Bound result{0, 0};
    for (std::size_t k = 0; k < kSectors; ++k) {
      // Without an edge the score is 0, and so is the advance.
      result.width = std::max(result.width, square_[k] / (2 * advance_[k]));
      result.slope = std::max(result.slope, height_[k] / advance_[k]);
    }
    return {result.width * (1 + 8 * kRounding), result.slope * (1 + 8 * kRounding)};
  }

 private:
  float leaf_radius_;
  Sectors score_{};
  Sectors advance_{};
  Sectors square_ = [] {
    Sectors all{};
    all.fill(1);
    return all;
  }();
  Sectors height_{};
};

Column make_column(const Point& direction, double width, double slope) {
  const double stretch = std::sqrt(1 + slope * slope);
  if (!(stretch <= kLongestAxis) || !(width < kInfinity)) return {{0, 0, 0}, kInfinity};
  return {stretch * direction, width};
}

}  // namespace

Column leaf_column(const ColumnInput& leaf, const Point& centre) {
  const std::span<const Point> own = leaf.points.subspan(leaf.begin, leaf.end - leaf.begin);
  const Axes axes(flattest_direction(own));
  double radius = 1e-30;
  for (const Point& p : own) radius = std::max(radius, length(p - centre));
  double width = 0;
  double slope = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    VertexBound vertex(static_cast<float>(radius));
    for (const std::size_t end = next + leaf.degrees[i]; next < end; ++next) {
      const Point e = leaf.points[leaf.neighbors[next]] - own[i];
      vertex.add_edge(static_cast<float>(dot(e, axes.first)), static_cast<float>(dot(e, axes.second)),
                      static_cast<float>(dot(e, axes.normal)));
    }
    const Bound bound = vertex.bound();
    const Point offset = own[i] - centre;
    const double height = std::abs(dot(offset, axes.normal));
    const double distance = std::hypot(dot(offset, axes.first), dot(offset, axes.second));
    width = std::max(width, distance + static_cast<double>(bound.width) + static_cast<double>(bound.slope) * height);
    slope = std::max(slope, static_cast<double>(bound.slope));
  }
  // Up to here |x's part in the plane| <= width + slope |height|. With the height as the other leg, the triangle
  // inequality makes |x| <= width + sqrt(1 + slope^2) |height| of it.
  return make_column(axes.normal, width, slope);
}

Column enclosing_column(std::span<const Column> children, std::span<const Point> centres, const Point& centre) {
  Point sum{};
  for (const Column& child : children) sum = sum - (dot(child.axis, sum) < 0 ? 1.0 : -1.0) * child.axis;
  const double norm = length(sum);
  if (!(norm > 0)) return {{0, 0, 0}, kInfinity};
  const Point axis = 1 / norm * sum;
  double reach = 0;
  double stretch = 0;
  for (std::size_t i = 0; i < children.size(); ++i) {
    // |x . child.axis| <= cosine |x . axis| + sine |x|, both times the length of child.axis; solved for |x|.
    const double cosine = std::abs(dot(children[i].axis, axis));
    const double rest = 1 - length(cross(children[i].axis, axis));
    if (!(rest > 0) || !(children[i].reach < kInfinity)) return {{0, 0, 0}, kInfinity};
    const Point offset = centres[i] - centre;
    reach = std::max(reach, length(offset) + (children[i].reach + cosine * std::abs(dot(offset, axis))) / rest);
    stretch = std::max(stretch, cosine / rest);
  }
  if (!(stretch <= kLongestAxis)) return {{0, 0, 0}, kInfinity};
  return {stretch * axis, reach};
}

}  // namespace meshhood
