// SPDX-License-Identifier: MIT
// One search for up to 32 queries from a leaf: the packet of queries, and how they spread over the leaves of a group.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "exact/joint/group.h"
#include "exact/layout.h"
#include "simd/joint.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// A radius in the forms that are compared: in the frame, and exactly.
struct JointRadius {
  double radius;
  double squared;  // of the predicate
  TreeBounds bounds;
  double inner_squared;  // of `bounds`; minus infinity if it is no ball
  double outer_squared;

  JointRadius(const Frame& frame, double at);
};

/// A query of a packet: a vertex of its leaf, and a radius.
struct JointQuery {
  unsigned lane;
  JointRadius radius;
};

/// Up to 32 queries from one leaf, ready to be compared with spheres and vertices.
class Packet {
 public:
  /// `queries` are 1 to 32 from `leaf`, which is one of those that `group` began with.
  Packet(const IndexView& index, const JointGroup& group, LeafId leaf, std::span<const JointQuery> queries);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Returns the queries whose vertex is not a wall. The others have no ball.
  [[nodiscard]] QueryWord queries() const { return balls_.queries; }
  [[nodiscard]] const PacketBalls& balls() const { return balls_; }
  [[nodiscard]] LeafId leaf() const { return leaf_; }
  [[nodiscard]] unsigned lane(std::size_t query) const { return lanes_[query]; }

  /// Returns a ball around the leaf, with `outer` around all balls, and `inner` within each.
  [[nodiscard]] const TreeBall& ball() const { return ball_; }

  /// Applies the exact predicate.
  [[nodiscard]] bool holds(std::size_t query, const Point& vertex) const {
    return squared_distance(vertex, index_->position(leaf_, lanes_[query])) <= squared_radii_[query];
  }

 private:
  void set_balls(const JointGroup& group, std::span<const JointQuery> queries);

  const IndexView* index_;
  LeafId leaf_;
  std::size_t size_;
  TreeBall ball_;
  PacketBalls balls_;
  std::array<unsigned, kPacketCapacity> lanes_;
  std::array<double, kPacketCapacity> squared_radii_;
};

/// A set of pending entries, a bit for each. They are taken in ascending order, sweep by sweep: entries that were
/// discovered early, near the group, come first, and one that gains several times in one sweep is taken once.
class Worklist {
 public:
  /// Empties the list, for entries below `size`.
  void reset(std::size_t size) { words_.assign((size + 63) / 64, 0); }

  void add(std::uint32_t entry) {
    assert(entry / 64 < words_.size());
    words_[entry / 64] |= std::uint64_t{1} << entry % 64;
    again_ |= entry / 64 < at_;
  }

  /// Calls `f(entry)`, which may add entries, until none is left.
  template <class F>
  void run(F&& f) {
    do {
      again_ = false;
      for (at_ = 0; at_ < words_.size(); ++at_) {
        while (words_[at_] != 0) {
          const auto bit = static_cast<std::uint32_t>(std::countr_zero(words_[at_]));
          words_[at_] &= words_[at_] - 1;
          f(static_cast<std::uint32_t>(at_) * 64 + bit);
        }
      }
    } while (again_);
  }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t at_ = 0;
  bool again_ = false;
};

/// Compares the entries of a group with the balls of a packet, and finds what its queries reach there, by a
/// breadth-first search for all queries at once. A query reaches a vertex if its ball holds the vertex and the query
/// reaches a neighbor of the vertex. Words only grow, and an entry that has gained pushes its words over its links. So
/// the search ends, and its result is exactly the components.
class JointSpread {
 public:
  JointSpread(const IndexView& index, Isa isa)
      : index_(&index), kernels_(&joint_kernels(isa)), tree_kernels_(&kernels(isa)) {}

  /// Finds what the queries of `packet` reach.
  void run(JointGroup& group, const Packet& packet);

