// SPDX-License-Identifier: MIT
#include "exact/joint/row_writer.h"

#include <cassert>
#include <cmath>
#include <variant>

#include "shared/distance.h"

namespace meshhood {

void RowWriter::write_ids(unsigned query, std::span<VertexId> ids) const {
  const VertexId* permutation = index_->permutation.empty() ? nullptr : index_->permutation.data();
  kernels_->write_row(pieces_, index_->leaf_begin.data(), query, permutation, ids);
}

void RowWriter::write_distances(unsigned query, const Point& center, std::span<double> distances) const {
  double* next = distances.data();
  std::visit(
      [&](auto xyz) {
        const auto write = [&](std::size_t vertex) {
          *next++ = std::sqrt(squared_distance(point(xyz, vertex), center));
        };
        for (const Piece& piece : pieces_) {
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

}  // namespace meshhood
