// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "exact/layout.h"

namespace meshhood {

/// Leaves that a flood has met and cannot enter yet, each with a bound: the flood can enter a leaf when its ball has
/// reached that bound.
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

  /// An entry with the smallest bound. There must be one.
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

}  // namespace meshhood
