// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "meshhood/mesh.h"

#include "simd/joint.h"

/// The neighborhoods of many vertices without a list of ids for each.
///
/// The rows of a batch whose query vertices lie in one leaf form *packets* of up to 32 rows, and their neighborhoods
/// are found together (docs/joint.md). They have most of their vertices in common. The answer of a packet names each
/// vertex once, with the set of rows that have it, so that a sum reads each value once for up to 32 rows.
namespace meshhood {

/// The neighborhoods of the queries of a packet. Depends on these alone, not on threads or the processor. Valid during
/// the call of the visitor.
struct PacketAnswer {
  std::span<const std::size_t> rows;   ///< 1 to 32 rows by their numbers in the query; row i is query i of the packet
  std::span<const VertexId> vertices;  ///< of each row, an id of the caller
  std::span<const double> radii;       ///< of each row
  QueryWord queries = 0;               ///< all
  std::span<const Piece> pieces;       ///< in index order, without overlap
};

}  // namespace meshhood
