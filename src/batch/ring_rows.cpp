// SPDX-License-Identifier: MIT
// Finds rows by the number of edges: one breadth-first search answers up to 32 queries of a leaf.
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "batch/row_search.h"
#include "exact/index_access.h"
#include "exact/joint/packet_answer.h"
#include "exact/layout.h"
#include "exact/query/ring_search.h"
#include "exact/search/vertex_bfs.h"
#include "exact/weighted_graph.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {
namespace {

/// A query: a vertex of a leaf, and how many edges may separate it from a vertex of its answer.
struct RingQuery {
  unsigned lane;
  std::uint32_t rings;
};

/// Answers up to 32 queries of one leaf at once: a breadth-first search for all of them, a word for each vertex, and
/// one ring after the other (M. Then et al., "The More the Merrier: Efficient Multi-Source Graph Traversal", PVLDB
/// 2014; for sources that lie close together: L. Wang et al., "Cluster-BFS", 2024). A step passes the words that are
/// fresh over the edges of all leaves that have some, so each edge is followed once for all queries that reach it in
/// that step.
///
/// Each thread needs its own. It owns 8 bytes a leaf of the mesh, and 0.7 kB for each leaf of the largest answer. What
/// is found does not depend on earlier calls.
class RingPacket final : public PacketLengths {
 public:
  RingPacket(const IndexView& index, Isa isa)
      : index_(&index), kernels_(&joint_kernels(isa)), entries_(index.leaf_count()) {}

  /// Finds the rings of 1 to 32 vertices of `leaf`.
  void run(LeafId leaf, std::span<const RingQuery> queries) {
    assert(!queries.empty() && queries.size() <= kPacketCapacity);
    entries_.forget();
    states_.clear();
    active_.clear();
    queries_ = first_lanes(static_cast<unsigned>(queries.size()));
    const Entry own = entry_of(leaf);
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      words_[own].pending[queries[i].lane] |= QueryWord{1} << i;
      most = std::max(most, queries[i].rings);
    }
    pending_.assign(1, own);
    step(0, queries_);
    for (std::uint32_t ring = 1; ring <= most && !active_.empty(); ++ring) {
      QueryWord alive = 0;
      for (std::size_t i = 0; i < queries.size(); ++i) alive |= QueryWord{queries[i].rings >= ring} << i;
      pending_ = active_;
      for (const Entry entry : active_) states_[entry].is_pending = true;
      for (const Entry entry : active_) push(entry);
      step(ring, alive);
    }
    finish();
  }

  // The functions below answer for the queries of the last `run`.

  /// Returns how many vertices their answers have.
  [[nodiscard]] PerLane<std::uint64_t> counts() const {
    PerLane<std::uint64_t> counts{};
    kernels_->count_words(words_.data(), found_, counts);
    return counts;
  }

  /// Returns the answers, leaf by leaf in index order. They are valid until the next `run`.
  [[nodiscard]] std::span<const Piece> pieces() {
    pieces_.clear();
    for (const LeafOfWords& found : found_) {
      const LeafId leaf = states_[found.words].leaf;
      pieces_.push_back({{leaf, leaf + 1}, 0, words_[found.words].reached.data()});
    }
    std::ranges::sort(pieces_, {}, [](const Piece& piece) { return piece.leaves.begin; });
    return pieces_;
  }

  /// After a run with one query, the lengths are numbers of edges.
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

  /// Returns the entry of a leaf, which is made when the search first meets it.
  Entry entry_of(LeafId leaf) {
    if (entries_.is_known(leaf)) return entries_[leaf];
    const auto entry = static_cast<Entry>(states_.size());
    entries_.set(leaf, entry);
    states_.push_back({leaf, index_->leaf_begin[leaf], index_->open_lanes(leaf), 0, false, false});
    if (words_.size() <= entry) {
      words_.resize(2 * states_.size());
      fresh_.resize(2 * states_.size());
      edges_.resize(2 * states_.size());
    }
    kernels_->clear_words(words_[entry]);
    return entry;
  }

  /// Pushes the fresh words of a leaf over its links.
  void push(Entry entry) {
    const LaneMask fresh = states_[entry].fresh;
    for (const Link& link : index_->links_of(states_[entry].leaf)) {
      if ((link.boundary & fresh) == 0) continue;
      const Entry other = entry_of(link.leaf);
      push_words(index_->cross_edges_of(link), fresh_[entry], words_[other].pending);
      if (!states_[other].is_pending) {
        states_[other].is_pending = true;
        pending_.push_back(other);
      }
    }
  }

