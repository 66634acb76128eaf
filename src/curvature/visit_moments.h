// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "meshhood/batch.h"

#include "batch/packets.h"
#include "curvature/packet_moments.h"

namespace meshhood {

/// The rows of a packet. Row i is query i of the moments.
struct MomentRows {
  std::span<const std::size_t> rows;      // their numbers in the query
  std::span<const std::uint32_t> places;  // their vertices in index order
  std::span<const double> radii;          // of their closed balls
  QueryWord queries;                      // those that have moments here; the others come in another call
};

/// Receives the moments of the neighborhoods of a packet about its query vertices, in the unit of `sums.scale()`.
using MomentVisitor =
    std::function<void(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments)>;

/// Calls a visitor with each packet of the query, on the threads of `for_each_packet`, once for the rows of each unit.
/// `make_visitor` is called once by each thread. `open_ball`: a vertex at exactly the radius does not count; a ball of
/// radius 0 has its vertex. Rings are counted as they are.
///
/// The moments of a row depend on index, source, vertex and radius alone, bit for bit: see `PacketMoments`.
void visit_moments(const Index& index, const BatchQuery& query, bool open_ball, const MomentSource& source,
                   const Run& run, const std::function<MomentVisitor()>& make_visitor);

}  // namespace meshhood
