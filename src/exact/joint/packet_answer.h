// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "meshhood/mesh.h"

#include "exact/layout.h"
#include "simd/joint.h"

/// A `PacketAnswer` holds the neighborhoods of many vertices without a list of ids for each.
///
/// The rows of a batch whose query vertices lie in one leaf form *packets* of up to 32 rows, and their neighborhoods
/// are found together (docs/joint.md). They have most of their vertices in common. The answer of a packet names each
/// vertex once, with the set of rows that have it, so that a sum reads each value once for up to 32 rows.
namespace meshhood::inline v0_1 {

/// Lengths along the edges to the vertices of an answer. Each thread needs its own.
class PacketLengths {
 public:
  PacketLengths() = default;
  PacketLengths(const PacketLengths&) = default;
  PacketLengths& operator=(const PacketLengths&) = default;
  virtual ~PacketLengths() = default;

  /// Goes on to a leaf of which a query has vertices.
  virtual void select(LeafId leaf) = 0;

  /// Returns the lengths at a vertex of that leaf, by query, valid until the next call. Only those of queries that have
  /// the vertex have a meaning.
  [[nodiscard]] virtual const PathLengths& at(unsigned lane) = 0;
};

/// The neighborhoods of the queries of a packet, valid during the call of the visitor. They depend on these queries
/// alone, not on threads or the processor.
struct PacketAnswer {
  std::span<const std::size_t> rows;   ///< 1 to 32 rows by their numbers in the query; row i is query i of the packet
  std::span<const VertexId> vertices;  ///< of each row, an id of the caller
  std::span<const double> radii;       ///< of each row
  QueryWord queries = 0;          ///< all; straight ones of several rows without walls, whose neighborhoods are empty
  std::span<const Piece> pieces;  ///< without overlap, as the visitor has asked for them; see simd/joint.h
  PacketLengths* lengths = nullptr;  ///< null by straight lines, whose lengths positions give, and unless asked for
};

}  // namespace meshhood::inline v0_1
