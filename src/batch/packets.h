// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/run.h"

#include "exact/joint/packet_answer.h"

namespace meshhood::inline v0_1 {

/// Receives each packet of one thread.
using PacketVisitor = std::function<void(const PacketAnswer&)>;

/// Makes the visitor of thread number `thread`, which is less than the number of threads of the call. Each thread calls
/// it at most once, before its first packet.
using PacketVisitorFactory = std::function<PacketVisitor(unsigned thread)>;

/// What the visitors read.
enum class PacketForm : std::uint8_t {
  InOrder,      // the pieces of a packet in index order
  AsFound,      // in any order, which may depend on the packet; faster
  WithLengths,  // as InOrder; with lengths, by paths and by rings
};

/// Visits the neighborhoods of all rows of `query` by its metric, each row in one packet, packets in no stated order.
/// With scales, all rows are visited for each, and numbered as a result #radii by #rows.
///
/// The visitors run on the worker threads, one for each thread, so that each may have scratch memory of its own. They
/// must not write to the same memory, except that each row belongs to one packet: `result[rows[i]] = ...` is safe.
/// Packets depend on the query alone, so floating-point sums have the same bits for any number of threads.
///
/// A leaf with few queries is searched row by row: packets then have one row. If a vertex is queried more than once,
/// its rows may be in different packets. It takes the time of `counts`. It needs memory for a copy of the query; 8
/// bytes a row, of at most 2^22 rows at a time, and 16 where these are not in index order; and for each thread a
/// searcher, 4 bytes for each leaf of the mesh and 1 kB for each entry of a group (docs/joint.md).
///
/// form    what the visitors read. For `WithLengths`, rings are searched row by row.
///
/// All arguments are checked before the first packet is computed. An exception from a visitor, the factory or
/// `run.progress` ends the call; it is passed on once all threads have stopped.
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row.
void for_each_packet(const Index& index, const BatchQuery& query, const PacketVisitorFactory& make_visitor,
                     const Run& run = {}, PacketForm form = PacketForm::InOrder);

}  // namespace meshhood::inline v0_1
