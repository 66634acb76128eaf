// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood {

/// A set of pending entries, a bit for each. They are taken in ascending order, sweep by sweep: entries near the group
/// come first, and an entry that gains several times in one sweep is taken once.
class Worklist {
 public:
  /// Empty, for entries below `size`.
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

}  // namespace meshhood
