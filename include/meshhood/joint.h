// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/progress.h"
#include "meshhood/query_word.h"
#include "meshhood/searcher.h"

/// The neighborhoods of many vertices without a list of ids for each, for sums and other properties of neighborhoods.
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

/// The neighborhoods of the rows of a packet. `cores`, `whole` and `partial` name each vertex at most once. Their order
/// depends on the query alone, not on threads or the processor. Valid during the call of the visitor.
struct PacketAnswer {
  std::span<const std::size_t> rows;   ///< the rows of the packet, by their numbers in the query; 1 to 32
  std::span<const VertexId> vertices;  ///< the query vertex of each row, an id of the caller
  std::span<const double> radii;       ///< of each row
  QueryWord queries = 0;               ///< all rows

  /// Whether a group begins. The cores of earlier packets are then no longer valid, and their numbers are used again.
  /// The packets of a group come one after the other, to one visitor.
  bool begins_group = true;

  std::span<const CoreLeaves> cores;
  std::span<const WholeLeaves> whole;
  std::span<const PartialLeaf> partial;
};

/// Called with each packet of one thread.
using PacketVisitor = std::function<void(const PacketAnswer&)>;

/// Makes the visitor of thread number `thread`, which is less than `PacketOptions::threads`, or than the number of
/// processors if that is 0. Called at most once for each number, by the thread itself, before its first packet.
using PacketVisitorFactory = std::function<PacketVisitor(unsigned thread)>;

/// How packets are computed. The answers do not depend on these options.
struct PacketOptions {
  /// The calling thread included; 0 means one per processor; at most `kMaxThreads`. 1 starts no thread.
  unsigned threads = 1;

  /// Receives the number of rows that were visited.
  Progress progress = {};
};

/// Visits the exact neighborhoods of all rows of `query`, each row in one packet, packets in no stated order.
///
/// The visitors run on the worker threads, one for each thread, so that each may have scratch memory of its own. They
/// must not write to the same memory, except that each row belongs to one packet: `result[rows[i]] = ...` is safe.
/// Packets depend on the query alone, so floating-point sums have the same bits for any number of threads.
///
/// A leaf with few rows is searched row by row: packets then have one row and no cores. If a vertex is queried more
/// than once, its rows may be in different packets. Time is that of `neighborhood_sizes`. Memory: a copy of the query;
/// 8 bytes a row, of at most 2^22 rows at a time, and 16 where these are not in index order; and for each thread a
/// searcher, 4 bytes for each leaf of the mesh and 1 kB for each entry of a group (docs/joint.md).
///
/// All arguments are checked before the first packet is computed. An exception from a visitor, the factory or
/// `options.progress` ends the call; it is passed on once all threads have stopped.
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row.
void for_each_packet(const Index& index, const BatchQuery& query, const PacketVisitorFactory& make_visitor,
                     const PacketOptions& options = {});

}  // namespace meshhood
