// SPDX-License-Identifier: MIT
// The points near one lie in the cells of a grid around it.
#include "meshhood/link_points.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "exact/index_access.h"
#include "shared/distance.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kPointsAtOnce = std::size_t{1} << 14;
constexpr std::size_t kGridCellsAtOnce = 256;

// Two points whose computed distance is at most the link are in neighboring cells, although that distance and the place
// of each in the grid are rounded a few times, by 2^-53 of the distance and of the extent of all points; and although
// squares of distances below 2^-537 underflow.
constexpr double kLinkSlack = 0x1p-40;
constexpr double kExtentSlack = 0x1p-50;
constexpr double kSmallestWidth = 0x1p-500;

/// Sorts the points into the cells of a grid, whose width is at least the link.
///
/// A cell has a 64-bit *key*. Cells that follow each other along the last axis have consecutive keys, and each row has
/// a free key before and after its cells. If there are more cells than keys, a key may stand for several cells: then
/// more points are compared than needed.
class PointGrid {
 public:
  PointGrid(const PositionsView& points, std::span<const VertexId> ids, double link, TaskContext& task)
      : squared_link_(squared_radius(link)) {
    points.visit([&](const auto& xyz) {
      measure(xyz, ids, link);
      sort(xyz, ids, task);
    });
    is_wide_ = width_ > 2 * link;
  }

  [[nodiscard]] std::size_t cell_count() const { return keys_.size(); }

  /// Returns whether many points share a cell because another point is so far away that the cells are wider than the
  /// link.
  [[nodiscard]] bool is_crowded() const {
    constexpr std::size_t kMany = 64;
    const auto is_large = [](std::size_t begin, std::size_t end) { return end - begin > kMany; };
    return is_wide_ && std::adjacent_find(begin_.begin(), begin_.end(), is_large) != begin_.end();
  }

  /// A point of a cell, and the runs of points that may be near it.
  struct Near {
    const PointGrid* grid;
    std::size_t point;  // in the order of the cells
    std::span<const std::pair<std::size_t, std::size_t>> runs;

    [[nodiscard]] VertexId id() const { return grid->order_[point].second; }

    /// Returns the number of points within the link, this one included, without branches.
    [[nodiscard]] std::size_t count() const {
      std::size_t count = 0;
      for (const auto& [begin, end] : runs) {
        for (std::size_t i = begin; i < end; ++i) count += grid->is_near(point, i) ? 1 : 0;
      }
      return count;
    }

    /// Writes the ids of these points but this one, ascending. Which points are near cannot be predicted, so there is
    /// no branch; `scratch` has room for one more.
    void write(std::span<VertexId> out, std::vector<VertexId>& scratch) const {
      if (scratch.size() <= out.size()) scratch.resize(2 * out.size() + 1);
      VertexId* next = scratch.data();
      for (const auto& [begin, end] : runs) {
        for (std::size_t i = begin; i < end; ++i) {
          *next = grid->order_[i].second;
          next += static_cast<std::size_t>(grid->is_near(point, i)) & static_cast<std::size_t>(i != point);
        }
      }
      std::copy(scratch.data(), next, out.begin());
      std::sort(out.begin(), out.end());
    }
  };

