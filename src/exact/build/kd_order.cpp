// SPDX-License-Identifier: MIT
#include "exact/build/kd_order.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "exact/build/nth_element.h"

namespace meshhood {
namespace {

std::size_t widest_axis(std::span<const KdPoint> points) {
  std::array<float, 3> low = points[0].at;
  std::array<float, 3> high = low;
  for (const KdPoint& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p.at[axis]);
      high[axis] = std::max(high[axis], p.at[axis]);
    }
  }
  const std::array<float, 3> width = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  return static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
}

template <std::size_t Axis>
void cut_at(std::span<KdPoint> points, std::size_t middle) {
  nth_element(points, middle, [](const KdPoint& a, const KdPoint& b) {
    return a.at[Axis] != b.at[Axis] ? a.at[Axis] < b.at[Axis] : a.id < b.id;
  });
}

/// Cuts across the widest side and returns the size of the first part.
std::size_t cut(std::span<KdPoint> points, std::size_t unit) {
  const std::size_t units = (points.size() + unit - 1) / unit;
  assert(unit > 0 && points.size() > unit);
  const std::size_t middle = units / 2 * unit;
  switch (widest_axis(points)) {
    case 0: cut_at<0>(points, middle); break;
    case 1: cut_at<1>(points, middle); break;
    default: cut_at<2>(points, middle); break;
  }
  return middle;
}

using Runs = std::vector<std::span<KdPoint>>;

/// Cuts each run in two; a run of at most `unit` points is the second half of its own.
Runs cut_each(const Runs& runs, std::size_t unit, TaskContext& task) {
  Runs halves(2 * runs.size());
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) {
    const std::size_t middle = runs[i].size() > unit ? cut(runs[i], unit) : 0;
    halves[2 * i] = runs[i].first(middle);
    halves[2 * i + 1] = runs[i].subspan(middle);
  });
  return halves;
}

}  // namespace

void kd_order(std::span<KdPoint> points, std::size_t unit) {
  while (points.size() > unit) {
    const std::size_t middle = cut(points, unit);
    kd_order(points.first(middle), unit);
    points = points.subspan(middle);
  }
}

void kd_order(std::span<KdPoint> points, std::size_t unit, TaskContext& task) {
  // Several runs a thread, so that all threads end at about the same time; but none so short that starting it costs
  // more than cutting it.
  constexpr std::size_t kRunsPerThread = 8;
  constexpr std::size_t kShortestRun = 2000;
  Runs runs{points};
  while (runs.size() < kRunsPerThread * task.threads() && points.size() / runs.size() > kShortestRun) {
    runs = cut_each(runs, unit, task);
  }
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) { kd_order(runs[i], unit); });
}

void kd_order_nested(std::span<KdPoint> points, std::size_t fan_out) {
  if (points.size() <= fan_out) return;
  std::size_t unit = fan_out;
  while (unit * fan_out < points.size()) unit *= fan_out;
  kd_order(points, unit);
  for (std::size_t begin = 0; begin < points.size(); begin += unit) {
    kd_order_nested(points.subspan(begin, std::min(unit, points.size() - begin)), fan_out);
  }
}

}  // namespace meshhood
