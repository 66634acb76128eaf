// SPDX-License-Identifier: MIT
#include "exact/build/cells.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "base/epoch_array.h"
#include "exact/build/links.h"

namespace meshhood::inline v0_1 {
namespace {

// Chunks of these sizes take much longer than passing them to a thread.
constexpr std::size_t kPointGrain = 2048;
constexpr std::size_t kCellGrain = 64;

RawVector<KdPoint> make_points(const PositionsView& positions, const Frame& frame, TaskContext& task) {
  return positions.visit([&](const auto& xyz) {
    RawVector<KdPoint> points(xyz.size());
    task.parallel_for(points.size(), kPointGrain, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) points[v] = kd_point(frame.to_frame(point(xyz, v)), v);
    });
    return points;
  });
}

static_assert(kCellSize <= kLeafCapacity);

/// Appends the components of a cell, the largest first.
void split_cell(const Cells& cells, const Links& links, std::uint32_t cell, std::vector<CellComponent>& out) {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  const LaneMask* const adjacency = &links.adjacency[cells.begin[cell]];
  for (LaneMask left = first_lanes(cells.size_of(cell)); left != 0;) {
    const LaneMask found = reachable_lanes(adjacency, left & -left);
    out.push_back({cell, found});
    left &= ~found;
  }
  const auto begin = out.begin() + first;
  std::swap(*begin, *std::max_element(begin, out.end(), [](const CellComponent& a, const CellComponent& b) {
    return count_of(a.lanes) < count_of(b.lanes);
  }));
}

