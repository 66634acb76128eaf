// SPDX-License-Identifier: MIT
// A kd tree cuts space into cells. The mesh may pass through a cell in several parts, which become leaves of their own
// if they are large enough; a smaller part joins a neighbouring leaf that has room.
#include "exact/build/leaves.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "exact/build/kd_order.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

// Below the capacity, so that small parts find room next door.
constexpr std::size_t kCellSize = 30;

// A part smaller than this does not become a leaf if it can be helped: two of them make one.
constexpr std::uint32_t kSmallPart = 17;

// So many vertices, or a like amount of work, keep a thread busy long enough.
constexpr std::size_t kSitesATask = 4096;

std::vector<Site> make_sites(const PositionsView& positions, const Frame& frame, TaskContext& task) {
  return positions.visit([&](auto xyz) {
    std::vector<Site> sites(xyz.size() / 3);
    task.parallel_for(sites.size(), kSitesATask, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const FramePoint p = frame.round(point(xyz, v));
        sites[v] = {{p.x, p.y, p.z}, static_cast<std::uint32_t>(v)};
      }
    });
    return sites;
  });
}

/// The vertices by cells, and the connected parts of the mesh in each cell.
class Parts {
 public:
  Parts(std::span<const Site> sites, const AdjacencyView& adjacency, TaskContext& task)
      : sites_(sites),
        adjacency_(adjacency),
        first_part_((sites.size() + kCellSize - 1) / kCellSize + 1),
        site_of_(sites.size()),
        part_of_(sites.size()) {
    for_each_cell(task, [&](std::size_t cell) { number_sites(cell); });
    for_each_cell(task, [&](std::size_t cell) { split(cell); });
    std::partial_sum(first_part_.begin(), first_part_.end(), first_part_.begin());
    size_.resize(first_part_.back());
    for_each_cell(task, [&](std::size_t cell) { number_parts(cell); });
    merged_into_.resize(first_part_.back());
    std::iota(merged_into_.begin(), merged_into_.end(), 0);
    merge_small_parts();
  }

  /// By vertex in the order of the cells: the part it belongs to, after merging.
  [[nodiscard]] std::uint32_t part_of(std::size_t site) const { return merged_into_[part_of_[site]]; }

  /// Parts are numbered with gaps: one that has been merged into another has no vertices.
  [[nodiscard]] std::size_t part_count() const { return size_.size(); }
  [[nodiscard]] std::uint32_t size(std::size_t part) const { return size_[part]; }

 private:
  template <class F>
  void for_each_cell(TaskContext& task, F&& f) const {
    task.parallel_for(first_part_.size() - 1, kSitesATask / kCellSize,
                      [&](unsigned, std::size_t begin, std::size_t end) {
                        for (std::size_t cell = begin; cell < end; ++cell) f(cell);
                      });
  }

  [[nodiscard]] std::size_t begin_of(std::size_t cell) const { return std::min(cell * kCellSize, sites_.size()); }

  void number_sites(std::size_t cell) {
    for (std::size_t site = begin_of(cell); site < begin_of(cell + 1); ++site) {
      site_of_[sites_[site].id] = static_cast<std::uint32_t>(site);
    }
  }

  template <class F>
  void for_each_neighbor_site(std::size_t site, F&& f) const {
    for (const VertexId w : adjacency_[sites_[site].id]) f(std::size_t{site_of_[w]});
  }

  /// Finds the parts of a cell and numbers them from 0, the largest first.
  void split(std::size_t cell) {
    const std::size_t begin = begin_of(cell);
    const std::size_t size = begin_of(cell + 1) - begin;
    std::array<LaneMask, kLeafCapacity> near{};
    for (std::size_t i = 0; i < size; ++i) {
      // Sites of other cells lie beyond the lanes, above or, wrapped around, below.
      for_each_neighbor_site(begin + i, [&](std::size_t site) {
        if (site - begin < size) near[i] |= LaneMask{1} << (site - begin);
      });
    }
    std::array<LaneMask, kLeafCapacity> parts{};
    std::uint32_t count = 0;
    for (LaneMask left = first_lanes(static_cast<unsigned>(size)); left != 0; left &= ~parts[count++]) {
      parts[count] = grow(left & -left, near);
    }
    const auto largest = std::max_element(parts.begin(), parts.begin() + count,
                                          [](LaneMask a, LaneMask b) { return std::popcount(a) < std::popcount(b); });
    std::swap(*largest, parts[0]);
    for (std::uint32_t part = 0; part < count; ++part) {
      for (LaneMask left = parts[part]; left != 0; left &= left - 1) {
        part_of_[begin + static_cast<std::size_t>(std::countr_zero(left))] = part;
      }
    }
    first_part_[cell + 1] = count;
  }

  static LaneMask grow(LaneMask seed, const std::array<LaneMask, kLeafCapacity>& near) {
    LaneMask reached = seed;
    for (LaneMask todo = seed; todo != 0;) {
      const LaneMask added = near[static_cast<std::size_t>(std::countr_zero(todo))] & ~reached;
      todo = (todo & (todo - 1)) | added;
      reached |= added;
    }
    return reached;
  }

  /// From the numbers within the cell to those among all.
  void number_parts(std::size_t cell) {
    for (std::size_t site = begin_of(cell); site < begin_of(cell + 1); ++site) {
      part_of_[site] += first_part_[cell];
      ++size_[part_of_[site]];
    }
  }

