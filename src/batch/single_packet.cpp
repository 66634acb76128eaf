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

const PacketAnswer& SinglePacket::describe(const IndexView& index, const VertexSet& found) {
  constexpr QueryWord kQuery = 1;
  const auto leaf_of_vertex = [&](VertexId vertex) { return leaf_of(index.slot[index.id(vertex)]); };
  whole_.clear();
  partial_.clear();
  const auto is_subset = [](const VertexSet::Part& part) { return !part.is_run(); };
  words_.resize(static_cast<std::size_t>(std::ranges::count_if(found.parts(), is_subset)));
  for (const auto& [begin, end, lanes] : found.parts()) {
    assert(begin < end);
    if (lanes == 0) {
      whole_.push_back({{leaf_of_vertex(begin), leaf_of_vertex(end - 1) + 1, {begin, end}}, kQuery});
    } else {
      PerLane<QueryWord>& words = words_[partial_.size()];
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) words[lane] = lanes >> lane & kQuery;
      partial_.push_back({leaf_of_vertex(begin), {begin, end}, words});
    }
  }
  counts_[0] = found.count();
  answer_.queries = kQuery;
  answer_.whole = whole_;
  answer_.partial = partial_;
  return answer_;
}

}  // namespace meshhood
