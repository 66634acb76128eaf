// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {

/// Puts the vertices of a row into an order, and their distances along with them.
class RowOrder {
 public:
  explicit RowOrder(RowSort sort) : sort_(sort) {}

  /// Takes the order of an index, whose permutation is borrowed.
  explicit RowOrder(std::span<const VertexId> permutation)
      : sort_(RowSort::Id), permutation_(permutation), places_(permutation.size()) {
    for (std::size_t i = 0; i < permutation.size(); ++i) places_[permutation[i]] = static_cast<VertexId>(i);
  }

  [[nodiscard]] bool needs_distances() const { return sort_ == RowSort::Distance; }

  /// `distances` may be empty unless they are needed.
  void sort(std::span<VertexId> ids, std::span<double> distances) {
    if (sort_ == RowSort::None) return;
    if (!places_.empty()) {
      for (VertexId& id : ids) id = places_[id];
    }
    sort_numbers(ids, distances);
    if (!places_.empty()) {
      for (VertexId& place : ids) place = permutation_[place];
    }
  }

 private:
  struct Item {
    VertexId number;
    double distance;
  };

  void sort_numbers(std::span<VertexId> numbers, std::span<double> distances) {
    assert(distances.size() == numbers.size() || (distances.empty() && !needs_distances()));
    if (!needs_distances() && std::ranges::is_sorted(numbers)) return;
    if (distances.empty()) {
      std::ranges::sort(numbers);
      return;
    }
    items_.resize(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) items_[i] = {numbers[i], distances[i]};
    if (needs_distances()) {
      std::ranges::sort(items_, {}, [](const Item& item) { return std::tie(item.distance, item.number); });
    } else {
      std::ranges::sort(items_, {}, &Item::number);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = items_[i].number;
      distances[i] = items_[i].distance;
    }
  }

  RowSort sort_;
  std::span<const VertexId> permutation_;
  std::vector<VertexId> places_;  // of each vertex, if they are not the ids
  std::vector<Item> items_;       // of one call
};

}  // namespace meshhood::inline v0_1
