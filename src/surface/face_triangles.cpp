// SPDX-License-Identifier: MIT
#include "surface/face_triangles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/lists.h"
#include "base/vector.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

std::uint32_t first_place(const IndexView& index, std::span<const VertexId> corners) {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  for (const VertexId v : corners) first = std::min(first, index.place(v));
  return first;
}

}  // namespace

void Triangulator::run(std::uint32_t face, std::span<const VertexId> corners, Triangle* out) {
  points_.clear();
  for (const VertexId v : corners) points_.push_back(index_->frame.scale * index_->position(index_->place(v)));
  triangulate(points_, triangles_);
  for (const auto& [a, b, c] : triangles_) {
    const auto is_diagonal = [&](std::size_t i, std::size_t j) {
      return static_cast<unsigned>((i + 1) % corners.size() != j && (j + 1) % corners.size() != i);
    };
    *out++ = {{index_->place(corners[a]), index_->place(corners[b]), index_->place(corners[c])},
              face,
              is_diagonal(a, b) | is_diagonal(b, c) << 1U | is_diagonal(c, a) << 2U};
  }
}

Lists<Triangle, std::size_t> triangles_of_leaves(const IndexView& index, const StoredFaces& faces, TaskContext& task) {
  constexpr std::size_t kLeavesOfTask = 32;
  std::size_t count = 0;
  for (std::size_t face = 0; face < faces.size(); ++face) count += triangle_count(faces[face].size());
  check_triangle_count(count);
  const auto is_wall = [&](VertexId v) { return index.is_wall_at(index.place(v)); };
  const auto by_first_place = gather_lists<std::uint32_t, std::size_t>(index.vertex_count(), [&](auto&& f) {
    for (std::size_t face = faces.size(); face-- > 0;) {
      if (faces[face].size() < 3 || std::ranges::any_of(faces[face], is_wall)) continue;
      f(first_place(index, faces[face]), static_cast<std::uint32_t>(face));
    }
  });
  const auto faces_from = [&](std::size_t begin, std::size_t end) {
    const auto first_of = [&](std::size_t leaf) { return by_first_place.offsets[index.leaf_begin[leaf]]; };
    return std::span(by_first_place.elements).subspan(first_of(begin), first_of(end) - first_of(begin));
  };
  Lists<Triangle, std::size_t> triangles;
  count = 0;
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    for (const std::uint32_t face : faces_from(leaf, leaf + 1)) count += triangle_count(faces[face].size());
    triangles.offsets.push_back(count);
  }
  triangles.elements.resize(count);
  task.parallel_for(index.leaf_count(), kLeavesOfTask, [&](unsigned, std::size_t begin, std::size_t end) {
    Triangulator triangulator(index);
    Triangle* next = triangles.elements.data() + triangles.offsets[begin];
    for (const std::uint32_t face : faces_from(begin, end)) {
      triangulator.run(face, faces[face], next);
      next += triangle_count(faces[face].size());
    }
  });
  return triangles;
}

std::array<Point, 3> corners_of(const IndexView& index, const std::array<std::uint32_t, 3>& places) {
  return std::visit(
      [&](auto xyz) { return std::array{point(xyz, places[0]), point(xyz, places[1]), point(xyz, places[2])}; },
      index.positions);
}

SurfacePoint surface_point(const IndexView& index, const StoredFaces& faces, std::size_t face,
                           const std::array<std::uint32_t, 3>& places, const TrianglePoint& found) {
  const std::span<const VertexId> all = faces[face];
  SurfacePoint result{face, {}, {}, found.barycentric, {found.point.x, found.point.y, found.point.z}, found.distance};
  for (std::size_t i = 0; i < 3; ++i) {
    result.vertices[i] = index.id(places[i]);
    result.corners[i] = static_cast<std::size_t>(std::ranges::find(all, result.vertices[i]) - all.begin());
  }
  return result;
}

namespace {

class Candidates {
 public:
  Candidates(const Point& q, const std::array<Point, 3>& corners, double scale) : corners_(&corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      from_q_[i] = corners[i] - q;
      scaled_[i] = scale * from_q_[i];
      sides_[i] = scale * (corners[(i + 1) % 3] - corners[i]);
    }
  }

  TrianglePoint best() {
    for (std::size_t i = 0; i < 3; ++i) offer_side(i, (i + 1) % 3);
    offer_inside();
    return best_;
  }

 private:
  /// Offers the nearest point of a side, seen from the same end by all triangles that have it.
  void offer_side(std::size_t i, std::size_t j) {
    if (is_before((*corners_)[j], (*corners_)[i])) std::swap(i, j);
    const double share = share_of_side(scaled_[i], scaled_[j]);
    std::array<double, 3> weights{};
    if (share == 0 || share == 1) {
      const std::size_t end = share == 0 ? i : j;
      weights[end] = 1;
      offer(weights, (*corners_)[end], from_q_[end]);
      return;
    }
    weights[i] = 1 - share;
    weights[j] = share;
    const Point side = share * ((*corners_)[j] - (*corners_)[i]);
    offer(weights, (*corners_)[i] + side, from_q_[i] + side);
  }

