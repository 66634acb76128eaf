// SPDX-License-Identifier: MIT
// A kd tree cuts space into cells. The mesh may pass through a cell in several parts, which become leaves of their own
// if they are large enough; a smaller part joins a neighbouring leaf that has room.
#include "index/leaves.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>

#include "index/kd_order.h"
#include "index/layout.h"

namespace meshhood {
namespace {

// Below the capacity, so that small parts find room next door.
constexpr std::size_t kCellSize = 30;

// A part smaller than this does not become a leaf if it can be helped: two of them make one.
constexpr int kSmallPart = 17;

std::vector<Site> make_sites(const PositionsView& positions, const Frame& frame) {
  return positions.visit([&](auto xyz) {
    std::vector<Site> sites(xyz.size() / 3);
    for (std::size_t v = 0; v < sites.size(); ++v) {
      const FramePoint p = frame.round(point(xyz, v));
      sites[v] = {{p.x, p.y, p.z}, static_cast<std::uint32_t>(v)};
    }
    return sites;
  });
}

/// The vertices by cells, and the connected parts of the mesh in each cell.
class Parts {
 public:
  Parts(std::span<const Site> sites, const AdjacencyView& adjacency)
      : sites_(sites), adjacency_(adjacency), place_(sites.size()), part_of_(sites.size()) {
    for (std::size_t i = 0; i < sites.size(); ++i) {
      place_[sites[i].id] = static_cast<std::uint32_t>(i / kCellSize * kLeafCapacity + i % kCellSize);
    }
    for (std::size_t begin = 0; begin < sites.size(); begin += kCellSize) {
      split_cell(begin, std::min(kCellSize, sites.size() - begin));
    }
    for (const Small& small : small_) merge(small);
  }

  /// By vertex in the order of the cells: the part it belongs to, after merging. Parts are numbered with gaps.
  [[nodiscard]] std::uint32_t part_of(std::size_t site) { return root(part_of_[site]); }

  [[nodiscard]] std::size_t part_count() const { return merged_into_.size(); }

 private:
  /// A part that should not stay alone, and the largest part of its cell.
  struct Small {
    std::size_t cell_begin;
    Lanes lanes;
    std::uint32_t part;
    std::uint32_t home;
  };

  template <class F>
  void for_each_neighbor_site(std::size_t site, F&& f) const {
    for (const VertexId w : adjacency_[sites_[site].id]) {
      const std::uint32_t place = place_[w];
      f(std::size_t{place / kLeafCapacity} * kCellSize + place % kLeafCapacity);
    }
  }

  void split_cell(std::size_t begin, std::size_t size) {
    std::array<Lanes, kLeafCapacity> near{};
    for (std::size_t i = 0; i < size; ++i) {
      // Sites of other cells lie beyond the lanes, above or, wrapped around, below.
      for_each_neighbor_site(begin + i, [&](std::size_t site) {
        if (site - begin < size) near[i] |= Lanes{1} << (site - begin);
      });
    }
    std::array<Lanes, kLeafCapacity> parts{};
    std::size_t count = 0;
    for (Lanes left = first_lanes(static_cast<unsigned>(size)); left != 0; left &= ~parts[count++]) {
      parts[count] = grow(left & -left, near);
    }
    add_parts(begin, std::span(parts).first(count));
  }

  static Lanes grow(Lanes seed, const std::array<Lanes, kLeafCapacity>& near) {
    Lanes reached = seed;
    for (Lanes todo = seed; todo != 0;) {
      const Lanes added = near[static_cast<std::size_t>(std::countr_zero(todo))] & ~reached;
      todo = (todo & (todo - 1)) | added;
      reached |= added;
    }
    return reached;
  }

  void add_parts(std::size_t begin, std::span<Lanes> lanes) {
    const auto largest = std::max_element(lanes.begin(), lanes.end(),
                                          [](Lanes a, Lanes b) { return std::popcount(a) < std::popcount(b); });
    std::swap(*largest, lanes[0]);
    const auto home = static_cast<std::uint32_t>(merged_into_.size());
    for (const Lanes part_lanes : lanes) {
      const auto part = static_cast<std::uint32_t>(merged_into_.size());
      merged_into_.push_back(part);
      size_.push_back(std::popcount(part_lanes));
      for (Lanes left = part_lanes; left != 0; left &= left - 1) {
        part_of_[begin + static_cast<std::size_t>(std::countr_zero(left))] = part;
      }
      if (size_.back() < kSmallPart) small_.push_back({begin, part_lanes, part, home});
    }
  }

