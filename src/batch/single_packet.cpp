// SPDX-License-Identifier: MIT
#include "batch/single_packet.h"

namespace meshhood {

void PacketRows::assign(std::span<const BatchItem> items) {
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
  words_.resize(found.subsets().size());
  for (const VertexRange& run : found.runs()) {
    whole_.push_back({{leaf_of_vertex(run.begin), leaf_of_vertex(run.end - 1) + 1, run}, kQuery});
  }
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const auto [leaf, lanes] = found.subsets()[i];
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) words_[i][lane] = lanes >> lane & kQuery;
    partial_.push_back({leaf, {index.leaf_begin[leaf], index.leaf_begin[leaf + 1]}, words_[i]});
  }
  answer_.queries = kQuery;
  answer_.whole = whole_;
  answer_.partial = partial_;
  return answer_;
}

}  // namespace meshhood
