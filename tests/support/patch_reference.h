// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace meshhood::test {

/// The patch of a ball as its definition says it: a search in breadth over triangles, and closed forms for each. Shares
/// no code with the library.
template <class Real>
class PatchReference {
 public:
  using Vector = std::array<Real, 3>;
  using Triangle = std::array<std::uint32_t, 3>;

  struct Answer {
    std::vector<std::size_t> faces;
    double area = 0;
    double volume = 0;
    double gap = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;  // the face of the gap
  };

  /// positions  #V by 3.
  /// owners     for side i of each triangle, from corner i: the number of the polygon whose diagonal it is, from 1 on,
  ///            or 0 for a side that all polygons share.
  PatchReference(const std::vector<double>& positions, std::vector<Triangle> triangles, std::vector<Triangle> owners)
      : triangles_(std::move(triangles)), owners_(std::move(owners)), faces_of_vertex_(positions.size() / 3) {
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      points_.push_back({Real(positions[3 * v]), Real(positions[3 * v + 1]), Real(positions[3 * v + 2])});
    }
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = side(f, i);
        faces_of_vertex_[a].push_back(f);
        faces_of_side_[key(f, i)].push_back(f);
        if (a != b) at_sides_[key(f, i)].add(a < b, triangles_[f][(i + 2) % 3]);
      }
    }
  }

  [[nodiscard]] Answer around_vertex(std::uint32_t v, Real radius) const {
    Answer answer = measure(v, radius);
    find_gap(points_[v], radius, answer);
    return answer;
  }

  [[nodiscard]] Answer around_point(const Vector& center, std::size_t face, Real radius) const {
    Answer answer = run(center, {face}, radius);
    find_gap(center, radius, answer);
    return answer;
  }

  /// Without the gap.
  [[nodiscard]] Answer measure(std::uint32_t v, Real radius) const {
    return run(points_[v], faces_of_vertex_[v], radius);
  }

  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Vector plus(const Vector& a, Real s, const Vector& b) {
    return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
  }
  static Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Real length(const Vector& a) { return std::sqrt(dot(a, a)); }

 private:
  static constexpr Real kPi = std::numbers::pi_v<Real>;

  /// What the rim of a patch adds up to.
  struct Sums {
    Real area = 0;
    Real moment = 0;  // of distance times area
    Real solid = 0;   // minus the solid angle behind the patch, modulo 4 pi
    bool has_rim = false;
  };

  /// The triangles at a side, by their directions there and their third corners.
  struct AtSide {
    int balance = 0;
    std::set<std::pair<bool, std::uint32_t>> ways;
    bool has_one_twice = false;

    void add(bool ascends, std::uint32_t third) {
      balance += ascends ? 1 : -1;
      has_one_twice |= !ways.emplace(ascends, third).second;
    }

    [[nodiscard]] bool is_border() const { return balance != 0 || has_one_twice; }
  };

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> side(std::size_t f, std::size_t i) const {
    return {triangles_[f][i], triangles_[f][(i + 1) % 3]};
  }

  /// The ends of a side in ascending order, and its owner.
  [[nodiscard]] Triangle key(std::size_t f, std::size_t i) const {
    const auto [a, b] = side(f, i);
    return {std::min(a, b), std::max(a, b), owners_[f][i]};
  }

  static Real distance_of_segment(const Vector& a, const Vector& b) {
    const Vector e = minus(b, a);
    const Real square = dot(e, e);
    const Real t = square > 0 ? std::clamp<Real>(-dot(a, e) / square, 0, 1) : 0;
    return length(plus(a, t, e));
  }

  /// From the origin.
  static Real distance_of_triangle(const std::array<Vector, 3>& p) {
    Real best = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < 3; ++i) best = std::min(best, distance_of_segment(p[i], p[(i + 1) % 3]));
    const Vector normal = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    const Real size = length(normal);
    if (size == 0) return best;
    bool is_over = true;
    for (std::size_t i = 0; i < 3; ++i) {
      is_over &= dot(cross(minus(p[(i + 1) % 3], p[i]), plus({0, 0, 0}, -1, p[i])), normal) > 0;
    }
    return is_over ? std::min(best, std::abs(dot(normal, p[0])) / size) : best;
  }

  [[nodiscard]] std::array<Vector, 3> relative(std::size_t f, const Vector& center) const {
    std::array<Vector, 3> p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = minus(points_[triangles_[f][i]], center);
    return p;
  }

  [[nodiscard]] Answer run(const Vector& center, std::vector<std::size_t> queue, Real radius) const {
    std::vector<char> seen(triangles_.size(), 0);
    for (const std::size_t f : queue) seen[f] = 1;
    std::sort(queue.begin(), queue.end());
    queue.erase(std::unique(queue.begin(), queue.end()), queue.end());
    bool has_border = false;
    Real farthest = 0;  // of the corners
    Sums sums;
    const auto push = [&](const std::vector<std::size_t>& faces) {
      for (const std::size_t f : faces) {
        if (std::exchange(seen[f], 1) == 0) queue.push_back(f);
      }
    };
    // NOLINTNEXTLINE(modernize-loop-convert): the queue grows meanwhile
    for (std::size_t next = 0; next < queue.size(); ++next) {
      const std::size_t f = queue[next];
      const auto p = relative(f, center);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = side(f, i);
        farthest = std::max(farthest, length(p[i]));
        if (length(p[i]) <= radius) push(faces_of_vertex_[a]);
        if (distance_of_segment(p[i], p[(i + 1) % 3]) > radius) continue;
        push(faces_of_side_.at(key(f, i)));
        has_border |= a != b && at_sides_.at(key(f, i)).is_border();
      }
      if (radius > 0) add(p, radius, sums);
    }
    Answer answer;
    answer.faces = queue;
    std::sort(answer.faces.begin(), answer.faces.end());
    answer.area = static_cast<double>(sums.area);
    const Real sphere = 4 * kPi;
    const Real solid = sums.has_rim ? -sums.solid - sphere * std::floor(Real(1e-14) - sums.solid / sphere) : 0;
    Real tripled = sums.moment + radius * radius * radius * solid;
    const Real ball = radius * radius * radius * sphere;
    const Real slack = Real(0x1p-40) * sums.area * std::min(radius, farthest);
    if (std::abs(tripled) > ball + slack) tripled = std::fmod(tripled, ball);
    if (tripled < -slack) tripled += ball;
    answer.volume = has_border ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(tripled / 3);
    return answer;
  }

  void find_gap(const Vector& center, Real radius, Answer& answer) const {
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      if (std::ranges::binary_search(answer.faces, f)) continue;
      const Real distance = distance_of_triangle(relative(f, center));
      if (distance > radius || static_cast<double>(distance) >= answer.gap) continue;
      answer.gap = static_cast<double>(distance);
      answer.nearest = f;
    }
  }

  /// The signed area of the spherical triangle of three unit vectors.
  static Real spherical(const Vector& a, const Vector& b, const Vector& c) {
    return 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }

  /// Adds what a triangle has in the ball around the origin.
  static void add(const std::array<Vector, 3>& p, Real r, Sums& sums) {
    Vector n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    const Real doubled = length(n);
    if (doubled == 0) return;
    n = plus({0, 0, 0}, 1 / doubled, n);
    const Real d = dot(n, p[0]);
    if (std::all_of(p.begin(), p.end(), [&](const Vector& q) { return length(q) <= r; })) {
      sums.area += doubled / 2;
      sums.moment += d * doubled / 2;
      return;
    }
    const Real disc = std::sqrt(std::max<Real>(0, r * r - d * d));
    const Vector foot = plus({0, 0, 0}, d, n);
    const auto angle = [&](const Vector& x, const Vector& y) {
      return std::atan2(dot(n, cross(minus(x, foot), minus(y, foot))), dot(minus(x, foot), minus(y, foot)));
    };
    Real area = 0;
    std::vector<std::pair<Vector, Vector>> chords;  // the parts of the sides in the disc
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector a = p[i];
      const Vector e = minus(p[(i + 1) % 3], a);
      const Real middle = -dot(a, e) / dot(e, e);
      const Vector nearest = plus(a, middle, e);
      const Real square = r * r - dot(nearest, nearest);
      const Real half = square > 0 ? std::sqrt(square / dot(e, e)) : 0;
      const Real from = std::clamp<Real>(middle - half, 0, 1);
      const Real to = std::clamp<Real>(middle + half, 0, 1);
      const auto at = [&](Real t) { return plus(a, t, e); };
      if (from >= to) {
        area += disc * disc / 2 * angle(a, at(1));
        continue;
      }
      area += disc * disc / 2 * (from > 0 ? angle(a, at(from)) : 0);
      area += dot(n, cross(minus(at(from), foot), minus(at(to), foot))) / 2;
      area += disc * disc / 2 * (to < 1 ? angle(at(to), at(1)) : 0);
      chords.emplace_back(at(from), at(to));
    }
    sums.area += area;
    sums.moment += d * area;
    const Real h = d / r;
    if (chords.empty()) {
      if (area > kPi * disc * disc / 2) sums.solid += 2 * kPi * (1 - h);
      sums.has_rim |= area > kPi * disc * disc / 2;
      return;
    }
    sums.has_rim = true;
    const Vector k{Real(9) / 25, Real(12) / 25, Real(4) / 5};
    for (std::size_t i = 0; i < chords.size(); ++i) {
      const Vector& x = chords[i].second;
      const Vector& y = chords[(i + 1) % chords.size()].first;
      if (length(minus(x, y)) < Real(1e-14) * r) continue;  // a corner in the disc
      Real theta = angle(x, y);
      if (theta < 0) theta += 2 * kPi;
      // In parts, so that no two ends are opposite.
      const auto turned = [&](Real share) {
        const Vector from = minus(x, foot);
        const Vector around = plus(foot, std::cos(share * theta), from);
        return plus({0, 0, 0}, 1 / r, plus(around, std::sin(share * theta), cross(n, from)));
      };
      sums.solid += theta * (1 - h);
      for (int part = 0; part < 4; ++part) {
        const Vector u = turned(Real(part) / 4);
        const Vector w = part == 3 ? plus({0, 0, 0}, 1 / r, y) : turned(Real(part + 1) / 4);
        sums.solid += spherical(k, u, w) - spherical(n, u, w);
      }
    }
  }

  std::vector<Vector> points_;
  std::vector<Triangle> triangles_;
  std::vector<Triangle> owners_;
  std::vector<std::vector<std::size_t>> faces_of_vertex_;
  std::map<Triangle, std::vector<std::size_t>> faces_of_side_;
  std::map<Triangle, AtSide> at_sides_;
};

}  // namespace meshhood::test
