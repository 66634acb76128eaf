// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace meshhood {

/// A set of rows of a packet (see exact/joint/packet_answer.h): bit `i` stands for row `i` of the packet.
using QueryWord = std::uint32_t;

/// The most rows of a packet.
inline constexpr std::size_t kPacketCapacity = 32;

/// Calls `f(i)` for each row of the set, in ascending order.
template <class F>
constexpr void for_each_query(QueryWord queries, F&& f) {
  for (; queries != 0; queries &= queries - 1) f(static_cast<std::size_t>(std::countr_zero(queries)));
}

}  // namespace meshhood
