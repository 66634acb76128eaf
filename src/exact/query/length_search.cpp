// SPDX-License-Identifier: MIT
#include "exact/query/length_search.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "exact/query/path_search.h"
#include "exact/query/ring_search.h"
#include "exact/query/vertex_rings.h"
#include "exact/search/vertex_bfs.h"
#include "exact/vertex_set.h"

namespace meshhood {
namespace {

class PathLengthSearch final : public LengthSearch {
 public:
  PathLengthSearch(const IndexView& index, KeptGraph& graph) : LengthSearch(index), paths_(index, graph) {}

  void run(std::span<const Path> starts, double radius, const IsEnough& is_enough) override {
    paths_.run(starts, radius,
               [&](std::span<const Path> found) { return is_enough && is_enough(without_ignored(found)); });
  }

  std::span<const Path> found() override { return without_ignored(paths_.found()); }
  std::span<const Path> in_order() override { return without_ignored(paths_.found_in_order()); }

 private:
  std::span<const Path> without_ignored(std::span<const Path> paths) {
    if (index_->ignored.empty()) return paths;
    some_.clear();
    for (const Path& path : paths) {
      if (!index_->is_ignored_at(path.end)) some_.push_back(path);
    }
    return some_;
  }

  PathSearch paths_;
  std::vector<Path> some_;
};

class RingLengthSearch final : public LengthSearch {
 public:
  RingLengthSearch(const IndexView& index, KeptGraph& graph, const Kernels& kernels)
      : LengthSearch(index), by_leaf_(index, kernels) {
    if (is_unlike_a_surface(index)) by_vertex_.emplace(index, graph);
  }

  void run(std::span<const Path> starts, double radius, const IsEnough& is_enough) override {
    const std::uint32_t slot = index_->slot_at(starts.front().end);
    found_.clear();
    subsets_.clear();
    by_vertex_ ? run_by_vertex(slot, radius, is_enough) : run_by_leaf(slot, radius, is_enough);
  }

  std::span<const Path> found() override { return found_; }
  std::span<const Path> in_order() override { return found_; }

  void collect(std::vector<LeafSubset>& subsets) override {
    if (by_vertex_) return LengthSearch::collect(subsets);
    subsets.insert(subsets.end(), subsets_.begin(), subsets_.end());
  }

 private:
  /// With twice as many rings each time, so that all searches take at most about twice as long as the last; at once if
  /// all are wanted.
  void run_by_vertex(std::uint32_t slot, double radius, const IsEnough& is_enough) {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    const auto most = static_cast<std::uint32_t>(std::min(radius, kMost));
    std::size_t known = 0;  // rings
    for (std::uint32_t count = is_enough ? std::min(most, 1U) : most;; count = count > most / 2 ? most : 2 * count) {
      by_vertex_->run(slot, count);
      const std::vector<std::vector<std::uint32_t>> rings = by_vertex_->rings();
      for (; known < rings.size(); ++known) {
        const std::size_t before = found_.size();
        for (const std::uint32_t place : rings[known]) found_.push_back({static_cast<double>(known), place});
        if (is_enough && is_enough(std::span(found_).subspan(before))) return;
      }
      if (count == most || rings.size() <= count) return;
    }
  }

  void run_by_leaf(std::uint32_t slot, double radius, const IsEnough& is_enough) {
    double edges = 0;
    for (by_leaf_.start(slot); edges <= radius && !by_leaf_.ring().empty(); by_leaf_.advance()) {
      const std::size_t before = found_.size();
      ring_.assign(by_leaf_.ring().begin(), by_leaf_.ring().end());
      std::ranges::sort(ring_, {}, &LeafSubset::leaf);
      for (const auto& [leaf, all] : ring_) {
        const LaneMask lanes = all & ~index_->ignored_lanes(leaf);
        if (lanes == 0) continue;
        subsets_.push_back({leaf, lanes});
        const std::uint32_t first = index_->leaf_begin[leaf];
        for_each_lane(lanes, [&](unsigned lane) { found_.push_back({edges, first + lane}); });
      }
      if (is_enough && is_enough(std::span(found_).subspan(before))) return;
      ++edges;
    }
  }

  RingSearch by_leaf_;
  std::optional<VertexRings> by_vertex_;  // for a graph unlike a surface, instead
  std::vector<LeafSubset> ring_;
  std::vector<Path> found_;
  std::vector<LeafSubset> subsets_;  // the same, leaf by leaf
};

}  // namespace

void LengthSearch::collect(std::vector<LeafSubset>& subsets) {
  for (const Path& path : found()) {
    const std::uint32_t slot = index_->slot_at(path.end);
    subsets.push_back({leaf_of(slot), LaneMask{1} << lane_of(slot)});
  }
}

std::unique_ptr<LengthSearch> make_length_search(const IndexView& index, KeptGraph& graph, Metric metric,
                                                 const Kernels& kernels) {
  if (metric == Metric::Path) return std::make_unique<PathLengthSearch>(index, graph);
  return std::make_unique<RingLengthSearch>(index, graph, kernels);
}

}  // namespace meshhood
