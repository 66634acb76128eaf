// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "exact/joint/packet_answer.h"
#include "exact/joint/packet_pieces.h"
#include "exact/layout.h"
#include "simd/joint.h"

namespace meshhood {

/// Writes the rows of packets. The vertices of a row ascend in index order, so a row does not depend on the rows that
/// were answered together with it, and its ids ascend if the caller numbers the vertices in index order.
class RowWriter {
 public:
  RowWriter(const IndexView& index, Isa isa) : index_(&index), kernels_(&joint_kernels(isa)) {}

  /// Begins with a packet, which must outlive the calls below.
  void begin(const PacketAnswer& answer) {
    sorted_.assign(answer);
    pieces_ = sorted_.all();
  }

  /// The same with the pieces of a packet.
  void begin(std::span<const RowPiece> pieces) { pieces_ = pieces; }

  [[nodiscard]] std::span<const RowPiece> pieces() const { return pieces_; }

  /// Writes the ids of a row. `ids` has as many places as the row has vertices.
  void write_ids(unsigned query, std::span<VertexId> ids) const;

  /// Writes the distances from `center` in the order of the ids.
  void write_distances(unsigned query, const Point& center, std::span<double> distances) const;

 private:
  const IndexView* index_;
  const JointKernels* kernels_;
  PacketPieces sorted_;
  std::span<const RowPiece> pieces_;
};

}  // namespace meshhood
