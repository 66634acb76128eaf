// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "meshhood/batch.h"

#include "batch/packets.h"
#include "curvature/packet_moments.h"
#include "curvature/surface.h"

namespace meshhood {

/// The rows of a packet, and its queries: see `PacketAnswer`.
struct MomentRows {
  std::span<const std::size_t> rows;  // their numbers in the query
  std::span<const unsigned> queries_of_rows;
  std::span<const std::uint32_t> places;  // of each query: its vertex in index order
  std::span<const double> radii;          // of each query: of its closed ball
};

/// Receives the moments of the neighborhoods of a packet about its query vertices, in the unit of `sums.scale()`.
using MomentVisitor =
    std::function<void(const MomentRows& packet, const PacketMoments& sums, const QueryMoments& moments)>;

/// Calls a visitor with each packet of the query, on the threads of `for_each_packet`. `make_visitor` is called once by
/// each thread. `open_ball`: a vertex at exactly the radius does not count; a ball of radius 0 has its vertex.
///
/// If all rows have one radius, the moments of a row depend on index, source, vertex and radius alone, bit for bit:
/// those of a leaf are summed together, whichever of its vertices are asked. Otherwise the rows of a leaf with their
/// radii are summed together, because a packet of a whole leaf for each of many radii would take 30 times as long.
void visit_moments(const Index& index, const BatchQuery& query, bool open_ball, const MomentSource& source,
                   const PacketOptions& options, const std::function<MomentVisitor()>& make_visitor);

}  // namespace meshhood
