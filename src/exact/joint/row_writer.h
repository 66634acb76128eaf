// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cmath>
#include <span>
#include <variant>

#include "exact/layout.h"
#include "shared/distance.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Writes the rows of packets. The vertices of a row ascend in index order, so a row does not depend on the rows that
/// were answered together with it, and its ids ascend if the caller numbers the vertices in index order.
class RowWriter {
 public:
  RowWriter(const IndexView& index, Isa isa) : index_(&index), kernels_(&joint_kernels(isa)) {}

  /// Writes the ids of a row from the pieces of its packet. `ids` has as many places as the row has vertices.
  void write_ids(std::span<const Piece> pieces, unsigned query, std::span<VertexId> ids) const;

  /// Writes the distances from the vertex at a slot in the order of the ids.
  void write_distances(std::span<const Piece> pieces, unsigned query, std::uint32_t slot,
                       std::span<double> distances) const;

 private:
  const IndexView* index_;
  const JointKernels* kernels_;
};

inline void RowWriter::write_ids(std::span<const Piece> pieces, unsigned query, std::span<VertexId> ids) const {
  const VertexId* permutation = index_->permutation.empty() ? nullptr : index_->permutation.data();
  kernels_->write_row(pieces, index_->leaf_begin.data(), query, permutation, ids);
}

inline void RowWriter::write_distances(std::span<const Piece> pieces, unsigned query, std::uint32_t slot,
                                       std::span<double> distances) const {
  const Point center = index_->position_at(slot);
  double* next = distances.data();
  std::visit(
      [&](auto xyz) {
        const auto write = [&](std::size_t vertex) {
          *next++ = std::sqrt(squared_distance(point(xyz, vertex), center));
        };
        for (const Piece& piece : pieces) {
          const std::size_t first = index_->leaf_begin[piece.leaves.begin];
          if (!piece.is_run()) {
            for_each_lane(kernels_->lanes_of(piece.reached, query), [&](unsigned lane) { write(first + lane); });
          } else if ((piece.queries >> query & 1U) != 0) {
            for (std::size_t vertex = first; vertex < index_->leaf_begin[piece.leaves.end]; ++vertex) write(vertex);
          }
        }
      },
      index_->positions);
  assert(next == distances.data() + distances.size());
}

}  // namespace meshhood::inline v0_1
