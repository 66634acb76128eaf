// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "exact/joint/packet_answer.h"
#include "exact/layout.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// A query by the number of edges: a vertex of a leaf, and how many edges may separate it from a vertex of its answer.
struct RingQuery {
  unsigned lane;
  std::uint32_t rings;
};

/// Answers up to 32 queries of one leaf at once: a breadth-first search for all of them, a word for each vertex, and
/// one ring after the other (M. Then et al., "The More the Merrier: Efficient Multi-Source Graph Traversal", PVLDB
/// 2014; for sources that lie close together L. Wang et al., "Cluster-BFS", 2024). A step passes the words that are
/// fresh over the edges of all leaves that have some, so each edge is followed once for all queries that reach it in
/// that step.
///
/// One object a thread. Owns 8 bytes a leaf of the mesh, and half a kilobyte for each leaf of an answer. What is found
/// does not depend on earlier calls.
class RingPacket final : public PacketLengths {
 public:
  RingPacket(const IndexView& index, Isa isa)
      : index_(&index), kernels_(&joint_kernels(isa)), entries_(index.leaf_count()) {}

  /// Finds the rings of 1 to 32 vertices of `leaf`.
  void run(LeafId leaf, std::span<const RingQuery> queries);

  // Of the queries of the last `run`:

  /// How many vertices their answers have.
  [[nodiscard]] PerLane<std::uint64_t> counts() const;

  /// The answers, leaf by leaf in index order. Valid until the next `run`.
  [[nodiscard]] std::span<const Piece> pieces();

  /// Of a run with one query: numbers of edges as lengths.
  void select(LeafId leaf) override { selected_ = entries_[leaf]; }
  [[nodiscard]] const PathLengths& at(unsigned lane) override {
    length_[0] = edges_[selected_][lane];
    return length_;
  }

 private:
  using Entry = std::uint32_t;

  /// A leaf that the search has met.
  struct State {
    LeafId leaf;
    std::uint32_t first;  // in index order
    LaneMask open;        // no walls
    LaneMask fresh;       // the lanes that the last step has reached for the first time
    bool is_pending;      // since the last step; then it is in `pending_`
    bool is_reached;
  };

  Entry entry_of(LeafId leaf);
  void push(Entry entry);
  void step(std::uint32_t ring, QueryWord alive);
  void finish();

  const IndexView* index_;
  const JointKernels* kernels_;
  EpochArray<Entry> entries_;  // by leaf
  QueryWord queries_ = 0;
  std::vector<State> states_;
  std::vector<LeafWords> words_;               // by entry, and room for more
  std::vector<FreshWords> fresh_;              // likewise
  std::vector<PerLane<std::uint32_t>> edges_;  // likewise, of a run with one query
  std::vector<Entry> active_;                  // those with fresh lanes
  std::vector<Entry> pending_;                 // those that the next step looks at
  std::vector<LeafOfWords> found_;
  std::vector<Piece> pieces_;
  Entry selected_ = 0;
  PathLengths length_{};
};

}  // namespace meshhood::inline v0_1
