// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood::inline v0_1 {

/// An array of states that are valid for one search only. `forget` makes all of them unknown at once, in constant time
/// except for the calls at which the epochs run out.
template <class State, class Epoch = std::uint32_t>
class EpochArray {
 public:
  explicit EpochArray(std::size_t size) : slots_(size) {}

  void forget() {
    epoch_ = static_cast<Epoch>(epoch_ + 1);
    if (epoch_ != 0) return;
    std::fill(slots_.begin(), slots_.end(), Slot{});
    epoch_ = 1;
  }

  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] bool is_known(std::size_t i) const { return slots_[i].epoch == epoch_; }

  /// Returns a state, which must be known.
  [[nodiscard]] State& operator[](std::size_t i) {
    assert(is_known(i));
    return slots_[i].state;
  }
  [[nodiscard]] const State& operator[](std::size_t i) const {
    assert(is_known(i));
    return slots_[i].state;
  }

  State& set(std::size_t i, const State& state) {
    slots_[i] = {epoch_, state};
    return slots_[i].state;
  }

  /// Returns the address of a state, to be prefetched.
  [[nodiscard]] const void* address(std::size_t i) const { return &slots_[i]; }

  /// Continues as if `forget` had been called `epoch` times. Only tests need it.
  void set_epoch(Epoch epoch) { epoch_ = epoch; }

 private:
  struct Slot {
    Epoch epoch = 0;  // the state is known if this is the current one
    [[no_unique_address]] State state{};
  };

  std::vector<Slot> slots_;
  Epoch epoch_ = 1;
};

struct NoState {};

/// The numbers that one search has added. They take 2 bytes for each number below `size`; every 65,535th `forget`
/// writes all of these bytes.
class EpochSet : EpochArray<NoState, std::uint16_t> {
 public:
  using EpochArray::EpochArray;
  using EpochArray::forget;

  [[nodiscard]] bool has(std::size_t i) const { return is_known(i); }
  void add(std::size_t i) { set(i, {}); }
};

}  // namespace meshhood::inline v0_1
