// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/search.h"

#include "base/epoch_array.h"
#include "exact/joint/packet_answer.h"
#include "exact/layout.h"
#include "exact/query/path_search.h"
#include "exact/weighted_graph.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// A set of numbers that wait, in blocks of 32. A block is swept up and down until it is empty, then the next block
/// that is not, and again from the first to which numbers were added meanwhile. So a number that is added several times
/// in a sweep is taken once, and what follows from it far ahead waits until it is settled. To sweep in both directions
/// halves the sweeps that the algorithm of Bellman and Ford needs (Yen 1970).
class PathFront {
 public:
  /// Empties the set, for numbers below `size`.
  void reset(std::size_t size) {
    blocks_.assign((size + kBlock - 1) / kBlock, 0);
    next_ = blocks_.size();
  }

  void add(std::uint32_t number) {
    assert(number / kBlock < blocks_.size());
    blocks_[number / kBlock] |= std::uint32_t{1} << number % kBlock;
    next_ = std::min<std::size_t>(next_, number / kBlock);
  }

  /// Calls `f(number)`, which may add numbers, until none is left.
  template <class F>
  void run(F&& f) {
    while (next_ < blocks_.size()) {
      const std::size_t block = next_++;
      const auto take = [&](int bit) {
        blocks_[block] &= ~(std::uint32_t{1} << bit);
        f(static_cast<std::uint32_t>(block * kBlock) + static_cast<std::uint32_t>(bit));
      };
      while (blocks_[block] != 0) {
        for (std::uint32_t left = blocks_[block]; left != 0;) {
          const int bit = std::countr_zero(left);
          take(bit);
          left = blocks_[block] & ~std::uint32_t{0} << bit;
        }
        for (std::uint32_t left = blocks_[block]; left != 0;) {
          const int bit = 31 - std::countl_zero(left);
          take(bit);
          left = blocks_[block] & ~std::uint32_t{0} >> (31 - bit);
        }
      }
    }
  }

 private:
  static constexpr std::size_t kBlock = 32;

  std::vector<std::uint32_t> blocks_;
  std::size_t next_ = 0;  // all blocks before are empty, except that which is swept
};

/// A query along the edges: a vertex in index order, and a radius.
struct PathQuery {
  std::uint32_t vertex;
  double radius;
};

/// Limits what a search for several queries may take, before each is answered alone.
struct PathLimits {
  std::size_t vertices = std::size_t{1} << 15;  ///< of more, the lengths would leave the cache
  std::size_t steps = 16;                       ///< how many times it takes each vertex, in the mean
};

/// Finds the shortest paths along the edges from up to 32 vertices at once, with a length for each of them at each
/// vertex. See docs/joint.md. It is best for vertices of one leaf, whose paths have most vertices in common.
///
/// A search from all of them together, `PathSearch`, finds the vertices that any of them reaches, and numbers these in
/// the order of the shortest path. Then lengths are passed on over the edges, in the order of the numbers, until no
/// edge makes one shorter. Far from the sources, paths from each of them lead on in this order. So most vertices are
/// taken once or twice for all queries together.
///
/// Lengths have the bits that `PathSearch` finds for each vertex alone. Let the length of a path be the sum of its
/// edges in their order, each addition rounded. When no edge makes a length shorter, the length at a vertex is that of
/// a path to it; and it is at most that of any other path, by induction over the edges of that path, because a rounded
/// sum never decreases if a summand grows. So it is the least of all, which does not depend on the order of the steps.
/// This holds for both searches. Both leave out vertices that no path within the radius leads to; a path that passes
/// one is not within the radius either, because it is not shorter than its beginning.
///
/// Each thread needs its own. It owns, besides its `PathSearch`, 4 bytes for each vertex and 8 for each leaf of the
/// mesh, and 0.4 kB for each vertex that it reaches, up to its limit. What is found does not depend on earlier calls.
class PathPacket final : public PacketLengths {
 public:
  PathPacket(const IndexView& index, KeptGraph& graph, Isa isa, const PathLimits& limits = {});

  /// Finds the paths from 1 to 32 vertices, each within the radius of its query. Returns false if that would exceed the
  /// limits; then `run_single` is to be called for each.
  [[nodiscard]] bool run(std::span<const PathQuery> queries);

  /// Does the same for one query, in a search of its own.
  void run_single(const PathQuery& query);

  // These results are those of the queries of the last run that succeeded, without ignored vertices.

  /// Returns the number of vertices that each reaches.
  [[nodiscard]] PerLane<std::uint64_t> counts();

  /// Returns the paths of a query, that to its vertex first, the others ascending by length, then by vertex in index
  /// order. They are valid until the next call.
  [[nodiscard]] std::span<const Path> paths_in_order(std::size_t query);

  /// Returns the leaves of which a query reaches vertices, ascending. They are valid until the next run.
  [[nodiscard]] std::span<const Piece> pieces();

  void select(LeafId leaf) override;
  [[nodiscard]] const PathLengths& at(unsigned lane) override;

  /// Returns how many times the last `run` took a vertex.
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  /// The vertices of a leaf that were found.
  struct LeafPlaces {
    LeafId leaf;
    LaneMask lanes;                                   // those that are not ignored
    std::array<std::uint32_t, kLeafCapacity> number;  // by lane
  };

  void begin(std::span<const PathQuery> queries);
  [[nodiscard]] PathLengths limits() const;
  void list_edges();
  [[nodiscard]] bool pass_on_lengths();
  void leave_out_ignored();
  void list_leaves();
  [[nodiscard]] const PathLengths& lengths_of(std::uint32_t number);
  [[nodiscard]] std::uint32_t vertex(std::size_t number) const { return search_.found()[number].end; }

  const IndexView* index_;
  const WeightedGraph* graph_;
  const PathKernels* kernels_;
  const JointKernels* joint_kernels_;
  PathLimits limits_;
  PathSearch search_;                   // its paths number the vertices that were found
  std::vector<std::uint32_t> numbers_;  // by vertex; kNoNumber outside `list_edges`
  // These are by number.
  std::vector<std::size_t> first_edge_;  // in `edges_`; and the end of the last
  std::vector<PathLengths> lengths_;
  std::vector<PathEdge> edges_;  // to vertices that were found
  PathFront waiting_;            // those whose lengths became shorter, and were not passed on
  std::size_t steps_ = 0;
  std::vector<PathQuery> queries_;
  PerLane<std::uint32_t> starts_{};  // the numbers of their vertices; kNoNumber for a wall
  bool is_single_ = false;           // there is one query, and its paths are those of `search_`
  // These are made when they are asked for.
  std::vector<LeafWords> words_;  // by number, 32 of them in each
  std::vector<LeafOfWords> list_of_words_;
  std::vector<Path> paths_;  // of a query, and room for more
  PathOrder order_;
  EpochArray<std::uint32_t> place_of_;  // by leaf: in `leaves_`
  std::vector<LeafPlaces> leaves_;
  const LeafPlaces* selected_ = nullptr;
  PathLengths single_{};  // of the one query: infinite for others
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> reached_;  // by piece
};

}  // namespace meshhood::inline v0_1
