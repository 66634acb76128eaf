// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "batch/searcher_factory.h"
#include "exact/layout.h"
#include "exact/vertex_set.h"
#include "simd/joint.h"

namespace meshhood {

/// The rows of a packet, an array for each property.
struct PacketLists {
  std::vector<std::size_t> rows;
  std::vector<VertexId> vertices;
  std::vector<double> radii;

  void assign(std::span<const BatchItem> items);
};

/// The answer to a single query in the form of a packet of one row.
class SinglePacket {
 public:
  /// Valid until the next call.
  std::span<const Piece> describe(const IndexView& index, const VertexSet& found);

  /// The number of vertices of the last answer, for the only row.
  [[nodiscard]] const PerLane<std::uint64_t>& counts() const { return counts_; }

 private:
  PerLane<std::uint64_t> counts_{};
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> words_;
};

}  // namespace meshhood
