// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "exact/layout.h"
#include "exact/query/any_center.h"
#include "exact/vertex_set.h"
#include "simd/ball.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Holds leaves that a flood has met and cannot enter yet, each with a bound: the flood can enter a leaf when its ball
/// has reached that bound.
///
/// They are a list, because a flood that grows in few steps wakes them in bulk. The first call of `first` makes the
/// list a heap.
class Sleepers {
 public:
  void clear() {
    entries_.clear();
    is_heap_ = false;
  }

  [[nodiscard]] bool empty() const { return entries_.empty(); }

  void add(LeafId leaf, double bound) {
    entries_.push_back({bound, leaf});
    if (is_heap_) std::push_heap(entries_.begin(), entries_.end(), later);
  }

  struct Entry {
    double bound;
    LeafId leaf;
  };

  /// Returns an entry with the smallest bound. There must be one.
  [[nodiscard]] Entry first() {
    assert(!empty());
    if (!is_heap_) std::make_heap(entries_.begin(), entries_.end(), later);
    is_heap_ = true;
    return entries_.front();
  }

  /// Removes the entry that `first` returned.
  void remove_first() {
    assert(is_heap_ && !empty());
    std::pop_heap(entries_.begin(), entries_.end(), later);
    entries_.pop_back();
  }

  /// Removes the entries whose bound is at most `bound`, and calls `f(entry)` for each. `f` must not add entries.
  template <class F>
  void wake(double bound, F&& f) {
    if (is_heap_) {
      for (; !empty() && entries_.front().bound <= bound; remove_first()) f(entries_.front());
      return;
    }
    std::erase_if(entries_, [&](const Entry& entry) {
      if (!(entry.bound <= bound)) return false;
      f(entry);
      return true;
    });
  }

 private:
  static bool later(const Entry& a, const Entry& b) { return a.bound != b.bound ? a.bound > b.bound : a.leaf > b.leaf; }

  std::vector<Entry> entries_;
  bool is_heap_ = false;
};

/// Searches all regions: it spreads along the edges from seeds through a ball that grows, a leaf at a time, and never
/// searches again what it has reached. A leaf that is connected and lies inside the ball is reached as a whole.
///
/// A leaf that the search has met, and that has vertices outside the ball, sleeps until the ball has grown.
class Flood {
 public:
  Flood(const IndexView& index, const Kernels& kernels);

  /// Begins around `center`, with nothing reached.
  void start(const Point& center);

  /// Adds a seed: it is reached when the ball holds it, unless it is a wall.
  void add_seed(std::uint32_t slot);

  /// Grows the ball to `radius`, which is not smaller than before, and reaches what is connected to the seeds in it.
  /// Ends early when it has reached the slot `target`; the flood cannot continue after that.
  void grow(double radius, std::uint32_t target = kNoTarget);
  static constexpr std::uint32_t kNoTarget = 0xFFFFFFFF;

  /// Returns the smallest radius at which `grow` would reach more; infinite if it never will.
  [[nodiscard]] double next_radius();

  /// Returns the vertices reached, in the order of time. A leaf may occur several times, with different vertices.
  [[nodiscard]] std::span<const LeafSubset> reached() const { return reached_; }

  [[nodiscard]] bool has_reached(std::uint32_t slot) const;

 private:
  /// The state of a leaf in one flood.
  struct State {
    LaneMask open = 0;  // no walls
    LaneMask reached = 0;
    LaneMask pending = 0;  // not reached, but with a reached neighbor in another leaf; and seeds
    LaneMask inside = 0;   // the vertices in the ball whose squared radius is `inside_of`
    bool connected = false;
    bool is_awake = false;  // in the work list
    bool is_exact = false;  // `wakes` is the squared distance of a vertex, not only a lower bound of them
    double wakes = 0;       // its bound among the sleepers; infinite if it does not sleep
    double inside_of = -1;
    SquareRange squares{};  // of the distances of its vertices
  };

  /// Returns whether the ball holds all vertices of the leaf, and they are connected.
  [[nodiscard]] bool is_whole(const State& state) const;

  State& state_of(LeafId leaf);
  void wake(LeafId leaf, State& state);
  void wake_or_rest(LeafId leaf, State& state);
  void rest(LeafId leaf, State& state, double bound, bool is_exact);
  void visit(LeafId leaf);
  LaneMask enter(State& state, const Leaf& leaf);
  LaneMask find_inside(State& state, const Leaf& leaf);
  void expand(LeafId leaf, LaneMask added);
  [[nodiscard]] LaneMask border(const State& state, const Leaf& leaf) const;
  [[nodiscard]] double nearest_square(const Leaf& leaf, LaneMask lanes) const;
  void prefetch_neighbors(LeafId leaf) const;

  const IndexView* index_;
  const Kernels* kernels_;
  Center center_;
  LeafBall ball_;
  EpochArray<State> states_;  // by leaf
  std::vector<LeafId> awake_;
  Sleepers sleepers_;
  std::vector<LeafSubset> reached_;
};

}  // namespace meshhood::inline v0_1
