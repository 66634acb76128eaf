// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "meshhood/mesh.h"
#include "meshhood/search.h"

#include "simd/query_word.h"

/// The neighborhoods of many vertices without a list of ids for each.
///
/// The rows of a batch whose query vertices lie in one leaf form *packets* of up to 32 rows, and their neighborhoods
/// are found together (docs/joint.md). They have most of their vertices in common. The answer of a packet names each
/// vertex once, with the set of rows that have it, so that a sum reads each value once for up to 32 rows.
namespace meshhood {

/// Consecutive whole leaves (see `Index::leaf_starts`), and their vertices in index order.
struct LeafRun {
  std::uint32_t first_leaf;
  std::uint32_t end_leaf;
  VertexRange vertices;

  friend bool operator==(const LeafRun&, const LeafRun&) = default;
};

/// Leaves whose vertices all belong to a set of rows.
struct WholeLeaves {
  LeafRun run;
  QueryWord queries;  ///< not 0
};

/// Many linked leaves whose vertices all belong to a set of rows. A core is the same in all packets of a group, so that
/// a sum over it can be kept from one packet to the next.
struct CoreLeaves {
  std::size_t number;             ///< of the core in its group, from 0
  std::span<const LeafRun> runs;  ///< ascending, with gaps between them
  std::size_t vertices;           ///< their number in all runs
  QueryWord queries;              ///< not 0
};

/// A leaf whose vertices belong to different rows.
struct PartialLeaf {
  std::uint32_t leaf;
  VertexRange vertices;                                 ///< in index order
  std::span<const QueryWord, kPacketCapacity> queries;  ///< by vertex of the leaf; then 0
};

/// The neighborhoods of the queries of a packet. `cores`, `whole` and `partial` name each vertex at most once. Their
/// order depends on the query alone, not on threads or the processor. Valid during the call of the visitor.
struct PacketAnswer {
  std::span<const std::size_t> rows;   ///< 1 to 32 rows by their numbers in the query; row i is query i of the packet
  std::span<const VertexId> vertices;  ///< of each row, an id of the caller
  std::span<const double> radii;       ///< of each row
  QueryWord queries = 0;               ///< all

  /// Whether a group begins. The cores of earlier packets are then no longer valid, and their numbers are used again.
  /// The packets of a group come one after the other, to one visitor.
  bool begins_group = true;

  std::span<const CoreLeaves> cores;
  std::span<const WholeLeaves> whole;
  std::span<const PartialLeaf> partial;
};

}  // namespace meshhood
