// SPDX-License-Identifier: MIT
#include "exact/build/leaf_spheres.h"

#include <array>
#include <cstddef>
#include <span>
#include <variant>

namespace meshhood {
namespace {

/// The spheres of `count` leaves; `leaf_at(i)` is the i-th.
template <class LeafAt>
Spheres measure(std::size_t count, LeafAt&& leaf_at, const IndexView& index, TaskContext& task) {
  constexpr std::size_t kGrain = 64;  // enough that passing them to a thread costs little
  Spheres result(count);
  task.parallel_for(count, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    std::visit(
        [&](auto xyz) {
          std::array<Point, kLeafCapacity> points;
          for (std::size_t i = begin; i < end; ++i) {
            const std::size_t first = index.leaf_begin[leaf_at(i)];
            const std::size_t size = index.leaf_begin[leaf_at(i) + 1] - first;
            for (std::size_t lane = 0; lane < size; ++lane)
              points[lane] = index.frame.to_frame(point(xyz, first + lane));
            if (size > 0) result[i] = enclosing_sphere(std::span(points).first(size));
          }
        },
        index.positions);
  });
  return result;
}

}  // namespace

Spheres measure_leaves(std::span<const LeafId> leaves, const IndexView& index, TaskContext& task) {
  return measure(leaves.size(), [&](std::size_t i) { return std::size_t{leaves[i]}; }, index, task);
}

Spheres measure_leaves(const IndexView& index, TaskContext& task) {
  return measure(index.leaf_count(), [](std::size_t i) { return i; }, index, task);
}

}  // namespace meshhood
