// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "index/kd_order.h"

namespace meshhood {

/// A graph by rows: the neighbours of `i` are `nodes[begin[i]] .. nodes[begin[i + 1] - 1]`.
struct Rows {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> nodes;

  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t node) const {
    return std::span(nodes).subspan(begin[node], begin[node + 1] - begin[node]);
  }
};

/// Reorders `leaves` so that eight, sixty-four, ... consecutive ones, counted from the first, lie close together and,
/// as far as that goes, hang together: cuts across the widest side, at a multiple of a power of eight, and where what
/// is left is in several components, goes on with each of them. `graph` is that of the leaves, by `Site::id`.
/// O((n + edges) log n).
void order_leaves(std::span<Site> leaves, const Rows& graph);

}  // namespace meshhood
