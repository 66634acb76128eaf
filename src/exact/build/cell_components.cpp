// SPDX-License-Identifier: MIT
#include "exact/build/cell_components.h"

#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "exact/lane_search.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

static_assert(kCellSize <= kLeafCapacity);

// Enough work for the cost of starting a thread.
constexpr std::size_t kCellsPerTask = 128;

template <class F>
void for_each_cell(std::size_t cells, TaskContext& task, F&& f) {
  task.parallel_for(cells, kCellsPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) f(cell);
  });
}

using CellMasks = std::array<LaneMask, kLeafCapacity>;

/// For each vertex of a cell its neighbors in the cell.
CellMasks cell_adjacency(const CellGraph& graph, std::size_t cell) {
  const std::size_t begin = graph.begin(cell);
  const std::size_t size = graph.end(cell) - begin;
  CellMasks adjacency{};
  for (std::size_t i = 0; i < size; ++i) {
    graph.for_each_neighbor(begin + i, [&](std::size_t neighbor) {
      // A neighbor before the cell wraps around to a number above its size.
      if (neighbor - begin < size) adjacency[i] |= LaneMask{1} << (neighbor - begin);
    });
  }
  return adjacency;
}

/// Numbers the components of a cell from 0, the largest first, in `components`; returns how many there are.
std::uint32_t split_cell(const CellGraph& graph, std::size_t cell, std::vector<std::uint32_t>& component_of) {
  const std::size_t begin = graph.begin(cell);
  const CellMasks adjacency = cell_adjacency(graph, cell);
  CellMasks found{};
  std::uint32_t count = 0;
  const auto size = static_cast<unsigned>(graph.end(cell) - begin);
  for (LaneMask left = first_lanes(size); left != 0; left &= ~found[count++]) {
    found[count] = reachable_lanes(adjacency.data(), left & -left);
  }
  const auto largest = std::max_element(found.begin(), found.begin() + count,
                                        [](LaneMask a, LaneMask b) { return std::popcount(a) < std::popcount(b); });
  std::swap(*largest, found[0]);
  for (std::uint32_t component = 0; component < count; ++component) {
    for (LaneMask left = found[component]; left != 0; left &= left - 1) {
      component_of[begin + static_cast<std::size_t>(std::countr_zero(left))] = component;
    }
  }
  return count;
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Merges small components, in the order of their numbers.
class Merger {
 public:
  Merger(const CellGraph& graph, CellComponents& components)
      : graph_(graph), components_(components), merged_into_(components.size.size()) {
    std::iota(merged_into_.begin(), merged_into_.end(), 0);
  }

  void run() {
    for (std::size_t cell = 0; cell < graph_.cells(); ++cell) {
      for (std::uint32_t c = components_.first[cell]; c < components_.first[cell + 1]; ++c) {
        if (size(c) < kSmallComponent) merge(cell, c);
      }
    }
    pack_crumbs();
    for (std::uint32_t& c : components_.of) c = root(c);
  }

 private:
  [[nodiscard]] std::uint32_t& size(std::uint32_t component) { return components_.size[component]; }

  /// Merges a small component into the neighbor with the most edges to it among those with room.
  void merge(std::size_t cell, std::uint32_t small) {
    const std::uint32_t merged = root(small);
    if (size(merged) >= kSmallComponent) return;
    gather_neighbors(cell, small, merged);
    join(merged, best_neighbor(merged));
  }

  /// Fills leaves with crumbs, in the order of the cells.
  void pack_crumbs() {
    find_linked();
    std::uint32_t open = kNone;
    for (std::uint32_t c = 0; c < merged_into_.size(); ++c) {
      const bool is_crumb = merged_into_[c] == c && !is_linked_[c] && size(c) < kSmallComponent;
      if (!is_crumb) continue;
      if (open != kNone && has_room(c, open)) {
        join(c, open);
      } else {
        open = c;
      }
    }
  }

  /// Marks the small components that an edge joins to another one.
  void find_linked() {
    is_linked_.assign(merged_into_.size(), false);
    for (std::size_t cell = 0; cell < graph_.cells(); ++cell) {
      for (std::uint32_t c = components_.first[cell]; c < components_.first[cell + 1]; ++c) {
        const std::uint32_t merged = root(c);
        if (is_linked_[merged] || size(merged) >= kSmallComponent) continue;
        gather_neighbors(cell, c, merged);
        is_linked_[merged] = !neighbors_.empty();
      }
    }
  }

  /// The components at the other ends of all edges that leave `merged` from `small`, which is a part of it.
  void gather_neighbors(std::size_t cell, std::uint32_t small, std::uint32_t merged) {
    neighbors_.clear();
    for (std::size_t point = graph_.begin(cell); point < graph_.end(cell); ++point) {
      if (components_.of[point] != small) continue;
      graph_.for_each_neighbor(point, [&](std::size_t other) {
        const std::uint32_t neighbor = root(components_.of[other]);
        if (neighbor != merged) neighbors_.push_back(neighbor);
      });
    }
  }

  /// The most frequent of `neighbors_` with room for `component`, of equal ones the first; `component` itself if there
  /// is none.
  std::uint32_t best_neighbor(std::uint32_t component) {
    std::sort(neighbors_.begin(), neighbors_.end());
    std::uint32_t best = component;
    std::ptrdiff_t most = 0;
    for (auto first = neighbors_.begin(); first != neighbors_.end();) {
      const auto last = std::upper_bound(first, neighbors_.end(), *first);
      if (last - first > most && has_room(component, *first)) {
        best = *first;
        most = last - first;
      }
      first = last;
    }
    return best;
  }

  [[nodiscard]] bool has_room(std::uint32_t a, std::uint32_t b) { return size(a) + size(b) <= kLeafCapacity; }

  void join(std::uint32_t component, std::uint32_t other) {
    if (component == other || !has_room(component, other)) return;
    merged_into_[component] = other;
    size(other) += std::exchange(size(component), 0U);
  }

  /// Follows the merges, and shortens the path (path compression).
  std::uint32_t root(std::uint32_t component) {
    while (merged_into_[component] != component) {
      component = merged_into_[component] = merged_into_[merged_into_[component]];
    }
    return component;
  }

  const CellGraph& graph_;
  CellComponents& components_;
  std::vector<std::uint32_t> merged_into_;  // by component: itself, or the component it has been merged into
  std::vector<std::uint32_t> neighbors_;    // of the component that is being merged, one for each edge
  std::vector<bool> is_linked_;             // by component, if small
};

}  // namespace

CellGraph::CellGraph(std::span<const KdPoint> points, const AdjacencyView& adjacency, TaskContext& task)
    : points_(points), adjacency_(adjacency), number_(points.size()) {
  for_each_cell(cells(), task, [&](std::size_t cell) {
    for (std::size_t i = begin(cell); i < end(cell); ++i) number_[points_[i].id] = static_cast<std::uint32_t>(i);
  });
}

CellComponents split_cells(const CellGraph& graph, TaskContext& task) {
  CellComponents result;
  result.first.resize(graph.cells() + 1);
  result.of.resize(graph.size());
  for_each_cell(graph.cells(), task,
                [&](std::size_t cell) { result.first[cell + 1] = split_cell(graph, cell, result.of); });
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.size.resize(result.first.back());
  for_each_cell(graph.cells(), task, [&](std::size_t cell) {
    for (std::size_t i = graph.begin(cell); i < graph.end(cell); ++i) {
      result.of[i] += result.first[cell];
      ++result.size[result.of[i]];
    }
  });
  return result;
}

void merge_small(const CellGraph& graph, CellComponents& components) { Merger(graph, components).run(); }

}  // namespace meshhood