  void merge_small_parts() {
    for (std::size_t cell = 0; cell + 1 < first_part_.size(); ++cell) {
      for (std::uint32_t part = first_part_[cell]; part < first_part_[cell + 1]; ++part) {
        if (size_[part] < kSmallPart) merge(cell, part);
      }
    }
    for (std::uint32_t part = 0; part < merged_into_.size(); ++part) merged_into_[part] = root(part);
  }

  /// Joins a small part to the neighbour that shares most edges with it, of those that have room. One without any
  /// neighbours is a component of the mesh, and stays with the others of its cell: else a cloud of points would cost a
  /// leaf a point.
  void merge(std::size_t cell, std::uint32_t small) {
    const std::uint32_t part = root(small);
    if (size_[part] >= kSmallPart) return;
    neighbors_.clear();
    for (std::size_t site = begin_of(cell); site < begin_of(cell + 1); ++site) {
      if (part_of_[site] != small) continue;
      for_each_neighbor_site(site, [&](std::size_t other) {
        const std::uint32_t neighbor = root(part_of_[other]);
        if (neighbor != part) neighbors_.push_back(neighbor);
      });
    }
    join(part, neighbors_.empty() ? root(first_part_[cell]) : best_neighbor(part));
  }

  /// The most frequent of `neighbors_` with room for `part`; `part` itself if none has.
  std::uint32_t best_neighbor(std::uint32_t part) {
    std::sort(neighbors_.begin(), neighbors_.end());
    std::uint32_t best = part;
    std::ptrdiff_t most = 0;
    for (auto first = neighbors_.begin(); first != neighbors_.end();) {
      const auto last = std::upper_bound(first, neighbors_.end(), *first);
      if (last - first > most && has_room(part, *first)) {
        best = *first;
        most = last - first;
      }
      first = last;
    }
    return best;
  }

  [[nodiscard]] bool has_room(std::uint32_t part, std::uint32_t other) const {
    return size_[part] + size_[other] <= kLeafCapacity;
  }

  void join(std::uint32_t part, std::uint32_t other) {
    if (part == other || !has_room(part, other)) return;
    merged_into_[part] = other;
    size_[other] += std::exchange(size_[part], 0U);
  }

  std::uint32_t root(std::uint32_t part) {
    while (merged_into_[part] != part) part = merged_into_[part] = merged_into_[merged_into_[part]];
    return part;
  }

  std::span<const Site> sites_;
  AdjacencyView adjacency_;
  std::vector<std::uint32_t> first_part_;  // by cell, and one more
  std::vector<std::uint32_t> site_of_;     // by vertex
  std::vector<std::uint32_t> part_of_;     // by site, before merging
  std::vector<std::uint32_t> merged_into_;
  std::vector<std::uint32_t> size_;
  std::vector<std::uint32_t> neighbors_;  // of the part that is being merged, by edge
};

/// The parts that are left, as the means of their vertices, in the order of the leaves.
std::vector<Site> order_parts(std::span<const Site> sites, const Parts& parts) {
  std::vector<std::array<double, 3>> sum(parts.part_count());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::uint32_t part = parts.part_of(i);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[part][axis] += static_cast<double>(sites[i].at[axis]);
  }
  std::vector<Site> centres;
  for (std::uint32_t part = 0; part < parts.part_count(); ++part) {
    if (parts.size(part) == 0) continue;
    const auto mean = [&](std::size_t axis) { return static_cast<float>(sum[part][axis] / parts.size(part)); };
    centres.push_back({{mean(0), mean(1), mean(2)}, part});
  }
  kd_order_nested(centres, kFanOut);
  return centres;
}

}  // namespace

void check_leaf_count(std::size_t leaves) {
  if (leaves <= kMaxLeaves) return;
  raise(ErrorCode::TooLarge,
        std::to_string(leaves) + " leaves in the index, but the limit is " + std::to_string(kMaxLeaves));
}

LeafPartition make_leaves(const GraphView& graph, const Frame& frame, TaskContext& task) {
  std::vector<Site> sites = make_sites(graph.positions, frame, task);
  kd_order(sites, kCellSize, task);
  const Parts parts(sites, graph.adjacency, task);
  const std::vector<Site> centres = order_parts(sites, parts);
  check_leaf_count(centres.size());

  LeafPartition result;
  result.slot.resize(sites.size());
  result.permutation.resize(sites.size());
  result.leaf_begin.assign(centres.size() + 1, 0);
  std::vector<LeafId> leaf_of_part(parts.part_count());
  for (std::size_t leaf = 0; leaf < centres.size(); ++leaf) {
    const std::uint32_t part = centres[leaf].id;
    leaf_of_part[part] = static_cast<LeafId>(leaf);
    result.leaf_begin[leaf + 1] = static_cast<VertexId>(result.leaf_begin[leaf] + parts.size(part));
  }
  task.parallel_for(sites.size(), kSitesATask, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result.slot[sites[i].id] = leaf_of_part[parts.part_of(i)];
  });
  // In the order of the caller's vertices, so that neighbours in a leaf stay neighbours.
  std::vector<std::uint8_t> filled(centres.size(), 0);
  for (std::size_t v = 0; v < sites.size(); ++v) {
    const LeafId leaf = result.slot[v];
    const std::uint32_t lane = filled[leaf]++;
    result.slot[v] = leaf * kLeafCapacity + lane;
    result.permutation[result.leaf_begin[leaf] + lane] = static_cast<VertexId>(v);
  }
  return result;
}

}  // namespace meshhood
