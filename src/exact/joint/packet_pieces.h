// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "exact/joint/packet_answer.h"
#include "simd/joint.h"

namespace meshhood {

/// The answer of a packet in index order: runs, of which adjacent ones of the same queries are one, and leaves.
class PacketPieces {
 public:
  /// The answer must outlive the calls below.
  void assign(const PacketAnswer& answer);

  /// Ascending, without overlap.
  [[nodiscard]] std::span<const RowPiece> all() const { return pieces_; }

  /// The piece that holds a vertex, by its place in index order; null if no query has reached it.
  [[nodiscard]] const RowPiece* find(std::size_t vertex) const;

 private:
  void add_run(const VertexRange& run, QueryWord queries);

  std::vector<RowPiece> pieces_;
};

}  // namespace meshhood