  /// Reaches what is pending, for the queries that have not ended.
  void step(std::uint32_t ring, QueryWord alive) {
    active_.clear();
    for (const Entry entry : pending_) {
      State& state = states_[entry];
      state.is_pending = false;
      state.fresh = kernels_->step_words(words_[entry], fresh_[entry], &index_->adjacency[state.first], state.fresh,
                                         state.open, alive);
      if (state.fresh == 0) continue;
      state.is_reached = true;
      active_.push_back(entry);
      if (queries_ == 1) for_each_lane(state.fresh, [&](unsigned lane) { edges_[entry][lane] = ring; });
    }
  }

  /// Lists what was reached, without the ignored vertices.
  void finish() {
    found_.clear();
    for (Entry entry = 0; entry < states_.size(); ++entry) {
      const LeafId leaf = states_[entry].leaf;
      if (!states_[entry].is_reached) continue;
      for_each_lane(index_->ignored_lanes(leaf), [&](unsigned lane) { words_[entry].reached[lane] = 0; });
      found_.push_back({entry, index_->leaf_begin[leaf]});
    }
  }

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

/// Cuts a radius to 32 bits. This changes no answer, because no path needs more edges than the mesh has vertices.
std::uint32_t rings_of(double radius) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(radius, kMost));
}

/// Finds the rings of a batch: those of a leaf together, with distances one by one; on a graph unlike a surface, vertex
/// by vertex.
class RingRows final : public RowSearch {
 public:
  explicit RingRows(const Index& index)
      : index_(IndexAccess::view(index)), graph_(IndexAccess::share_graph(index)), packet_(index_, best_isa()) {
    if (is_unlike_a_surface(index_)) by_vertex_.emplace(index_, *graph_);
  }

  [[nodiscard]] bool pays(std::span<const BatchItem> /*items*/, bool distances) const override {
    return writes_pieces(distances);
  }

  [[nodiscard]] bool run(std::span<const RowRun> runs) override {
    const std::span<const BatchItem> items = runs.front().items;
    rows_ = static_cast<unsigned>(items.size());
    if (by_vertex_) {
      counts_[0] = by_vertex_->run(items.front().position, rings_of(items.front().radius));
      return true;
    }
    queries_.clear();
    for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), rings_of(item.radius)});
    packet_.run(leaf_of(items.front().position), queries_);
    counts_ = packet_.counts();
    return true;
  }

  [[nodiscard]] const PerLane<std::uint64_t>& counts() override { return counts_; }
  [[nodiscard]] QueryWord queries() const override { return first_lanes(rows_); }
  [[nodiscard]] std::span<const Piece> pieces(bool /*in_order*/) override {
    return by_vertex_ ? by_vertex_->pieces() : packet_.pieces();
  }
  [[nodiscard]] PacketLengths* lengths() override {
    return by_vertex_ ? static_cast<PacketLengths*>(&*by_vertex_) : &packet_;
  }
  [[nodiscard]] bool writes_pieces(bool distances) const override { return !distances && !by_vertex_; }

  bool write(std::span<const BatchItem> items, bool distances, RowReceiver& receiver) override {
    const BatchMemory memory = receiver.memory(items.front().row, counts_[0]);
    std::size_t next = 0;
    for_each([&](std::size_t vertex, double edges) {
      memory.ids[next] = index_.id(vertex);
      if (distances) memory.distances[next] = edges;
      ++next;
    });
    return receiver.done(items.front().row);
  }

 private:
  /// Calls `f(vertex, edges)` for the vertices of the answer of one query, in index order.
  template <class F>
  void for_each(F&& f) {
    if (by_vertex_) {
      for (const std::uint32_t place : by_vertex_->places()) f(place, by_vertex_->edges_to(place));
      return;
    }
    for (const auto& [leaves, queries, reached] : packet_.pieces()) {
      packet_.select(leaves.begin);
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
        if (reached[lane] != 0) f(index_.leaf_begin[leaves.begin] + lane, packet_.at(lane)[0]);
      }
    }
  }

  const IndexView& index_;
  std::shared_ptr<KeptGraph> graph_;
  RingPacket packet_;
  std::optional<VertexRings> by_vertex_;
  // The state of the last run.
  unsigned rows_ = 0;
  std::vector<RingQuery> queries_;
  PerLane<std::uint64_t> counts_{};
};

}  // namespace

std::unique_ptr<RowSearch> make_ring_rows(const Index& index) { return std::make_unique<RingRows>(index); }

}  // namespace meshhood::inline v0_1
