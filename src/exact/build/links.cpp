// SPDX-License-Identifier: MIT
// The edges come in the order of the polygons. They are distributed to buckets of consecutive leaves, then within each
// bucket to leaves, so that all that is looked up stays in the cache.
#include "exact/build/links.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace meshhood::inline v0_1 {
namespace {

// A chunk of this size takes much longer than passing it to a thread.
constexpr std::size_t kPolygonsPerTask = 4096;

/// Divides the leaves into ranges of equal size.
class Buckets {
 public:
  explicit Buckets(std::size_t leaves) : leaves_(leaves) {
    constexpr std::size_t kLeaves = 256;  // their masks and edges fit into the second cache
    constexpr std::size_t kFewest = 10;   // with so many, several threads have some of a small mesh
    constexpr std::size_t kMost = 1024;   // with more, a thread would write to memory that is seldom in its cache
    leaves_each_ = std::max(std::min(kLeaves, std::bit_floor(leaves / kFewest)), std::bit_ceil(leaves / kMost));
    shift_ = static_cast<unsigned>(std::countr_zero(leaves_each_ * kLeafCapacity));
  }

  [[nodiscard]] std::size_t count() const { return (leaves_ + leaves_each_ - 1) / leaves_each_; }
  [[nodiscard]] std::size_t of(std::uint32_t slot) const { return slot >> shift_; }
  [[nodiscard]] LeafId begin(std::size_t bucket) const { return static_cast<LeafId>(bucket * leaves_each_); }
  [[nodiscard]] LeafId end(std::size_t bucket) const {
    return static_cast<LeafId>(std::min(leaves_, (bucket + 1) * leaves_each_));
  }

 private:
  std::size_t leaves_;
  std::size_t leaves_each_;
  unsigned shift_;
};

EdgeBuckets distribute(const EdgeSource& edges, std::span<const std::uint32_t> slot, const Buckets& buckets,
                       TaskContext& task) {
  EdgeBuckets result(task.threads(), buckets.count());
  task.parallel_for(edges.size(), kPolygonsPerTask, [&](unsigned thread, std::size_t begin, std::size_t end) {
    edges.for_each(begin, end, [&](VertexId v, VertexId w) {
      const std::uint32_t a = slot[v];
      const std::uint32_t b = slot[w];
      result.add(thread, buckets.of(a), {a, b});
      if (buckets.of(a) != buckets.of(b)) result.add(thread, buckets.of(b), {b, a});
    });
  });
  return result;
}

/// Links the leaves of one bucket after the other; each thread has one.
class Linker {
 public:
  Linker(const Buckets& buckets, std::span<const VertexId> begin, std::span<LaneMask> adjacency)
      : buckets_(buckets), begin_(begin), adjacency_(adjacency), collector_(begin.size() - 1) {}

  Links link(std::size_t bucket, EdgeBuckets& edges) {
    take(bucket, edges);
    sort_by_leaf(bucket);
    Links result;
    for (LeafId leaf = buckets_.begin(bucket); leaf < buckets_.end(bucket); ++leaf) {
      const std::size_t i = leaf - buckets_.begin(bucket);
      collector_.begin();
      for (std::size_t exit = i == 0 ? 0 : ends_[i - 1]; exit < ends_[i]; ++exit) {
        collector_.add(lane_of(sorted_[exit].from), sorted_[exit].to);
      }
      collector_.finish(result);
    }
    return result;
  }

 private:
  /// Sets the edges within leaves, and collects the others, in both directions.
  void take(std::size_t bucket, EdgeBuckets& edges) {
    exits_.clear();
    std::fill(adjacency_.begin() + begin_[buckets_.begin(bucket)], adjacency_.begin() + begin_[buckets_.end(bucket)],
              LaneMask{0});
    edges.take(bucket, [&](const SlotEdge& edge) {
      const bool is_inside = buckets_.of(edge.to) == bucket;
      if (leaf_of(edge.from) == leaf_of(edge.to)) {
        join(edge.from, edge.to);
        join(edge.to, edge.from);
      } else {
        exits_.push_back(edge);
        if (is_inside) exits_.push_back({edge.to, edge.from});
      }
    });
  }

  void join(std::uint32_t slot, std::uint32_t other) {
    adjacency_[begin_[leaf_of(slot)] + lane_of(slot)] |= LaneMask{1} << lane_of(other);
  }

  void sort_by_leaf(std::size_t bucket) {
    const LeafId first = buckets_.begin(bucket);
    ends_.assign(buckets_.end(bucket) - first, 0);
    for (const SlotEdge& exit : exits_) ++ends_[leaf_of(exit.from) - first];
    std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), std::size_t{0});
    sorted_.resize(exits_.size());
    for (const SlotEdge& exit : exits_) sorted_[ends_[leaf_of(exit.from) - first]++] = exit;
  }

  const Buckets& buckets_;
  std::span<const VertexId> begin_;
  std::span<LaneMask> adjacency_;
  LinkCollector collector_;
  std::vector<SlotEdge> exits_;
  std::vector<SlotEdge> sorted_;   // by leaf
  std::vector<std::size_t> ends_;  // by leaf of the bucket: the end of its exits
};

}  // namespace

Links make_links(const EdgeSource& edges, std::span<const std::uint32_t> slot, std::span<const VertexId> begin,
                 TaskContext& task) {
  const Buckets buckets(begin.size() - 1);
  EdgeBuckets distributed = distribute(edges, slot, buckets, task);
  RawVector<LaneMask> adjacency(slot.size());
  std::vector<Links> runs(buckets.count());
  std::vector<Linker> linkers(std::min<std::size_t>(task.threads(), runs.size()), {buckets, begin, adjacency});
  task.parallel_for(runs.size(), 1, [&](unsigned thread, std::size_t bucket, std::size_t) {
    runs[bucket] = linkers[thread].link(bucket, distributed);
  });
  Links result = join_runs(runs);
  result.adjacency = std::move(adjacency);
  return result;
}

Links join_runs(std::span<const Links> runs) {
  Links all;
  std::size_t leaves = 0;
  std::size_t links = 1;
  std::size_t cross_edges = 0;
  for (const Links& run : runs) {
    leaves += run.link_end.size();
    links += run.links.size();
    cross_edges += run.cross_edges.size();
  }
  all.link_end.reserve(leaves);
  all.links.reserve(links);
  all.cross_edges.reserve(cross_edges + kLeafCapacity);  // and the padding of an index
  for (const Links& run : runs) {
    const auto first_link = static_cast<std::uint32_t>(all.links.size());
    const auto first_cross_edge = static_cast<std::uint32_t>(all.cross_edges.size());
    for (const std::uint32_t end : run.link_end) all.link_end.push_back(first_link + end);
    for (const Link& link : run.links) {
      all.links.push_back({link.leaf, link.boundary, first_cross_edge + link.first_cross_edge});
    }
    all.cross_edges.insert(all.cross_edges.end(), run.cross_edges.begin(), run.cross_edges.end());
  }
  all.links.push_back({0, 0, static_cast<std::uint32_t>(all.cross_edges.size())});
  return all;
}

bool is_connected(const LaneMask* adjacency, unsigned size) {
  return size == 0 || reachable_lanes(adjacency, 1) == first_lanes(size);
}

}  // namespace meshhood::inline v0_1
