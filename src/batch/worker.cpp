// SPDX-License-Identifier: MIT
#include "batch/worker.h"

#include <algorithm>

#include "exact/layout.h"

namespace meshhood::inline v0_1 {

void BatchWorker::count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) {
  for_each_answer(chunk, false, [&](std::span<const BatchItem> items) {
    const auto counts = std::span(search_->counts()).first(items.size());
    if (kept != nullptr && search_->writes_pieces(false)) kept->add(search_->pieces(), counts);
    return sink(items, counts);
  });
}

void BatchWorker::find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
                       KeptPackets::Reader* kept) {
  const bool writes_pieces = search_->writes_pieces(distances);
  const auto write = [&](std::span<const BatchItem> items, const RowAnswers& answers) {
    return search_->write(items, answers, distances, receiver);
  };
  split(chunk, distances);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (writes_pieces && kept != nullptr && kept->next()) {
      if (!write(runs_[i].items, {kept->pieces(), kept->counts()})) return;
      continue;
    }
    const bool goes_on = answer(i, [&](std::span<const BatchItem> items) {
      return write(items, writes_pieces ? RowAnswers{search_->pieces(), search_->counts()} : RowAnswers());
    });
    if (!goes_on) return;
  }
}

void BatchWorker::visit(std::span<const BatchItem> chunk, bool lengths,
                        const std::function<bool(const PacketAnswer&)>& sink) {
  for_each_answer(chunk, lengths, [&](std::span<const BatchItem> items) {
    rows_.clear();
    vertices_.clear();
    radii_.clear();
    for (const BatchItem& item : items) {
      rows_.push_back(item.row);
      vertices_.push_back(item.vertex);
      radii_.push_back(item.radius);
    }
    return sink(
        {rows_, vertices_, radii_, search_->queries(), search_->pieces(), lengths ? search_->lengths() : nullptr});
  });
}

void BatchWorker::split(std::span<const BatchItem> chunk, bool distances) {
  runs_.clear();
  search_->begin_chunk();
  while (!chunk.empty()) {
    const LeafId leaf = leaf_of(chunk.front().position);
    const auto most = chunk.first(std::min(chunk.size(), kPacketCapacity));
    const auto end = std::ranges::find_if(most, [&](const BatchItem& item) { return leaf_of(item.position) != leaf; });
    const std::span<const BatchItem> items(most.begin(), end);
    if (search_->pays(items, distances)) {
      runs_.push_back({items, true});
    } else {
      for (const BatchItem& item : items) runs_.push_back({{&item, 1}, false});
    }
    chunk = chunk.subspan(items.size());
  }
}

}  // namespace meshhood::inline v0_1
