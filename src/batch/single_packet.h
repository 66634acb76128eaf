// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "batch/searcher_factory.h"
#include "exact/joint/packet_answer.h"
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
  [[nodiscard]] const PacketAnswer& describe(const IndexView& index, const VertexSet& found);

 private:
  PacketAnswer answer_;
  std::vector<WholeLeaves> whole_;
  std::vector<PartialLeaf> partial_;
  std::vector<PerLane<QueryWord>> words_;
};

}  // namespace meshhood
