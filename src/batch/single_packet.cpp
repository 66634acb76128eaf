// SPDX-License-Identifier: MIT
#include "batch/single_packet.h"

#include <algorithm>
#include <cassert>

namespace meshhood {

void PacketLists::assign(std::span<const BatchItem> items) {
  clear();
  for (const BatchItem& item : items) {
    queries_of_rows.push_back(static_cast<unsigned>(rows.size()));
    rows.push_back(item.row);
    vertices.push_back(item.vertex);
    radii.push_back(item.radius);
  }
}

void PacketLists::assign_leaf(const IndexView& index, LeafId leaf, std::span<const BatchItem> items) {
  clear();
  for (const BatchItem& item : items) {
    queries_of_rows.push_back(lane_of(item.position));
    rows.push_back(item.row);
  }
  for (std::size_t lane = 0; lane < index.leaves[leaf].size; ++lane) {
    vertices.push_back(index.id(index.leaves[leaf].first + lane));
  }
  radii.assign(vertices.size(), items.front().radius);
}

void PacketLists::clear() {
  rows.clear();
  queries_of_rows.clear();
  vertices.clear();
  radii.clear();
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
  answer_.queries = kQuery;
  answer_.whole = whole_;
  answer_.partial = partial_;
  return answer_;
}

}  // namespace meshhood
