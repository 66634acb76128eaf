// SPDX-License-Identifier: MIT
// Each cut counts the points in equal intervals of the widest side, which tells where each third of the result begins:
// the intervals before the one with the cut, that interval, and those after it. Then it moves the points there, from
// one array into another, and divides the one interval with `std::nth_element`. Both passes are without branches.
#include "exact/build/kd_order.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace meshhood {
namespace {

struct PointBox {
  std::array<float, 3> low;
  std::array<float, 3> high;

  [[nodiscard]] std::size_t widest_axis() const {
    const std::array<float, 3> width = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    return static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
  }
};

PointBox box_of(std::span<const KdPoint> points) {
  PointBox box{points[0].at, points[0].at};
  for (const KdPoint& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p.at[axis]);
      box.high[axis] = std::max(box.high[axis], p.at[axis]);
    }
  }
  return box;
}

/// Equal intervals of a side of a box, fewer if it is nearly 0 long. Their numbers ascend with the coordinate.
class Intervals {
 public:
  static constexpr std::size_t kMost = 1024;

  Intervals(float low, float high, std::size_t points)
      : count_(std::clamp<std::size_t>(points / 4, 2, kMost)),
        low_(low),
        per_unit_(low < high ? std::min(static_cast<float>(count_) / (high - low), std::numeric_limits<float>::max())
                             : 0) {}

  [[nodiscard]] std::size_t count() const { return count_; }

  [[nodiscard]] std::size_t operator()(float coordinate) const {
    const auto interval = static_cast<std::int32_t>((coordinate - low_) * per_unit_);
    return std::min(static_cast<std::size_t>(interval), count_ - 1);
  }

 private:
  std::size_t count_;
  float low_;
  float per_unit_;
};

template <std::size_t Axis>
bool precedes(const KdPoint& a, const KdPoint& b) {
  return a.at[Axis] != b.at[Axis] ? a.at[Axis] < b.at[Axis] : a.id < b.id;
}

/// Copies `points` to `to`, the `middle` first ones along the axis before the others.
template <std::size_t Axis>
void cut_across(std::span<const KdPoint> points, const PointBox& box, std::size_t middle, std::span<KdPoint> to) {
  const Intervals intervals(box.low[Axis], box.high[Axis], points.size());
  std::array<std::uint32_t, Intervals::kMost> counts;
  std::fill_n(counts.begin(), intervals.count(), 0);
  for (const KdPoint& p : points) ++counts[intervals(p.at[Axis])];
  std::size_t cut = 0;
  std::size_t before = 0;
  while (before + counts[cut] <= middle) before += counts[cut++];
  const std::size_t within = counts[cut];
  std::array<KdPoint*, 3> next = {to.data(), to.data() + before, to.data() + before + within};
  for (const KdPoint& p : points) {
    const std::size_t interval = intervals(p.at[Axis]);
    *next[std::size_t{interval >= cut} + std::size_t{interval > cut}]++ = p;
  }
  const auto first = to.begin() + static_cast<std::ptrdiff_t>(before);
  std::nth_element(first, to.begin() + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(within),
                   precedes<Axis>);
}

/// Copies `points` to `to`, cut across the widest side of their box, and returns the size of the first part.
std::size_t cut(std::span<const KdPoint> points, std::size_t unit, std::span<KdPoint> to) {
  const std::size_t units = (points.size() + unit - 1) / unit;
  assert(unit > 0 && points.size() > unit);
  const std::size_t middle = units / 2 * unit;
  const PointBox box = box_of(points);
  switch (box.widest_axis()) {
    case 0: cut_across<0>(points, box, middle, to); break;
    case 1: cut_across<1>(points, box, middle, to); break;
    default: cut_across<2>(points, box, middle, to); break;
  }
  return middle;
}

/// Copies at most a few dozen points to `to`, ascending by id: the place of each is the number of smaller ids.
void copy_by_id(std::span<const KdPoint> points, std::span<KdPoint> to) {
  constexpr std::size_t kMost = 32;
  if (points.size() > kMost) {
    std::copy(points.begin(), points.end(), to.begin());
    std::sort(to.begin(), to.end(), [](const KdPoint& a, const KdPoint& b) { return a.id < b.id; });
    return;
  }
  std::array<std::uint32_t, kMost> ids;
  ids.fill(std::numeric_limits<std::uint32_t>::max());
  for (std::size_t i = 0; i < points.size(); ++i) ids[i] = points[i].id;
  for (const KdPoint& p : points) {
    std::uint32_t smaller = 0;
    for (const std::uint32_t id : ids) smaller += id < p.id ? 1U : 0U;
    to[smaller] = p;
  }
}

/// Points in one of two arrays of equal size; each cut moves them to the other.
struct PointRun {
  std::span<KdPoint> points;
  std::span<KdPoint> other;

  [[nodiscard]] std::size_t size() const { return points.size(); }
  [[nodiscard]] PointRun part(std::size_t begin, std::size_t count) const {
    return {points.subspan(begin, count), other.subspan(begin, count)};
  }
  [[nodiscard]] PointRun swapped() const { return {other, points}; }
};

/// Orders a run. The result is in the other array if `moves` is set.
void order(const PointRun& run, std::size_t unit, bool moves) {
  if (run.size() > unit) {
    const std::size_t middle = cut(run.points, unit, run.other);
    order(run.part(0, middle).swapped(), unit, !moves);
    order(run.part(middle, run.size() - middle).swapped(), unit, !moves);
  } else if (moves) {
    copy_by_id(run.points, run.other);
  } else {
    std::copy(run.points.begin(), run.points.end(), run.other.begin());
    copy_by_id(run.other, run.points);
  }
}

/// Cuts each run in two; a run of at most `unit` points is the second half of its own.
std::vector<PointRun> cut_each(const std::vector<PointRun>& runs, std::size_t unit, TaskContext& task) {
  std::vector<PointRun> halves(2 * runs.size());
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) {
    const PointRun& run = runs[i];
    std::size_t middle = 0;
    if (run.size() > unit) {
      middle = cut(run.points, unit, run.other);
    } else {
      std::copy(run.points.begin(), run.points.end(), run.other.begin());
    }
    halves[2 * i] = run.part(0, middle).swapped();
    halves[2 * i + 1] = run.part(middle, run.size() - middle).swapped();
  });
  return halves;
}

}  // namespace

void kd_order(std::span<KdPoint> points, std::size_t unit, TaskContext& task) {
  // Several runs a thread, so that all threads end at about the same time; but none so short that starting it costs
  // more than cutting it.
  constexpr std::size_t kRunsPerThread = 8;
  constexpr std::size_t kShortestRun = 2000;
  const auto other = std::make_unique_for_overwrite<KdPoint[]>(points.size());  // NOLINT(modernize-avoid-c-arrays)
  std::vector<PointRun> runs{{points, {other.get(), points.size()}}};
  bool moves = false;
  while (runs.size() < kRunsPerThread * task.threads() && points.size() / runs.size() > kShortestRun) {
    runs = cut_each(runs, unit, task);
    moves = !moves;
  }
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) { order(runs[i], unit, moves); });
}

void kd_order(std::span<KdPoint> points, std::size_t unit) {
  TaskContext task;
  kd_order(points, unit, task);
}

}  // namespace meshhood
