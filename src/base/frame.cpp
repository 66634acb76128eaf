// SPDX-License-Identifier: MIT
#include "base/frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "shared/parallel.h"

namespace meshhood::inline v0_1 {
namespace {

template <class Real>
BoundingBox bounding_box(const StridedPositions<Real>& xyz, TaskContext& task) {
  constexpr std::size_t kGrain = 8192;  // a chunk of this size takes much longer than passing it to a thread
  std::vector<BoundingBox> boxes((xyz.size() + kGrain - 1) / kGrain);
  task.parallel_for(xyz.size(), kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    BoundingBox box;
    for (std::size_t v = begin; v < end; ++v) box.add(point(xyz, v));
    boxes[begin / kGrain] = box;
  });
  for (const BoundingBox& box : boxes) boxes.front().add(box);
  return boxes.front();
}

/// Returns a power of two by which lengths up to `extent` become at most 1.
double unit_scale(double extent) {
  if (!(extent > 0)) return 1;
  // The bound keeps the scale finite; for a mesh that small the tree is not used.
  return std::ldexp(1.0, std::min(-std::ilogb(extent) - 1, 1000));
}

}  // namespace

Frame make_frame(const PositionsView& positions) {
  TaskContext task;
  return make_frame(positions, task);
}

Frame make_frame(const PositionsView& positions, TaskContext& task) {
  if (positions.size() == 0) return {};
  const BoundingBox box = positions.visit([&](const auto& xyz) { return bounding_box(xyz, task); });
  assert(box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z);  // this also excludes NaN
  const Point origin{box.low.x / 2 + box.high.x / 2, box.low.y / 2 + box.high.y / 2, box.low.z / 2 + box.high.z / 2};
  // The extent is measured from the rounded center, because half the width of the box may round to less.
  const auto extent = [](double low, double center, double high) { return std::max(center - low, high - center); };
  return {origin, unit_scale(std::max({extent(box.low.x, origin.x, box.high.x), extent(box.low.y, origin.y, box.high.y),
                                       extent(box.low.z, origin.z, box.high.z)}))};
}

}  // namespace meshhood::inline v0_1
