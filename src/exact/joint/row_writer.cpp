// SPDX-License-Identifier: MIT
#include "exact/joint/row_writer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <variant>

#include "shared/distance.h"

namespace meshhood {

void RowWriter::begin(const PacketAnswer& answer) {
  pieces_.clear();
  for (const CoreLeaves& core : answer.cores) {
    for (const LeafRun& run : core.runs) add_run(run.vertices, core.queries);
  }
  for (const WholeLeaves& whole : answer.whole) add_run(whole.run.vertices, whole.queries);
  for (const PartialLeaf& leaf : answer.partial) {
    pieces_.push_back({leaf.vertices.begin, static_cast<std::uint32_t>(leaf.vertices.size()), 0, leaf.queries.data()});
  }
  std::sort(pieces_.begin(), pieces_.end(), [](const RowPiece& a, const RowPiece& b) { return a.first < b.first; });
  // Adjacent runs of the same queries become one.
  std::size_t kept = 0;
  for (const RowPiece& piece : pieces_) {
    RowPiece* last = kept == 0 ? nullptr : &pieces_[kept - 1];
    assert(last == nullptr || last->first + last->size <= piece.first);  // an answer names each vertex once
    if (last != nullptr && last->reached == nullptr && piece.reached == nullptr && last->queries == piece.queries &&
        last->first + last->size == piece.first) {
      last->size += piece.size;
    } else {
      pieces_[kept++] = piece;
    }
  }
  pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(kept), pieces_.end());
}

void RowWriter::add_run(const VertexRange& run, QueryWord queries) {
  pieces_.push_back({run.begin, static_cast<std::uint32_t>(run.size()), queries, nullptr});
}

void RowWriter::write_ids(unsigned query, std::span<VertexId> ids) const {
  const VertexId* permutation = index_->permutation.empty() ? nullptr : index_->permutation.data();
  kernels_->write_row(pieces_, query, permutation, ids);
}

void RowWriter::write_distances(unsigned query, const Point& center, std::span<double> distances) const {
  double* next = distances.data();
  std::visit(
      [&](auto xyz) {
        const auto write = [&](std::size_t vertex) {
          *next++ = std::sqrt(squared_distance(point(xyz, vertex), center));
        };
        for (const RowPiece& piece : pieces_) {
          if (piece.reached != nullptr) {
            for_each_lane(kernels_->lanes_of(piece.reached, query),
                          [&](unsigned lane) { write(std::size_t{piece.first} + lane); });
          } else if ((piece.queries >> query & 1U) != 0) {
            for (std::size_t i = 0; i < piece.size; ++i) write(piece.first + i);
          }
        }
      },
      index_->positions);
  assert(next == distances.data() + distances.size());
}

}  // namespace meshhood