/// Lists for each small component the components at the other ends of the edges that leave it, one for each edge.
Lists<std::uint32_t> neighbors_of_small(const CellComponents& components, const Links& links, TaskContext& task) {
  const auto append = [&](std::size_t c, std::vector<std::uint32_t>& out) {
    const CellComponent& component = components.elements[c];
    if (count_of(component.lanes) >= kSmallComponent) return;
    for (const Link& link : links.links_of(component.cell)) {
      if ((link.boundary & component.lanes) == 0) continue;
      for (const CrossEdge& edge : links.cross_edges_of(link)) {
        if ((component.lanes >> edge.from & 1U) != 0) out.push_back(components.at(link.leaf, edge.to));
      }
    }
  };
  return collect_rows<std::uint32_t>(components.elements.size(), task, append);
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Merges small components, in the order of their numbers.
class Merger {
 public:
  /// `neighbors` is the result of `neighbors_of_small`.
  Merger(std::span<const CellComponent> components, const Lists<std::uint32_t>& neighbors)
      : neighbors_of_(neighbors), merged_into_(components.size()), edges_to_(components.size()) {
    std::iota(merged_into_.begin(), merged_into_.end(), 0);
    sizes_.reserve(components.size());
    for (const CellComponent& component : components) {
      sizes_.push_back(static_cast<std::uint8_t>(count_of(component.lanes)));
    }
  }

  /// Returns for each component the one that it is merged into at last.
  std::vector<std::uint32_t> run() {
    for (std::uint32_t c = 0; c < merged_into_.size(); ++c) {
      if (size(c) < kSmallComponent) merge(c);
    }
    pack_crumbs();
    for (std::uint32_t c = 0; c < merged_into_.size(); ++c) merged_into_[c] = root(c);
    return std::move(merged_into_);
  }

 private:
  [[nodiscard]] std::uint8_t& size(std::uint32_t component) { return sizes_[component]; }

  /// Merges a small component into the neighbor with the most edges to it among those with room.
  void merge(std::uint32_t small) {
    const std::uint32_t merged = root(small);
    if (size(merged) >= kSmallComponent) return;
    gather_neighbors(small, merged);
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
    for (std::uint32_t c = 0; c < merged_into_.size(); ++c) {
      const std::uint32_t merged = root(c);
      if (is_linked_[merged] || size(merged) >= kSmallComponent) continue;
      gather_neighbors(c, merged);
      is_linked_[merged] = !neighbors_.empty();
    }
  }

  /// Counts the edges that leave `merged` from `small`, which is a part of it, by the component at the other end.
  void gather_neighbors(std::uint32_t small, std::uint32_t merged) {
    neighbors_.clear();
    edges_to_.forget();
    for (const std::uint32_t other : neighbors_of_[small]) {
      const std::uint32_t neighbor = root(other);
      if (neighbor == merged) continue;
      if (!edges_to_.is_known(neighbor)) {
        neighbors_.push_back(neighbor);
        edges_to_.set(neighbor, 0);
      }
      ++edges_to_[neighbor];
    }
  }

  /// Returns, of `neighbors_` with room for `component`, the one with the most edges to it, and of several such ones
  /// the first in number; `component` itself if there is none.
  std::uint32_t best_neighbor(std::uint32_t component) {
    std::uint32_t best = component;
    std::uint32_t most = 0;
    for (const std::uint32_t neighbor : neighbors_) {
      const std::uint32_t edges = edges_to_[neighbor];
      if (edges < most || (edges == most && neighbor > best) || !has_room(component, neighbor)) continue;
      best = neighbor;
      most = edges;
    }
    return best;
  }

  [[nodiscard]] bool has_room(std::uint32_t a, std::uint32_t b) { return unsigned{size(a)} + size(b) <= kLeafCapacity; }

  void join(std::uint32_t component, std::uint32_t other) {
    if (component == other || !has_room(component, other)) return;
    merged_into_[component] = other;
    size(other) = static_cast<std::uint8_t>(size(other) + size(component));
  }

  /// Follows the merges, and shortens the path (path compression).
  std::uint32_t root(std::uint32_t component) {
    while (merged_into_[component] != component) {
      component = merged_into_[component] = merged_into_[merged_into_[component]];
    }
    return component;
  }

  const Lists<std::uint32_t>& neighbors_of_;
  std::vector<std::uint32_t> merged_into_;  // by component: itself, or the component it has been merged into
  std::vector<std::uint8_t> sizes_;         // by component, with those merged into it; small if it has been merged
  std::vector<std::uint32_t> neighbors_;    // of the component that is being merged
  EpochArray<std::uint32_t> edges_to_;      // by component, if it is one of these
  std::vector<bool> is_linked_;             // by component, if small
};

/// Numbers the leaves in the order of the components that others have been merged into.
MergedComponents number_leaves(std::vector<std::uint32_t> merged_into, std::span<const CellComponent> components) {
  MergedComponents result;
  std::vector<std::uint32_t> number(merged_into.size());
  std::uint32_t leaves = 0;
  for (std::uint32_t c = 0; c < number.size(); ++c) number[c] = merged_into[c] == c ? leaves++ : 0;
  result.leaf_of = std::move(merged_into);
  for (std::uint32_t& leaf : result.leaf_of) leaf = number[leaf];
  const auto for_each = [&](auto&& f) {
    for (std::size_t c = components.size(); c-- > 0;) f(result.leaf_of[c], components[c]);
  };
  gather_rows(leaves, for_each, result.offsets, result.elements);
  return result;
}

}  // namespace

Cells make_cells(const PositionsView& positions, const Frame& frame, TaskContext& task) {
  Cells cells;
  cells.points = make_points(positions, frame, task);
  kd_order(cells.points, kCellSize, task);
  const std::size_t vertices = cells.points.size();
  cells.slot.resize(vertices);
  cells.begin.resize((vertices + kCellSize - 1) / kCellSize + 1);
  task.parallel_for(cells.begin.size(), kCellGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const std::size_t first = std::min(cell * kCellSize, vertices);
      const std::size_t last = std::min(first + kCellSize, vertices);
      cells.begin[cell] = static_cast<VertexId>(first);
      for (std::size_t i = first; i < last; ++i) {
        cells.slot[cells.points[i].id] = static_cast<std::uint32_t>(cell * kLeafCapacity + (i - first));
      }
    }
  });
  return cells;
}

CellComponents split_cells(const Cells& cells, const Links& links, TaskContext& task) {
  const auto append = [&](std::size_t cell, std::vector<CellComponent>& out) {
    split_cell(cells, links, static_cast<std::uint32_t>(cell), out);
  };
  return {collect_rows<CellComponent>(cells.size(), task, append)};
}

MergedComponents merge_small(const CellComponents& components, const Links& links, TaskContext& task) {
  const Lists<std::uint32_t> neighbors = neighbors_of_small(components, links, task);
  return number_leaves(Merger(components.elements, neighbors).run(), components.elements);
}

}  // namespace meshhood::inline v0_1
