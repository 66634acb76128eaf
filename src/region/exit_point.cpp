// SPDX-License-Identifier: MIT
#include "region/exit_point.h"

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace meshhood {

// The point inside + t d, with d = outside - inside and e = inside - center, has the distance r from the center where
//   (d.d) t^2 + 2 (d.e) t + (e.e - r^2) = 0.
// The last term is not positive, so there is one root t >= 0. Of its two usual forms, this is the one that adds numbers
// of equal sign. All lengths are first divided by the largest of them, so that no product overflows.
Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius) {
  if (squared_distance(outside, center) <= squared_radius(radius)) return outside;
  const Point d = outside - inside;
  const Point e = inside - center;
  const auto largest = [](const Point& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
  const double unit = std::max({largest(d), largest(e), radius});
  const Point step = (1 / unit) * d;
  const Point offset = (1 / unit) * e;
  const double a = dot(step, step);
  const double b = dot(step, offset);
  const double r = radius / unit;
  const double distance = length(offset);
  const double c = std::min((distance - r) * (distance + r), 0.0);
  const double root = std::sqrt(b * b - a * c);
  const double t = b > 0 ? -c / (b + root) : (root - b) / a;
  return inside + std::clamp(t, 0.0, 1.0) * d;
}

}  // namespace meshhood
