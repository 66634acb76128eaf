// SPDX-License-Identifier: MIT
#include "batch/single_packet.h"

#include <algorithm>
#include <cassert>

namespace meshhood {

void PacketLists::assign(std::span<const BatchItem> items) {
  rows.clear();
  vertices.clear();
  radii.clear();
  for (const BatchItem& item : items) {
    rows.push_back(item.row);
    vertices.push_back(item.vertex);
    radii.push_back(item.radius);
  }
}

std::span<const Piece> SinglePacket::describe(const IndexView& index, const VertexSet& found) {
  constexpr QueryWord kQuery = 1;
  const auto leaf_of_vertex = [&](VertexId vertex) { return leaf_of(index.slot[index.id(vertex)]); };
  pieces_.clear();
  const auto is_subset = [](const VertexSet::Part& part) { return !part.is_run(); };
  words_.resize(static_cast<std::size_t>(std::ranges::count_if(found.parts(), is_subset)));
  PerLane<QueryWord>* words = words_.data();
  for (const auto& [begin, end, lanes] : found.parts()) {
    assert(begin < end);
    const LeafId leaf = leaf_of_vertex(begin);
    if (lanes == 0) {
      pieces_.push_back({{leaf, leaf_of_vertex(end - 1) + 1}, kQuery, nullptr});
    } else {
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) (*words)[lane] = lanes >> lane & kQuery;
      pieces_.push_back({{leaf, leaf + 1}, 0, words->data()});
      ++words;
    }
  }
  counts_[0] = found.count();
  return pieces_;
}

}  // namespace meshhood
