// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "meshhood/mesh.h"

#include "shared/distance.h"
#include "simd/ball.h"
#include "simd/leaf.h"
#include "simd/node_group.h"

/// This code exists once per instruction set. Each kernel returns the same bits on every processor.
namespace meshhood::inline v0_1 {

/// An instruction set that the kernels were compiled for, by its place in their order from slow to fast. Every
/// processor that the library runs on has the first, 0.
enum class Isa : std::uint8_t {};

/// Returns the best instruction set of this processor, at most that of `limit_isa`.
[[nodiscard]] Isa best_isa();

/// Limits `best_isa`, for tests. No other thread may use the library meanwhile.
void limit_isa(Isa most);

/// Returns the name of the target in Highway, such as AVX3, AVX2, SSE4, NEON, WASM; SCALAR has no vector instructions.
[[nodiscard]] const char* name_of(Isa isa);

struct Kernels {
  /// Returns the lanes, of the first `size` <= 32 vertices of `xyz`, #V by 3, that are in the ball. Reads 32 vertices.
  LaneMask (*within_float)(const float* xyz, std::size_t size, const LeafBall& ball);
  LaneMask (*within_double)(const double* xyz, std::size_t size, const LeafBall& ball);

  /// Does the same, and writes the squared distances of these vertices from the center. May write all 32.
  LaneMask (*squares_float)(const float* xyz, std::size_t size, const LeafBall& ball, PerLane<double>& out);
  LaneMask (*squares_double)(const double* xyz, std::size_t size, const LeafBall& ball, PerLane<double>& out);

  /// Returns the ends `to` of those of `edges` that begin in `from`. Reads up to 31 edges more.
  LaneMask (*cross_edges)(std::span<const CrossEdge> edges, LaneMask from);

  /// Returns the lanes connected to `from` within `among` by the edges of one leaf; `from` is a subset of `among`.
  /// Reads all 32 rows of `adjacency`, and uses those of `among`.
  LaneMask (*reachable)(const LaneMask* adjacency, LaneMask among, LaneMask from);

  /// Compares `groups[i]` with the ball for each `i` of `list`, and writes a result for each.
  void (*classify)(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball,
                   GroupContainment* out);

  /// Writes the squared distances of the boxes from `center`, in single precision; 0 inside. Returns a bit for each
  /// that is at most `limit`.
  unsigned (*box_squares)(const BoxGroup& boxes, const FramePoint& center, float limit, BoxGroup::Row& squares);

  /// Writes where the ray enters the boxes, in float; 0 inside. Returns a bit for each that it meets up to `limit`.
  unsigned (*box_entries)(const BoxGroup& boxes, const BoxRay& ray, float limit, BoxGroup::Row& entries);

  /// Writes those of the 32 `ids` whose lane is set, in order, and returns their end. May write up to 32 ids beyond it.
  VertexId* (*compress)(const VertexId* ids, LaneMask lanes, VertexId* out);

  /// Writes for each of `count` numbers how many of them are less. Reads and writes up to `kSpareNumbers` more.
  void (*count_less)(const double* numbers, std::size_t count, std::uint64_t* less);
  static constexpr std::size_t kSpareNumbers = 15;

  /// Chosen: up to this many numbers, `count_less` sorts paths in less time than it takes to count intervals.
  std::size_t few_numbers;
  static constexpr std::size_t kMostFewNumbers = 96;

  [[nodiscard]] LaneMask within(const float* xyz, std::size_t size, const LeafBall& ball) const {
    return within_float(xyz, size, ball);
  }
  [[nodiscard]] LaneMask within(const double* xyz, std::size_t size, const LeafBall& ball) const {
    return within_double(xyz, size, ball);
  }

  [[nodiscard]] LaneMask squares(const float* xyz, std::size_t size, const LeafBall& ball, PerLane<double>& out) const {
    return squares_float(xyz, size, ball, out);
  }
  [[nodiscard]] LaneMask squares(const double* xyz, std::size_t size, const LeafBall& ball,
                                 PerLane<double>& out) const {
    return squares_double(xyz, size, ball, out);
  }

  // These take the vertices from `first` on.
  [[nodiscard]] LaneMask within(const PositionsInOrder& positions, std::size_t first, std::size_t size,
                                const LeafBall& ball) const {
    return std::visit([&](const auto& xyz) { return within(xyz.data() + 3 * first, size, ball); }, positions);
  }
  [[nodiscard]] LaneMask squares(const PositionsInOrder& positions, std::size_t first, std::size_t size,
                                 const LeafBall& ball, PerLane<double>& out) const {
    return std::visit([&](const auto& xyz) { return squares(xyz.data() + 3 * first, size, ball, out); }, positions);
  }
};

/// Returns the kernels for `isa`, which the processor must have.
[[nodiscard]] const Kernels& kernels(Isa isa);

}  // namespace meshhood::inline v0_1
