// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/epoch_array.h"
#include "exact/build/links.h"
#include "exact/layout.h"

namespace meshhood::inline v0_1 {

/// Collects the edges that leave one leaf after the other, each edge any number of times and in any order, and makes
/// links of them. Edges to one other leaf are a matrix of bits, in which repeated ones are one and which is read in the
/// order of cross edges, so nothing but the linked leaves is sorted.
class LinkCollector {
 public:
  explicit LinkCollector(std::size_t leaves) : number_(leaves) {}

  void begin() {
    number_.forget();
    linked_.clear();
  }

  /// An edge from `lane` of the leaf to the vertex at `slot`, in another leaf.
  void add(unsigned lane, std::uint32_t slot) {
    const LeafId leaf = leaf_of(slot);
    if (!number_.is_known(leaf)) start(leaf);
    Edges& edges = edges_[number_[leaf]];
    edges.boundary |= LaneMask{1} << lane;
    edges.to[lane] |= LaneMask{1} << lane_of(slot);
  }

  /// Appends the links of the leaf, which ascend, and their cross edges to `out`.
  void finish(Links& out) {
    std::sort(linked_.begin(), linked_.end());
    for (const LeafId leaf : linked_) {
      const Edges& edges = edges_[number_[leaf]];
      out.links.push_back({leaf, edges.boundary, static_cast<std::uint32_t>(out.cross_edges.size())});
      for_each_lane(edges.boundary, [&](unsigned from) {
        for_each_lane(edges.to[from], [&](unsigned to) {
          out.cross_edges.push_back({static_cast<std::uint8_t>(from), static_cast<std::uint8_t>(to)});
        });
      });
    }
    out.link_end.push_back(static_cast<std::uint32_t>(out.links.size()));
  }

 private:
  /// The edges to one other leaf.
  struct Edges {
    LaneMask boundary = 0;                     // the lanes that have one
    std::array<LaneMask, kLeafCapacity> to{};  // by lane of this leaf: lanes of the other
  };

  void start(LeafId leaf) {
    const std::size_t number = linked_.size();
    number_.set(leaf, static_cast<std::uint32_t>(number));
    linked_.push_back(leaf);
    if (number == edges_.size()) edges_.emplace_back();
    edges_[number] = {};
  }

  EpochArray<std::uint32_t> number_;  // by leaf: its place in `edges_`
  std::vector<LeafId> linked_;
  std::vector<Edges> edges_;  // grows, and is used again for the next leaf
};

}  // namespace meshhood::inline v0_1
