// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "meshhood/curvature.h"
#include "meshhood/moments.h"

#include "batch/packets.h"
#include "curvature/packet_moments.h"

/// The visitors of packets that sum moments, and what is made of these. Each is for one thread, and borrows its
/// arguments.
namespace meshhood::inline v0_1 {

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

/// Calls `visit` with each packet, once for the rows of each unit.
///
/// The moments of a row depend on index, source, vertex and radius alone, bit for bit: see `PacketMoments`.
[[nodiscard]] PacketVisitor moment_visitor(const MomentSource& source, MomentVisitor visit);

/// Weights in index order, times a power of two that brings the largest to where no sum overflows and weights 2^1300
/// times smaller are sums without loss.
struct MomentWeights {
  std::vector<double> values;
  int exponent = 0;

  /// Throws Error{InvalidOption}.
  MomentWeights(const IndexView& index, std::span<const double> given);
};

/// Writes the principal components of each row.
[[nodiscard]] PacketVisitor component_visitor(const Index& index, Metric metric, const MomentWeights& weights,
                                              PrincipalComponents& out);

/// Memory for as many rows.
[[nodiscard]] PrincipalComponents make_components(std::size_t rows);

/// Writes the curvatures of each row.
[[nodiscard]] PacketVisitor curvature_visitor(const OrientedIndex& surface, Metric metric,
                                              const CurvatureOptions& options, const CurvatureMemory& out);

/// Memory for as many rows.
[[nodiscard]] Curvatures make_curvatures(std::size_t rows);
[[nodiscard]] CurvatureMemory memory_of(Curvatures& curvatures);

}  // namespace meshhood::inline v0_1
