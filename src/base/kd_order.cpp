// SPDX-License-Identifier: MIT
// Each cut counts the points in equal intervals of the widest side, which tells where each third of the result begins:
// the intervals before the one with the cut, that interval, and those after it. Then it moves the points there, from
// one array into another, and divides the one interval with `std::nth_element`. Both passes are without branches, and
// several threads can share them by chunks of the points.
#include "base/kd_order.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {
namespace {

struct Cuts {
  std::size_t unit;
  KdCut where;

  /// Returns the size of the first part of `points` points; `points` > `unit`.
  [[nodiscard]] std::size_t operator()(std::size_t points) const {
    const std::size_t units = (points + unit - 1) / unit;
    return unit * (where == KdCut::Middle ? units / 2 : std::bit_floor(units - 1));
  }
};

struct PointBox {
  std::array<float, 3> low;
  std::array<float, 3> high;

  [[nodiscard]] std::size_t widest_axis() const {
    const std::array<float, 3> width = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    return static_cast<std::size_t>(std::max_element(width.begin(), width.end()) - width.begin());
  }

  void extend(const PointBox& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
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

/// Divides a side of a box into equal intervals, fewer if it is nearly 0 long. Their numbers ascend with the
/// coordinate.
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

/// Consecutive points of a run, which one thread measures, counts and moves.
struct Chunk {
  std::span<const KdPoint> points;
  PointBox box;
  std::array<std::uint32_t, Intervals::kMost> counts;  // by interval
  std::array<KdPoint*, 3> next;                        // by third of the result: the place of the next point

  template <std::size_t Axis>
  void count(const Intervals& intervals) {
    std::fill_n(counts.begin(), intervals.count(), 0);
    for (const KdPoint& p : points) ++counts[intervals(p.at[Axis])];
  }

  template <std::size_t Axis>
  void move(const Intervals& intervals, std::size_t cut) {
    for (const KdPoint& p : points) {
      const std::size_t interval = intervals(p.at[Axis]);
      *next[std::size_t{interval >= cut} + std::size_t{interval > cut}]++ = p;
    }
  }
};

/// Calls `f` for each chunk, on several threads if there are several chunks.
template <class F>
void for_each_chunk(std::span<Chunk> chunks, TaskContext& task, F&& f) {
  if (chunks.size() == 1) {
    f(chunks.front());
  } else {
    task.parallel_for(chunks.size(), 1, [&](unsigned, std::size_t i, std::size_t) { f(chunks[i]); });
  }
}

/// Sets where the chunks put their points: in each third, in the order given. The thirds begin at `next`.
void divide(std::span<Chunk> chunks, std::size_t cut, std::array<KdPoint*, 3> next) {
  for (Chunk& chunk : chunks) {
    chunk.next = next;
    const std::size_t before = std::accumulate(chunk.counts.begin(), chunk.counts.begin() + cut, std::size_t{0});
    const std::size_t within = chunk.counts[cut];
    next = {next[0] + before, next[1] + within, next[2] + (chunk.points.size() - before - within)};
  }
}

template <std::size_t Axis>
bool precedes(const KdPoint& a, const KdPoint& b) {
  return a.at[Axis] != b.at[Axis] ? a.at[Axis] < b.at[Axis] : a.id < b.id;
}

/// Copies the points of the chunks to `to`, the `middle` first ones along the axis before the others.
template <std::size_t Axis>
void cut_across(std::span<Chunk> chunks, const PointBox& box, std::size_t middle, std::span<KdPoint> to,
                TaskContext& task) {
  const Intervals intervals(box.low[Axis], box.high[Axis], to.size());
  for_each_chunk(chunks, task, [&](Chunk& chunk) { chunk.template count<Axis>(intervals); });
  const auto count = [&](std::size_t interval) {
    std::size_t sum = 0;
    for (const Chunk& chunk : chunks) sum += chunk.counts[interval];
    return sum;
  };
  std::size_t cut = 0;
  std::size_t before = 0;
  std::size_t within = count(0);
  while (before + within <= middle) {
    before += within;
    within = count(++cut);
  }
  divide(chunks, cut, {to.data(), to.data() + before, to.data() + before + within});
  for_each_chunk(chunks, task, [&](Chunk& chunk) { chunk.template move<Axis>(intervals, cut); });
  const auto first = to.begin() + static_cast<std::ptrdiff_t>(before);
  std::nth_element(first, to.begin() + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(within),
                   precedes<Axis>);
}

/// Copies the points of the chunks to `to`, cut across the widest side of their box, and returns the size of the first
/// part: all, if they are not more than a unit.
std::size_t cut(std::span<Chunk> chunks, const Cuts& cuts, std::span<KdPoint> to, TaskContext& task) {
  if (to.size() <= cuts.unit) {
    for (auto out = to.begin(); const Chunk& chunk : chunks) out = std::ranges::copy(chunk.points, out).out;
    return to.size();
  }
  const std::size_t middle = cuts(to.size());
  for_each_chunk(chunks, task, [](Chunk& chunk) { chunk.box = box_of(chunk.points); });
  PointBox box = chunks.front().box;
  for (const Chunk& chunk : chunks.subspan(1)) box.extend(chunk.box);
  switch (box.widest_axis()) {
    case 0: cut_across<0>(chunks, box, middle, to, task); break;
    case 1: cut_across<1>(chunks, box, middle, to, task); break;
    default: cut_across<2>(chunks, box, middle, to, task); break;
  }
  return middle;
}

/// Cuts one run on this thread.
std::size_t cut(std::span<const KdPoint> points, const Cuts& cuts, std::span<KdPoint> to) {
  TaskContext alone;
  Chunk chunk;
  chunk.points = points;
  return cut(std::span(&chunk, 1), cuts, to, alone);
}

/// Cuts one run on all threads.
std::size_t cut(std::span<const KdPoint> points, const Cuts& cuts, std::span<KdPoint> to, TaskContext& task) {
  constexpr std::size_t kMostChunks = 64;
  constexpr std::size_t kSmallest = 2048;
  const std::size_t size = std::max(kSmallest, (points.size() + kMostChunks - 1) / kMostChunks);
  RawVector<Chunk> chunks((points.size() + size - 1) / size);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].points = points.subspan(i * size, std::min(size, points.size() - i * size));
  }
  return cut(chunks, cuts, to, task);
}

/// Copies the points of a unit to `to`, ascending by id: the place of each is the number of smaller ids.
void copy_by_id(std::span<const KdPoint> points, std::span<KdPoint> to) {
  constexpr std::size_t kMost = 32;
  assert(points.size() <= kMost);
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
void order(const PointRun& run, const Cuts& cuts, bool moves) {
  if (run.size() > cuts.unit) {
    const std::size_t middle = cut(run.points, cuts, run.other);
    order(run.part(0, middle).swapped(), cuts, !moves);
    order(run.part(middle, run.size() - middle).swapped(), cuts, !moves);
  } else if (moves) {
    copy_by_id(run.points, run.other);
  } else {
    std::copy(run.points.begin(), run.points.end(), run.other.begin());
    copy_by_id(run.other, run.points);
  }
}

/// Cuts each run in two, on all threads together while there are fewer runs than threads.
std::vector<PointRun> cut_each(const std::vector<PointRun>& runs, const Cuts& cuts, TaskContext& task) {
  std::vector<PointRun> halves(2 * runs.size());
  const auto set_halves = [&](std::size_t i, std::size_t middle) {
    halves[2 * i] = runs[i].part(0, middle).swapped();
    halves[2 * i + 1] = runs[i].part(middle, runs[i].size() - middle).swapped();
  };
  if (runs.size() < task.threads()) {
    for (std::size_t i = 0; i < runs.size(); ++i) set_halves(i, cut(runs[i].points, cuts, runs[i].other, task));
  } else {
    task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) {
      set_halves(i, cut(runs[i].points, cuts, runs[i].other));
    });
  }
  return halves;
}

}  // namespace

void kd_order(std::span<KdPoint> points, std::size_t unit, TaskContext& task, KdCut where) {
  const Cuts cuts{unit, where};
  // Each thread gets several runs, so that all end at about the same time; but none is so short that starting it costs
  // more than cutting it. By `KdCut::Power`, a part may have one unit or none; `cut` then copies it.
  constexpr std::size_t kRunsPerThread = 8;
  const std::size_t shortest = std::max<std::size_t>(400, 4 * unit);
  RawVector<KdPoint> other(points.size());
  std::vector<PointRun> runs{{points, other}};
  bool moves = false;
  while (runs.size() < kRunsPerThread * task.threads() && points.size() / runs.size() > shortest) {
    runs = cut_each(runs, cuts, task);
    moves = !moves;
  }
  task.parallel_for(runs.size(), 1, [&](unsigned, std::size_t i, std::size_t) { order(runs[i], cuts, moves); });
}

}  // namespace meshhood::inline v0_1
