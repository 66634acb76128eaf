// SPDX-License-Identifier: MIT
#include "base/frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace meshhood {
namespace {

struct Box {
  Point low;
  Point high;
};

template <class Real>
Box bounding_box(const StridedPositions<Real>& xyz) {
  Box box{point(xyz, 0), point(xyz, 0)};
  for (std::size_t v = 1; v < xyz.size(); ++v) {
    const Point p = point(xyz, v);
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

/// A power of two by which lengths up to `extent` become at most 1.
double unit_scale(double extent) {
  if (!(extent > 0)) return 1;
  // The bound keeps the scale finite; for a mesh that small the tree is not used.
  return std::ldexp(1.0, std::min(-std::ilogb(extent) - 1, 1000));
}

}  // namespace

Frame make_frame(const PositionsView& positions) {
  if (positions.size() == 0) return {};
  const Box box = positions.visit([](const auto& xyz) { return bounding_box(xyz); });
  assert(box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z);  // so they are numbers
  const Point origin{box.low.x / 2 + box.high.x / 2, box.low.y / 2 + box.high.y / 2, box.low.z / 2 + box.high.z / 2};
  // Measured from the rounded center: half the width of the box may round to less.
  const auto extent = [](double low, double center, double high) { return std::max(center - low, high - center); };
  return {origin, unit_scale(std::max({extent(box.low.x, origin.x, box.high.x), extent(box.low.y, origin.y, box.high.y),
                                       extent(box.low.z, origin.z, box.high.z)}))};
}

}  // namespace meshhood
