// SPDX-License-Identifier: MIT
#include "exact/joint/packet_pieces.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace meshhood {

void PacketPieces::assign(const PacketAnswer& answer) {
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

const RowPiece* PacketPieces::find(std::size_t vertex) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), vertex,
                                      [](std::size_t v, const RowPiece& piece) { return v < piece.first; });
  if (after == pieces_.begin()) return nullptr;
  const RowPiece& piece = *(after - 1);
  return vertex - piece.first < piece.size ? &piece : nullptr;
}

void PacketPieces::add_run(const VertexRange& run, QueryWord queries) {
  pieces_.push_back({run.begin, static_cast<std::uint32_t>(run.size()), queries, nullptr});
}

}  // namespace meshhood
