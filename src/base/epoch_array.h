// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace meshhood {

/// An array of states that are valid for one search only. `forget` makes all of them unknown at once, in constant time.
template <class State>
class EpochArray {
 public:
  explicit EpochArray(std::size_t size) : slots_(size) {}

  /// Begins a new search: nothing is known.
  void forget() {
    if (epoch_ == std::numeric_limits<std::uint32_t>::max()) {
      std::fill(slots_.begin(), slots_.end(), Slot{});
      epoch_ = 0;
    }
    ++epoch_;
  }

  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] bool is_known(std::size_t i) const { return slots_[i].epoch == epoch_; }

  /// A state that is known.
  [[nodiscard]] State& operator[](std::size_t i) {
    assert(is_known(i));
    return slots_[i].state;
  }
  [[nodiscard]] const State& operator[](std::size_t i) const {
    assert(is_known(i));
    return slots_[i].state;
  }

  /// Makes a state known.
  State& set(std::size_t i, const State& state) {
    slots_[i] = {epoch_, state};
    return slots_[i].state;
  }

  /// Where a state is, to be prefetched.
  [[nodiscard]] const void* address(std::size_t i) const { return &slots_[i]; }

  /// For tests: continues as if `forget` had been called so many times.
  void set_epoch(std::uint32_t epoch) { epoch_ = epoch; }

 private:
  struct Slot {
    std::uint32_t epoch = 0;  // the state is known if this is the current one
    State state{};
  };

  std::vector<Slot> slots_;
  std::uint32_t epoch_ = 0;
};

/// Numbers that one search has added. `forget` removes them all at once, in constant time but for every 65,535th call.
/// 2 bytes for each number below `size`.
class EpochSet {
 public:
  explicit EpochSet(std::size_t size) : epochs_(size) {}

  void forget() {
    if (++epoch_ != 0) return;
    std::fill(epochs_.begin(), epochs_.end(), std::uint16_t{0});
    epoch_ = 1;
  }

  [[nodiscard]] bool has(std::size_t i) const { return epochs_[i] == epoch_; }
  void add(std::size_t i) { epochs_[i] = epoch_; }

 private:
  std::vector<std::uint16_t> epochs_;
  std::uint16_t epoch_ = 1;
};

}  // namespace meshhood
