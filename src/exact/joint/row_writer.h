// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "exact/layout.h"
#include "simd/joint.h"

namespace meshhood {

/// Writes the rows of packets. The vertices of a row ascend in index order, so a row does not depend on the rows that
/// were answered together with it, and its ids ascend if the caller numbers the vertices in index order.
class RowWriter {
 public:
  RowWriter(const IndexView& index, Isa isa) : index_(&index), kernels_(&joint_kernels(isa)) {}

  /// Begins with the pieces of a packet, which must outlive the calls below.
  void begin(std::span<const Piece> pieces) { pieces_ = pieces; }

  /// Writes the ids of a row. `ids` has as many places as the row has vertices.
  void write_ids(unsigned query, std::span<VertexId> ids) const;

  /// Writes the distances from `center` in the order of the ids.
  void write_distances(unsigned query, const Point& center, std::span<double> distances) const;

 private:
  const IndexView* index_;
  const JointKernels* kernels_;
  std::span<const Piece> pieces_;
};

}  // namespace meshhood