  /// Calls `f(near)` for the points of a cell.
  template <class F>
  void for_each_point(std::size_t cell, F&& f) const {
    std::array<std::pair<std::size_t, std::size_t>, 18> runs{};
    std::size_t count = 0;
    const auto add = [&](std::size_t begin, std::size_t end) {
      if (begin < end) runs[count++] = {begin, end};
    };
    for (std::uint64_t x = 0; x < 3; ++x) {
      for (std::uint64_t y = 0; y < 3; ++y) {
        const std::uint64_t middle = keys_[cell] + (x - 1) * strides_[0] + (y - 1) * strides_[1];
        if (middle - 1 < middle + 2) {
          add(first_from(middle - 1), first_from(middle + 2));
        } else {  // 2^64 lies between them
          add(first_from(middle - 1), order_.size());
          add(0, first_from(middle + 2));
        }
      }
    }
    std::sort(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 1; i < count; ++i) {  // runs overlap where a key stands for several cells
      runs[i].first = std::max(runs[i].first, runs[i - 1].second);
      runs[i].second = std::max(runs[i].second, runs[i].first);
    }
    for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) f(Near{this, i, std::span(runs).first(count)});
  }

 private:
  template <class Real>
  void measure(const StridedPositions<Real>& xyz, std::span<const VertexId> ids, double link) {
    std::array<double, 3> high{};
    for (std::size_t i = 0; i < ids.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<double>(xyz(ids[i], axis));
        low_[axis] = i == 0 ? value : std::min(low_[axis], value);
        high[axis] = i == 0 ? value : std::max(high[axis], value);
      }
    }
    double extent = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, high[axis] - low_[axis]);
    width_ = link * (1 + kLinkSlack) + extent * kExtentSlack + kSmallestWidth;
    std::array<std::uint64_t, 3> sizes{};
    for (std::size_t axis = 0; axis < 3; ++axis) sizes[axis] = cell(high[axis], axis) + 3;
    strides_ = {sizes[1] * sizes[2], sizes[2], 1};
  }

  [[nodiscard]] std::uint64_t cell(double coordinate, std::size_t axis) const {
    return static_cast<std::uint64_t>((coordinate - low_[axis]) / width_);
  }

  template <class Real>
  void sort(const StridedPositions<Real>& xyz, std::span<const VertexId> ids, TaskContext& task) {
    order_.resize(ids.size());
    task.parallel_for(ids.size(), kPointsAtOnce, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::uint64_t key = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          key += (cell(static_cast<double>(xyz(ids[i], axis)), axis) + 1) * strides_[axis];
        }
        order_[i] = {key, ids[i]};
      }
    });
    sort_order(task);
    for (std::vector<double>& axis : xyz_) axis.resize(ids.size());
    task.parallel_for(ids.size(), kPointsAtOnce, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) xyz_[axis][i] = static_cast<double>(xyz(order_[i].second, axis));
      }
    });
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i != 0 && order_[i].first == order_[i - 1].first) continue;
      keys_.push_back(order_[i].first);
      begin_.push_back(i);
    }
    begin_.push_back(order_.size());
  }

  /// Sorts by key, then by id: two halves at once.
  void sort_order(TaskContext& task) {
    const std::size_t half = order_.size() / 2;
    const auto middle = order_.begin() + static_cast<std::ptrdiff_t>(half);
    task.parallel_for(2, 1, [&](unsigned, std::size_t part, std::size_t) {
      std::sort(part == 0 ? order_.begin() : middle, part == 0 ? middle : order_.end());
    });
    std::vector<std::pair<std::uint64_t, VertexId>> merged(order_.size());
    std::merge(order_.begin(), middle, middle, order_.end(), merged.begin());
    order_ = std::move(merged);
  }

  /// Returns the first point whose cell has a key of at least `key`.
  [[nodiscard]] std::size_t first_from(std::uint64_t key) const {
    return begin_[static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin())];
  }

  [[nodiscard]] bool is_near(std::size_t a, std::size_t b) const {
    return squared_distance({xyz_[0][a], xyz_[1][a], xyz_[2][a]}, {xyz_[0][b], xyz_[1][b], xyz_[2][b]}) <=
           squared_link_;
  }

  double squared_link_;
  double width_ = 0;
  bool is_wide_ = false;
  std::array<double, 3> low_{};
  std::array<std::uint64_t, 3> strides_{};
  std::vector<std::pair<std::uint64_t, VertexId>> order_;  // the points by key
  std::array<std::vector<double>, 3> xyz_;                 // in this order
  std::vector<std::uint64_t> keys_;                        // of the cells that have points, ascending
  std::vector<std::size_t> begin_;                         // of each cell, and one more: its first point
};

/// Cuts points where two that follow each other along an axis are farther apart than the link, so that no point of one
/// part is near one of another. Points without such a gap extend over less than their number times the link.
std::vector<std::vector<VertexId>> split_at_gaps(const PositionsView& points, std::vector<VertexId> ids, double link) {
  const double gap = link * (1 + kLinkSlack) + kSmallestWidth;
  std::vector<std::vector<VertexId>> parts;
  parts.push_back(std::move(ids));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](VertexId v) {
      return points.visit([&](const auto& xyz) { return static_cast<double>(xyz(v, axis)); });
    };
    std::vector<std::vector<VertexId>> smaller;
    for (std::vector<VertexId>& part : parts) {
      std::ranges::sort(part, {}, at);
      for (std::size_t i = 0; i < part.size(); ++i) {
        if (i == 0 || at(part[i]) - at(part[i - 1]) > gap) smaller.emplace_back();
        smaller.back().push_back(part[i]);
      }
    }
    parts = std::move(smaller);
  }
  return parts;
}

