// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "index/layout.h"

namespace meshhood {

/// Where a searcher has lately failed to prove that the ball is the answer: there it will probably fail again, from
/// that radius on, and need not try. Only saves time; an answer never depends on it, but the order of its vertices
/// does.
class ProofMemory {
 public:
  explicit ProofMemory(std::size_t leaves) : places_(leaves / kFanOut + 1) {}

  /// As if it were new.
  void forget() { ++round_; }

  [[nodiscard]] bool is_worth_trying(LeafId leaf, double radius) {
    Place& place = place_of(leaf);
    // Once in a while all the same, for a neighbour may succeed.
    return radius < place.failed_from || ++place.passed_over % kPatience == 0;
  }

  void tell(LeafId leaf, double radius, bool proved) {
    Place& place = place_of(leaf);
    if (!proved && radius < place.failed_from) place.failed_from = radius;
    if (proved && radius >= place.failed_from) place.failed_from = std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr std::uint32_t kPatience = 16;

  struct Place {
    double failed_from = std::numeric_limits<double>::infinity();
    std::uint32_t passed_over = 0;
    std::uint32_t round = 0;
  };

  Place& place_of(LeafId leaf) {
    Place& place = places_[leaf / kFanOut];
    if (place.round != round_) place = {.round = round_};
    return place;
  }

  std::vector<Place> places_;  // by group of leaves; what is left of an earlier round is forgotten
  std::uint32_t round_ = 0;
};

}  // namespace meshhood
