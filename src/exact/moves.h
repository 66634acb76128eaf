// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

#include "exact/arrays.h"
#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood {

/// A vertex and its new position.
struct Move {
  std::uint32_t slot;
  Point to;
};

/// The vertices `changed`, ascending by slot, each once. Reads each argument once, because another thread may write to
/// it.
/// Throws Error{InvalidMesh, VertexOutOfRange} for a vertex that the mesh does not have, and for an invalid position.
[[nodiscard]] std::vector<Move> read_moves(const IndexView& index, const PositionsView& positions,
                                           const IndicesView& changed);

/// Whether the frame covers all new positions.
[[nodiscard]] bool stay_in_frame(std::span<const Move> moves, const Frame& frame);

/// Writes the new positions to `positions`, in index order.
void write_moves(std::span<const Move> moves, const IndexView& index, OrderedPositions& positions);

/// Moves the vertices of `index`, which owns its geometry and has no searcher, and computes again what depends on them.
/// The moves must stay in the frame. If an exception ends the call, `index` is as it was.
void apply_moves(std::span<const Move> moves, IndexView& index, TaskContext& task);

}  // namespace meshhood
