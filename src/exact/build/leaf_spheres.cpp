// SPDX-License-Identifier: MIT
#include "exact/build/leaf_spheres.h"

#include <cstddef>
#include <vector>

namespace meshhood {
namespace {

/// The spheres of `count` leaves; `leaf_at(i)` is the i-th.
template <class LeafAt>
Spheres measure(std::size_t count, LeafAt&& leaf_at, const IndexView& index, TaskContext& task) {
  constexpr std::size_t kGrain = 64;  // enough leaves for the cost of starting a thread
  Spheres result(count);
  task.parallel_for(count, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    std::vector<Point> points;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t leaf = leaf_at(i);
      points.clear();
      for (std::size_t v = index.leaf_begin[leaf]; v < index.leaf_begin[leaf + 1]; ++v) {
        points.push_back(index.in_frame(v));
      }
      if (!points.empty()) result[i] = enclosing_sphere(points);
    }
  });
  return result;
}

}  // namespace

Spheres measure_leaves(std::span<const LeafId> leaves, const IndexView& index, TaskContext& task) {
  return measure(leaves.size(), [&](std::size_t i) { return leaves[i]; }, index, task);
}

Spheres measure_leaves(const IndexView& index, TaskContext& task) {
  return measure(index.leaf_count(), [](std::size_t i) { return i; }, index, task);
}

}  // namespace meshhood
