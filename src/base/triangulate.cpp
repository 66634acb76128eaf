// SPDX-License-Identifier: MIT
#include "base/triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

struct Flat {
  double x;
  double y;
};

/// Returns twice the signed area of a triangle.
double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_same(const Flat& a, const Flat& b) { return a.x == b.x && a.y == b.y; }

/// Leaves out the axis along which a polygon has its largest area, so that its corners turn left on the whole.
class Flattening {
 public:
  explicit Flattening(std::span<const Point> corners)
      : area_(doubled_vector_area(corners.size(), [&](std::size_t i) { return corners[i]; })) {}

  [[nodiscard]] Flat operator()(const Point& p) const {
    const double x = std::abs(area_.x);
    const double y = std::abs(area_.y);
    const double z = std::abs(area_.z);
    if (z >= x && z >= y) return area_.z < 0 ? Flat{p.y, p.x} : Flat{p.x, p.y};
    if (x >= y) return area_.x < 0 ? Flat{p.z, p.y} : Flat{p.y, p.z};
    return area_.y < 0 ? Flat{p.x, p.z} : Flat{p.z, p.x};
  }

 private:
  Point area_;
};

/// Returns whether the polygon turns right at no corner. Corners in a row at one point count as one, because the turn
/// at each alone is 0.
bool is_convex(std::span<const Point> corners, const Flattening& flat) {
  Flat b = flat(corners.back());
  Flat a = b;
  for (std::size_t i = corners.size() - 1; is_same(a, b) && i-- > 0;) a = flat(corners[i]);
  for (const Point& p : corners) {
    const Flat c = flat(p);
    if (is_same(b, c)) continue;
    if (turn(a, b, c) < 0) return false;
    a = b;
    b = c;
  }
  return true;
}

/// Cuts ears off a polygon; what is left is a ring of corners.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Flat> corners)
      : corners_(std::move(corners)), next_(corners_.size()), previous_(corners_.size()) {
    const auto size = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      next_[i] = (i + 1) % size;
      previous_[next_[i]] = i;
    }
    for (std::uint32_t i = 0; i < size; ++i) {
      if (turn_at(i) <= 0) blunt_.push_back(i);
    }
  }

  void run(Triangulation& out) {
    std::uint32_t corner = 0;
    for (std::size_t left = corners_.size(); left > 3; --left) {
      corner = find_ear(corner, left);
      out.push_back({previous_[corner], corner, next_[corner]});
      cut(corner);
      corner = next_[next_[corner]];  // else the triangles might all meet at one corner
    }
    out.push_back({previous_[corner], corner, next_[corner]});
  }

 private:
  [[nodiscard]] double turn_at(std::uint32_t i) const {
    return turn(corners_[previous_[i]], corners_[i], corners_[next_[i]]);
  }

  /// Returns an ear from `begin` on. If a polygon that crosses itself has none, returns a corner at which it does not
  /// turn, or `begin`.
  [[nodiscard]] std::uint32_t find_ear(std::uint32_t begin, std::size_t left) const {
    std::uint32_t straight = begin;
    for (std::uint32_t i = begin; left != 0; i = next_[i], --left) {
      if (is_ear(i)) return i;
      if (turn_at(i) == 0) straight = i;
    }
    return straight;
  }

  [[nodiscard]] bool is_ear(std::uint32_t i) const {
    const Flat& a = corners_[previous_[i]];
    const Flat& b = corners_[i];
    const Flat& c = corners_[next_[i]];
    if (!(turn(a, b, c) > 0)) return false;
    return std::ranges::none_of(blunt_, [&](std::uint32_t other) {
      const Flat& p = corners_[other];
      if (is_same(p, a) || is_same(p, b) || is_same(p, c)) return false;
      return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  void cut(std::uint32_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    std::erase_if(blunt_, [&](std::uint32_t other) {
      if (other == i) return true;
      return (other == previous_[i] || other == next_[i]) && turn_at(other) > 0;
    });
  }

  std::vector<Flat> corners_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> blunt_;  // the corners at which it does not turn left: only these can lie in an ear
};

}  // namespace

void triangulate(std::span<const Point> corners, Triangulation& out) {
  out.clear();
  if (corners.size() < 3) return;
  if (corners.size() > 3) {
    const Flattening flat(corners);
    if (!is_convex(corners, flat)) {
      std::vector<Flat> all(corners.size());
      std::ranges::transform(corners, all.begin(), flat);
      return EarClipper(std::move(all)).run(out);
    }
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) out.push_back({0, i, i + 1});
}

}  // namespace meshhood::inline v0_1