  /// Offers the foot of the perpendicular, if it lies in the triangle: its share of the height over the longest side,
  /// then its share of this side.
  ///
  /// Let L be the longest side, w the height over it, h the distance of `q` from the plane, and e = 2^-53. `height` is
  /// a difference of vectors of length L: rounding tilts it out of the plane by eL/w. The second step makes it
  /// orthogonal to the side. So the foot is off across by d = eL(1 + h/w), or else lies outside, d > w; along the side
  /// it is right to eL. Where h < w, d < 2eL. Beyond, the distance is off by d^2/2h < eL. A normal would move it along
  /// by eL^2/w.
  void offer_inside() {
    const std::size_t i = longest(sides_);
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const Point side = sides_[i];
    const double square = dot(side, side);
    if (square == 0) return;
    const auto without_side = [&](const Point& p) { return p - (dot(p, side) / square) * side; };
    const auto across = [&](const Point& p) { return without_side(without_side(p)); };
    const Point third = -1.0 * sides_[k];
    const Point height = across(third);
    const double square_of_height = dot(height, height);
    if (square_of_height == 0) return;
    const Point to_q = -1.0 * scaled_[i];
    std::array<double, 3> weights{};
    weights[k] = dot(height, across(to_q)) / square_of_height;
    weights[j] = dot(side, to_q - weights[k] * third) / square;
    if (!(weights[j] > 0 && weights[k] > 0 && weights[j] + weights[k] < 1)) return;
    weights[i] = std::max((1 - weights[j]) - weights[k], 0.0);
    const auto from_i = [&](std::size_t corner) { return weights[corner] * ((*corners_)[corner] - (*corners_)[i]); };
    const Point offset = from_i(j) + from_i(k);
    offer(weights, (*corners_)[i] + offset, from_q_[i] + offset);
  }

  void offer(const std::array<double, 3>& weights, const Point& point, const Point& offset) {
    const double distance = length(offset);
    if (has_one_ && !(distance < best_.distance)) return;
    has_one_ = true;
    best_ = {weights, point, distance};
  }

  const std::array<Point, 3>* corners_;
  std::array<Point, 3> from_q_;
  std::array<Point, 3> scaled_;  // the same in units of the frame
  std::array<Point, 3> sides_;
  TrianglePoint best_{};
  bool has_one_ = false;
};

/// Returns 0 where squares of lengths underflow.
double share_of(double part, double whole) { return whole > 0 ? part / whole : 0; }

/// Returns the point of a triangle nearest to the origin, by the regions of Ericson, "Real-Time Collision Detection"
/// (2005), sec. 5.1.5. For slivers it may be another point of the triangle, or NaN.
Point roughly_nearest(const std::array<Point, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Point ab = b - a;
  const Point ac = c - a;
  const double d1 = -dot(ab, a);
  const double d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -dot(ab, b);
  const double d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + share_of(d1, d1 - d3) * ab;
  const double d5 = -dot(ab, c);
  const double d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + share_of(d2, d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + share_of(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b);
  // Rounding may bring several of them below 0.
  if (!(va >= 0 && vb >= 0 && vc >= 0)) return a;
  const double share = share_of(1, va + vb + vc);
  return a + (vb * share) * ab + (vc * share) * ac;
}

}  // namespace

void raise_no_such_face(std::size_t face, std::size_t faces, const std::string& where) {
  raise(ErrorCode::InvalidOption,
        where + "face " + std::to_string(face) + ", expected one of the mesh, which has " + std::to_string(faces));
}

double share_of_side(const Point& a, const Point& b) {
  const Point side = b - a;
  const double square = dot(side, side);
  if (square == 0) return 0;
  const double share = -dot(a, side) / square;
  return share > 0 ? std::min(share, 1.0) : 0;  // a NaN becomes 0
}

std::size_t longest(const std::array<Point, 3>& sides) {
  const auto by_length = [](const Point& a, const Point& b) { return dot(a, a) < dot(b, b); };
  return static_cast<std::size_t>(std::max_element(sides.begin(), sides.end(), by_length) - sides.begin());
}

RoughDistance compare_roughly(const std::array<Point, 3>& corners, const Point& q) {
  const std::array<Point, 3> from_q{corners[0] - q, corners[1] - q, corners[2] - q};
  const Point nearest = roughly_nearest(from_q);
  const double along = std::min({dot(nearest, from_q[0]), dot(nearest, from_q[1]), dot(nearest, from_q[2])});
  const double square = dot(nearest, nearest);
  return {square, along > 0 ? along * share_of(along, square) : 0};  // the square of a product might overflow
}

TrianglePoint nearest_in_triangle(const Point& q, const std::array<Point, 3>& corners, double scale) {
  return Candidates(q, corners, scale).best();
}

}  // namespace meshhood::inline v0_1