  /// Returns the entries that lie in all balls, and were reached.
  [[nodiscard]] std::span<const GroupEntry> whole() const { return whole_; }
  /// Returns the queries that reach such an entry, and so all of its vertices.
  [[nodiscard]] QueryWord whole_word(GroupEntry entry) const { return states_[entry].word; }

  /// Returns the other leaves that were reached: their words are those of `words()` at the entry.
  [[nodiscard]] std::span<const LeafOfWords> partial() const { return partial_; }
  [[nodiscard]] const LeafWords* words() const { return words_.data(); }

 private:
  enum class Kind : std::uint8_t { Outside, Whole, Partial };

  struct State {
    Kind kind;
    bool closed;       // nothing can be added
    bool is_touched;   // words_ are those of this packet
    bool has_inside;   // and so are the words `inside`
    QueryWord word;    // whole: the queries that reach it; partial: those whose ball holds all of the leaf
    QueryWord pushed;  // whole: the queries that were pushed on
  };

  void leave_out_ignored(const JointGroup& group);
  void classify(const JointGroup& group, const Packet& packet);
  void start(const JointGroup& group, const Packet& packet);
  void take(JointGroup& group, const Packet& packet, GroupEntry entry);
  void take_whole(JointGroup& group, const Packet& packet, GroupEntry entry);
  void take_partial(JointGroup& group, const Packet& packet, GroupEntry entry);
  void find_inside(JointGroup& group, const Packet& packet, GroupEntry entry);
  void push_leaf(JointGroup& group, const Packet& packet, GroupEntry entry, LaneMask gained);
  void push_over(const Packet& packet, const PerLane<QueryWord>& reached, const JointGroup::EntryLink& link);
  template <class F>
  void push(const Packet& packet, GroupEntry entry, QueryWord word, F&& f);
  void add_to_whole(const Packet& packet, GroupEntry entry, QueryWord word);
  PerLane<QueryWord>& pending(GroupEntry entry);

  const IndexView* index_;
  const JointKernels* kernels_;
  const Kernels* tree_kernels_;
  std::vector<std::uint32_t> numbers_;  // 0, 1, 2 ...
  std::vector<GroupContainment> sides_;
  std::vector<State> states_;
  std::vector<LeafWords> words_;  // by entry
  Worklist worklist_;
  std::vector<GroupEntry> whole_;
  std::vector<LeafOfWords> partial_;
};

/// Answers up to 32 queries of one leaf at once: the exact neighborhoods, as `Searcher` finds them one by one. See
/// docs/joint.md. Each thread needs its own, which owns 4 bytes a leaf of the mesh, and 1 kB for each leaf that the
/// balls of a group may meet. What is found does not depend on earlier calls.
class JointSearch {
 public:
  JointSearch(const IndexView& index, Isa isa);

  /// Begins with a group: `leaves` belong to one node above the leaves, and the radii of its queries lie between `low`
  /// and `high`.
  void begin_group(std::span<const LeafId> leaves, const TreeBounds& low, const TreeBounds& high) {
    group_.begin(leaves, low, high);
  }

  /// Finds the neighborhoods of 1 to 32 vertices of `leaf`, which is one of the group.
  void run(LeafId leaf, std::span<const JointQuery> queries);

  // These results are those of the queries of the last `run`.

  /// Returns the number of vertices in each neighborhood.
  [[nodiscard]] const PerLane<std::uint64_t>& counts();

  /// Returns the queries whose vertex is not a wall.
  [[nodiscard]] QueryWord queries() const { return packet_->queries(); }

  /// Returns the neighborhoods, valid until the next `run`. In index order, adjacent runs of the same queries are one.
  [[nodiscard]] std::span<const Piece> pieces(bool in_order);

 private:
  void put_in_order();

  const IndexView* index_;
  const JointKernels* kernels_;
  JointGroup group_;
  JointSpread spread_;
  std::optional<Packet> packet_;
  PerLane<std::uint64_t> counts_{};
  std::vector<Piece> pieces_;
};

}  // namespace meshhood::inline v0_1
