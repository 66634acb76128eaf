// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/epoch_array.h"
#include "exact/build/edge_source.h"
#include "exact/layout.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// An edge, by the slots of its ends.
struct SlotEdge {
  std::uint32_t from;
  std::uint32_t to;
};

/// Edges in buckets, to which several threads add at the same time. Their order depends on the threads.
class EdgeBuckets {
 public:
  EdgeBuckets(unsigned threads, std::size_t buckets) : lists_(threads) {
    for (std::vector<List>& of_thread : lists_) of_thread.resize(buckets);
  }

  /// Only `thread` may call this.
  void add(unsigned thread, std::size_t bucket, const SlotEdge& edge) {
    List& list = lists_[thread][bucket];
    if (list.next == list.end) list.start_block();
    *list.next++ = edge;
  }

  /// Calls `f(edge)` for the edges of a bucket, and frees them.
  template <class F>
  void take(std::size_t bucket, F&& f) {
    for (std::vector<List>& of_thread : lists_) {
      List& list = of_thread[bucket];
      for (const Block& block : list.blocks) {
        const SlotEdge* const end = &block == &list.blocks.back() ? list.next : block.get() + kBlockSize;
        for (const SlotEdge* edge = block.get(); edge != end; ++edge) f(*edge);
      }
      list = {};
    }
  }

 private:
  static constexpr std::size_t kBlockSize = 512;
  using Block = std::unique_ptr<SlotEdge[]>;  // NOLINT(modernize-avoid-c-arrays): a vector would write to all of it

  struct List {
    SlotEdge* next = nullptr;  // in the last block, which ends at `end`
    SlotEdge* end = nullptr;
    std::vector<Block> blocks;

    void start_block() {
      blocks.push_back(std::make_unique_for_overwrite<SlotEdge[]>(kBlockSize));  // NOLINT(modernize-avoid-c-arrays)
      next = blocks.back().get();
      end = next + kBlockSize;
    }
  };

  std::vector<std::vector<List>> lists_;  // by thread, then by bucket
};

/// The edges of the mesh by leaf, or by cell, which then takes the place of a leaf.
struct Links {
  RawVector<LaneMask> adjacency;        // in the order of the leaves: the neighbors in the same leaf
  std::vector<std::uint32_t> link_end;  // by leaf: the end of its links
  std::vector<Link> links;              // by leaf, then by linked leaf; one more, for the end of the last cross edges
  std::vector<CrossEdge> cross_edges;   // by link, then by `from`, then by `to`

  [[nodiscard]] std::span<const Link> links_of(std::size_t leaf) const {
    assert(leaf < link_end.size());
    const std::size_t begin = leaf == 0 ? 0 : link_end[leaf - 1];
    return std::span(links).subspan(begin, link_end[leaf] - begin);
  }

  /// `link` must be an element of `links`.
  [[nodiscard]] std::span<const CrossEdge> cross_edges_of(const Link& link) const {
    assert(&link >= links.data() && &link + 1 < links.data() + links.size());
    const std::size_t end = (&link + 1)->first_cross_edge;
    return std::span(cross_edges).subspan(link.first_cross_edge, end - link.first_cross_edge);
  }
};

/// Gathers every edge of the mesh in both directions.
///
/// slot   by vertex: 32 times its leaf, plus its lane
/// begin  by leaf, and one more: its first vertex in the order of the leaves
/// Throws Error{Cancelled}. O(#V + edges of the source).
[[nodiscard]] Links make_links(const EdgeSource& edges, std::span<const std::uint32_t> slot,
                               std::span<const VertexId> begin, TaskContext& task);

/// Joins the links of consecutive runs of leaves, each numbered from 0. The result has no `adjacency`.
[[nodiscard]] Links join_runs(std::span<const Links> runs);

/// Returns whether the `size` vertices of a leaf are connected by the edges between them; true for one and for none.
[[nodiscard]] bool is_connected(const LaneMask* adjacency, unsigned size);

/// Returns the lanes of a leaf that can be reached from `from` by the edges within the leaf, `from` included.
/// `adjacency[i]` has the neighbors of lane `i`.
[[nodiscard]] inline LaneMask reachable_lanes(const LaneMask* adjacency, LaneMask from) {
  LaneMask reached = from;
  for (LaneMask todo = from; todo != 0;) {
    const LaneMask added = adjacency[std::countr_zero(todo)] & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

/// Collects the edges that leave one leaf after the other, each edge any number of times and in any order, and makes
/// links of them. Edges to one other leaf are a matrix of bits, in which repeated ones are one and which is read in the
/// order of cross edges, so nothing but the linked leaves is sorted.
class LinkCollector {
 public:
  explicit LinkCollector(std::size_t leaves) : number_(leaves) {}

  void begin() {
    number_.forget();
    linked_.clear();
  }

  /// Adds an edge from `lane` of the leaf to the vertex at `slot`, in another leaf.
  void add(unsigned lane, std::uint32_t slot) {
    const LeafId leaf = leaf_of(slot);
    if (!number_.is_known(leaf)) start(leaf);
    Edges& edges = edges_[number_[leaf]];
    edges.boundary |= LaneMask{1} << lane;
    edges.to[lane] |= LaneMask{1} << lane_of(slot);
  }

  /// Appends the links of the leaf, which ascend, and their cross edges to `out`.
  void finish(Links& out) {
    std::sort(linked_.begin(), linked_.end());
    for (const LeafId leaf : linked_) {
      const Edges& edges = edges_[number_[leaf]];
      out.links.push_back({leaf, edges.boundary, static_cast<std::uint32_t>(out.cross_edges.size())});
      for_each_lane(edges.boundary, [&](unsigned from) {
        for_each_lane(edges.to[from], [&](unsigned to) {
          out.cross_edges.push_back({static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to)});
        });
      });
    }
    out.link_end.push_back(static_cast<std::uint32_t>(out.links.size()));
  }

 private:
  /// The edges to one other leaf.
  struct Edges {
    LaneMask boundary = 0;                     // the lanes that have one
    std::array<LaneMask, kLeafCapacity> to{};  // by lane of this leaf: lanes of the other
  };

  void start(LeafId leaf) {
    const std::size_t number = linked_.size();
    number_.set(leaf, static_cast<std::uint32_t>(number));
    linked_.push_back(leaf);
    if (number == edges_.size()) edges_.emplace_back();
    edges_[number] = {};
  }

  EpochArray<std::uint32_t> number_;  // by leaf: its place in `edges_`
  std::vector<LeafId> linked_;
  std::vector<Edges> edges_;  // grows, and is used again for the next leaf
};

}  // namespace meshhood::inline v0_1
