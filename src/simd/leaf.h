// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

inline constexpr unsigned kLeafCapacity = 32;

/// A set of vertices of one leaf: bit `i` stands for the leaf's vertex number `i`, its *lane*.
using LaneMask = std::uint32_t;

/// Returns the first `n` lanes; `n` <= 32.
[[nodiscard]] constexpr LaneMask first_lanes(unsigned n) { return n == 0 ? 0 : ~LaneMask{0} >> (kLeafCapacity - n); }

/// Replaces std::popcount, which is a call of a library function when compiling for the oldest processors.
[[nodiscard]] inline std::size_t count_of(LaneMask lanes) {
  lanes -= lanes >> 1 & 0x55555555U;
  lanes = (lanes & 0x33333333U) + (lanes >> 2 & 0x33333333U);
  return ((lanes + (lanes >> 4)) & 0x0F0F0F0FU) * 0x01010101U >> 24;
}

/// Calls `f(lane)` for every lane of the set, in ascending order.
template <class F>
void for_each_lane(LaneMask lanes, F&& f) {
  for (; lanes != 0; lanes &= lanes - 1) f(static_cast<unsigned>(std::countr_zero(lanes)));
}

/// A set of rows of a packet (see exact/joint/packet_answer.h): bit `i` stands for row `i` of the packet.
using QueryWord = std::uint32_t;

/// The largest number of rows of a packet.
inline constexpr std::size_t kPacketCapacity = 32;

/// Calls `f(i)` for each row of the set, in ascending order.
template <class F>
constexpr void for_each_query(QueryWord queries, F&& f) {
  for (; queries != 0; queries &= queries - 1) f(static_cast<std::size_t>(std::countr_zero(queries)));
}

/// An edge between two leaves, by the lanes of its ends: `from` in this leaf, `to` in the linked one.
struct CrossEdge {
  std::uint8_t from;
  std::uint8_t to;
};

/// Positions in index order, #V by 3, followed by `kLeafCapacity` vertices of padding, so that a kernel may read 32
/// vertices from any vertex on.
using PositionsInOrder = std::variant<std::span<const float>, std::span<const double>>;

/// A value for each lane of a leaf, or for each query of a packet, aligned to the vectors of the kernels.
template <class T>
struct alignas(64) PerLane : std::array<T, kLeafCapacity> {};

template <class T>
struct PointPerLane {
  PerLane<T> x;
  PerLane<T> y;
  PerLane<T> z;

  void set(std::size_t i, const Point& point) {
    x[i] = static_cast<T>(point.x);
    y[i] = static_cast<T>(point.y);
    z[i] = static_cast<T>(point.z);
  }

  [[nodiscard]] Point at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// For every set of eight bits: the positions of its bits in ascending order, followed by zeros.
inline constexpr std::array<std::array<std::uint8_t, 8>, 256> kBitPositions = [] {
  std::array<std::array<std::uint8_t, 8>, 256> lists{};
  for (unsigned set = 0; set < 256; ++set) {
    std::size_t size = 0;
    for (std::uint8_t bit = 0; bit < 8; ++bit) {
      if ((set >> bit & 1U) != 0) lists[set][size++] = bit;
    }
  }
  return lists;
}();

/// Lane `i` has bit `i`.
template <class T>
inline constexpr PerLane<T> kLaneBits = [] {
  PerLane<T> bits{};
  for (std::size_t i = 0; i < kLeafCapacity; ++i) bits[i] = static_cast<T>(T{1} << i);
  return bits;
}();

/// For every set of four words of 32 bits: the places of their bytes.
alignas(16) inline constexpr std::array<std::array<std::uint8_t, 16>, 16> kBytePlaces = [] {
  std::array<std::array<std::uint8_t, 16>, 16> lists{};
  for (std::size_t set = 0; set < 16; ++set) {
    for (std::size_t i = 0; i < 16; ++i)
      lists[set][i] = static_cast<std::uint8_t>(std::size_t{4} * kBitPositions[set][i / 4] + i % 4);
  }
  return lists;
}();

}  // namespace meshhood::inline v0_1