/// Makes grids whose cells hold few more points than near ones: one grid, unless some points are very far from others.
std::vector<PointGrid> make_grids(const PositionsView& points, double link, TaskContext& task) {
  std::vector<VertexId> all(points.size());
  std::iota(all.begin(), all.end(), VertexId{0});
  std::vector<std::vector<VertexId>> left;
  left.push_back(std::move(all));
  std::vector<PointGrid> grids;
  while (!left.empty()) {
    const std::vector<VertexId> ids = std::move(left.back());
    left.pop_back();
    PointGrid grid(points, ids, link, task);
    std::vector<std::vector<VertexId>> parts;
    if (grid.is_crowded()) parts = split_at_gaps(points, ids, link);
    if (parts.size() > 1) {
      std::ranges::move(parts, std::back_inserter(left));
    } else {
      grids.push_back(std::move(grid));
    }
  }
  return grids;
}

/// Calls `f(near, scratch)` for all points, on any thread, with scratch memory of the thread.
template <class F>
void for_each_point(std::span<const PointGrid> grids, TaskContext& task, F&& f) {
  for (const PointGrid& grid : grids) {
    task.parallel_for(grid.cell_count(), kGridCellsAtOnce, [&](unsigned thread, std::size_t begin, std::size_t end) {
      std::vector<VertexId> scratch;
      for (std::size_t cell = begin; cell < end && task.should_continue(thread); ++cell) {
        grid.for_each_point(cell, [&](const PointGrid::Near& near) { f(near, scratch); });
      }
    });
  }
}

constexpr std::size_t kLinkSteps = 3;

/// Takes `kLinkSteps` steps of the task.
Adjacency linked(const PositionsView& points, double link, std::size_t max_edges, TaskContext& task) {
  validate(points);
  if (!(link >= 0 && std::isfinite(link))) {
    raise(ErrorCode::InvalidOption, "link: " + to_text(link) + ", expected a finite number >= 0");
  }
  const std::vector<PointGrid> grids = make_grids(points, link, task);
  task.step();
  const std::size_t most = std::min(max_edges, kMaxNeighbors / 2);
  Adjacency graph;
  graph.offsets.assign(points.size() + 1, 0);
  std::atomic<std::size_t> neighbors{0};
  for_each_point(grids, task, [&](const PointGrid::Near& near, std::vector<VertexId>&) {
    const std::size_t count = near.count() - 1;  // the point itself does not count
    if (neighbors.fetch_add(count, std::memory_order_relaxed) + count > 2 * most) {
      raise(ErrorCode::TooLarge, "link: " + to_text(link) + " joins the " + std::to_string(points.size()) +
                                     " points by more than " + std::to_string(most) +
                                     " edges, expected a smaller link");
    }
    graph.offsets[near.id() + std::size_t{1}] = static_cast<EdgeOffset>(count);
  });
  task.step();
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  graph.neighbors.resize(graph.offsets.back());
  for_each_point(grids, task, [&](const PointGrid::Near& near, std::vector<VertexId>& scratch) {
    const std::size_t begin = graph.offsets[near.id()];
    near.write(std::span(graph.neighbors).subspan(begin, graph.offsets[near.id() + std::size_t{1}] - begin), scratch);
  });
  task.step();
  return graph;
}

}  // namespace

Adjacency link_points(const PositionsView& points, double link, const LinkOptions& options, const Run& run) {
  TaskContext task(run.threads, run.progress, kLinkSteps);
  Adjacency graph = linked(points, link, options.max_edges, task);
  task.finish();
  return graph;
}

Index build_linked(const PositionsView& points, double link, const LinkOptions& options, const Run& run) {
  TaskContext task(run.threads, run.progress, kLinkSteps + IndexAccess::kBuildSteps);
  const Adjacency graph = linked(points, link, options.max_edges, task);
  Index index = IndexAccess::make(IndexAccess::build_arrays(points, EdgeSource(graph.view()), task));
  task.report_progress();
  return index;
}

}  // namespace meshhood::inline v0_1