  /// Joins a small part to the neighbour that shares most edges with it, of those that have room. One without any
  /// neighbours is a component of the mesh, and stays with the others of its cell: else a cloud of points would cost a
  /// leaf a point.
  void merge(const Small& small) {
    const std::uint32_t part = root(small.part);
    if (size_[part] >= kSmallPart) return;
    neighbors_.clear();
    for (Lanes left = small.lanes; left != 0; left &= left - 1) {
      const std::size_t site = small.cell_begin + static_cast<std::size_t>(std::countr_zero(left));
      for_each_neighbor_site(site, [&](std::size_t other) {
        const std::uint32_t neighbor = root(part_of_[other]);
        if (neighbor != part) neighbors_.push_back(neighbor);
      });
    }
    join(part, neighbors_.empty() ? root(small.home) : best_neighbor(part));
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
    return size_[part] + size_[other] <= static_cast<int>(kLeafCapacity);
  }

  void join(std::uint32_t part, std::uint32_t other) {
    if (part == other || !has_room(part, other)) return;
    merged_into_[part] = other;
    size_[other] += size_[part];
  }

  std::uint32_t root(std::uint32_t part) {
    while (merged_into_[part] != part) part = merged_into_[part] = merged_into_[merged_into_[part]];
    return part;
  }

  std::span<const Site> sites_;
  AdjacencyView adjacency_;
  std::vector<std::uint32_t> place_;    // by vertex: 32 times its cell, plus its lane
  std::vector<std::uint32_t> part_of_;  // by site
  std::vector<std::uint32_t> merged_into_;
  std::vector<int> size_;
  std::vector<Small> small_;
  std::vector<std::uint32_t> neighbors_;  // of the part that is being merged, by edge
};

/// The parts that are left, as the means of their vertices, in the order of the leaves.
std::vector<Site> order_parts(std::span<const Site> sites, Parts& parts) {
  std::vector<std::array<double, 3>> sum(parts.part_count());
  std::vector<unsigned> size(parts.part_count());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::uint32_t part = parts.part_of(i);
    for (std::size_t axis = 0; axis < 3; ++axis) sum[part][axis] += static_cast<double>(sites[i].at[axis]);
    ++size[part];
  }
  std::vector<Site> centres;
  for (std::uint32_t part = 0; part < size.size(); ++part) {
    if (size[part] == 0) continue;
    const auto mean = [&](std::size_t axis) { return static_cast<float>(sum[part][axis] / size[part]); };
    centres.push_back({{mean(0), mean(1), mean(2)}, part});
  }
  kd_order_nested(centres, kFanOut);
  return centres;
}

}  // namespace

LeafPartition make_leaves(const GraphView& graph, const Frame& frame) {
  std::vector<Site> sites = make_sites(graph.positions, frame);
  kd_order(sites, kCellSize);
  Parts parts(sites, graph.adjacency);
  const std::vector<Site> centres = order_parts(sites, parts);

  std::vector<LeafId> leaf_of_part(parts.part_count());
  for (std::size_t leaf = 0; leaf < centres.size(); ++leaf) leaf_of_part[centres[leaf].id] = static_cast<LeafId>(leaf);

  LeafPartition result;
  result.place.resize(sites.size());
  result.permutation.resize(sites.size());
  result.leaf_begin.assign(centres.size() + 1, 0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const LeafId leaf = leaf_of_part[parts.part_of(i)];
    result.place[sites[i].id] = leaf;
    ++result.leaf_begin[leaf + 1];
  }
  std::partial_sum(result.leaf_begin.begin(), result.leaf_begin.end(), result.leaf_begin.begin());
  // In the order of the caller's vertices, so that neighbours in a leaf stay neighbours.
  std::vector<std::uint8_t> filled(centres.size(), 0);
  for (std::size_t v = 0; v < sites.size(); ++v) {
    const LeafId leaf = result.place[v];
    const std::uint32_t lane = filled[leaf]++;
    result.place[v] = leaf * kLeafCapacity + lane;
    result.permutation[result.leaf_begin[leaf] + lane] = static_cast<VertexId>(v);
  }
  return result;
}

}  // namespace meshhood
