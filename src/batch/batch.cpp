// SPDX-License-Identifier: MIT
#include "batch/batch.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "batch/packets.h"
#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/query/single_queries.h"
#include "simd/leaf.h"

namespace meshhood::inline v0_1 {

void BatchWorker::count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept, bool distances) {
  for_each_answer(chunk, false, [&](std::span<const BatchItem> items) {
    const auto counts = std::span(search_->counts()).first(items.size());
    if (kept != nullptr && search_->writes_pieces(distances)) kept->add(search_->pieces(true), counts);
    return sink(items, counts);
  });
}

void BatchWorker::find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
                       KeptPackets::Reader* kept) {
  const bool writes_pieces = search_->writes_pieces(distances);
  const auto write_pieces = [&](std::span<const BatchItem> items, std::span<const Piece> pieces,
                                std::span<const std::uint64_t> counts) {
    for (unsigned i = 0; i < items.size(); ++i) {
      const BatchMemory memory = receiver.memory(items[i].row, counts[i]);
      writer_->write_ids(pieces, i, memory.ids);
      if (distances) writer_->write_distances(pieces, i, items[i].position, memory.distances);
      if (!receiver.done(items[i].row)) return false;
    }
    return true;
  };
  split(chunk, distances);
  assert(!writes_pieces || writer_);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    if (writes_pieces && kept != nullptr && kept->next()) {
      if (!write_pieces(runs_[i].items, kept->pieces(), kept->counts())) return;
      continue;
    }
    const bool goes_on = search_run(i, [&](std::span<const BatchItem> items) {
      if (!writes_pieces) return search_->write(items, distances, receiver);
      return write_pieces(items, search_->pieces(true), search_->counts());
    });
    if (!goes_on) return;
  }
}

void BatchWorker::visit(std::span<const BatchItem> chunk, PacketForm form,
                        const std::function<bool(const PacketAnswer&)>& sink) {
  const bool lengths = form == PacketForm::WithLengths;
  for_each_answer(chunk, lengths, [&](std::span<const BatchItem> items) {
    rows_.clear();
    vertices_.clear();
    radii_.clear();
    for (const BatchItem& item : items) {
      rows_.push_back(item.row);
      vertices_.push_back(item.vertex);
      radii_.push_back(item.radius);
    }
    const std::span<const Piece> pieces = search_->pieces(form != PacketForm::AsFound);
    return sink({rows_, vertices_, radii_, search_->queries(), pieces, lengths ? search_->lengths() : nullptr});
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

Batch::Batch(const SearchMethod& method, const BatchQuery& query, const BatchOptions& options, const Run& run,
             std::size_t passes)
    : method_(query.metric == Metric::Straight ? method : method.by(query.metric)),
      factory_(method_.factory()),
      options_(options),
      rows_(query, factory_.vertex_count),
      task_(run.threads, run.progress, passes * rows_.size()),
      threads_(task_.threads()) {
  if (options.sort == RowSort::Distance && !options.distances) {
    raise(ErrorCode::InvalidOption, "distances is false, expected true to sort by distance");
  }
  if (rows_.size() != 0 && factory_.of_slots != nullptr) prepare_searches(*factory_.of_slots, query.metric);
}

BatchWorker& Batch::worker(unsigned thread) {
  std::unique_ptr<BatchWorker>& worker = threads_[thread].worker;
  if (!worker) {
    std::optional<RowWriter> writer;
    if (factory_.of_slots != nullptr) writer.emplace(IndexAccess::view(*factory_.of_slots), best_isa());
    worker = std::make_unique<BatchWorker>(factory_.make_rows(), writer);
  }
  return *worker;
}

RawVector<std::size_t> Batch::put_in_index_order() {
  block_.reset();
  RawVector<std::size_t> order =
      rows_by_position(rows_.size(), [&](std::size_t row) { return factory_.position(rows_.vertex(row)); }, task_);
  rows_.reorder(order);
  return order;
}

bool Batch::is_in_index_order() const {
  for (std::size_t row = 1; row < rows_.size(); ++row) {
    if (factory_.position(rows_.vertex(row - 1)) > factory_.position(rows_.vertex(row))) return false;
  }
  return true;
}

bool Batch::ends_unit(std::size_t row, std::uint32_t positions) const {
  return row + 1 >= rows_.size() ||
         factory_.position(rows_.vertex(row)) / positions != factory_.position(rows_.vertex(row + 1)) / positions;
}

std::size_t Batch::whole_units(std::size_t first, std::size_t window) const {
  for (const std::uint32_t positions : {factory_.positions_together, std::uint32_t{kLeafCapacity}}) {
    for (std::size_t size = window; size > 0; --size) {
      if (ends_unit(first + size - 1, positions)) return size;
    }
  }
  return window;
}

void Batch::take_index_order() {
  constexpr std::size_t kLeavesAtOnce = 128;
  const IndexView& index = IndexAccess::view(*factory_.of_slots);
  in_order_.clear();
  const std::span<std::uint64_t> in_order = add_raw(in_order_, rows_.size());
  task_.parallel_for(index.leaf_count(), kLeavesAtOnce, [&](unsigned /*thread*/, std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      std::uint64_t slot = leaf * kLeafCapacity;
      for (std::size_t i = index.leaf_begin[leaf]; i < index.leaf_begin[leaf + 1]; ++i) {
        in_order[i] = (slot++ << 32) + index.id(i);
      }
    }
  });
  cut_into_chunks(in_order);
}

void Batch::cut_into_chunks(std::span<const std::uint64_t> in_order) {
  constexpr std::size_t kChunk = 32;
  constexpr std::size_t kMaxChunk = 512;  // where many rows share their vertices
  const std::size_t count = in_order.size();
  const std::uint64_t together = std::uint64_t{factory_.positions_together} << 32;
  // If there are few rows, each may take long: then a chunk has one row, and those that belong together with it.
  const std::size_t grain = std::clamp<std::size_t>(count / kChunk, 1, kChunk);
  chunk_ends_.clear();
  for (std::size_t end = 0; end < count;) {
    const std::size_t most = std::min(end + kMaxChunk, count);
    end = std::min(end + grain, count);
    const std::uint64_t unit_end = (in_order[end - 1] / together + 1) * together;
    const auto rest = in_order.subspan(end, most - end);
    end += static_cast<std::size_t>(std::lower_bound(rest.begin(), rest.end(), unit_end) - rest.begin());
    chunk_ends_.push_back(end);
  }
}

void for_each_packet(const Index& index, const BatchQuery& query, const PacketVisitorFactory& make_visitor,
                     const Run& run, PacketForm form) {
  const std::vector<BatchRadius> passes = radius_of_passes(query.radius);
  Batch batch(index, {query.vertices, passes.front(), query.metric}, {}, run, passes.size());
  std::vector<PacketVisitor> visitors(batch.task().threads());
  for (std::size_t i = 0; i < passes.size(); ++i) {
    if (i > 0) batch.begin_pass(passes[i].common());
    batch.for_all_chunks([&](unsigned thread, const BatchChunk& chunk) {
      PacketVisitor& visitor = visitors[thread];
      if (!visitor) visitor = make_visitor(thread);
      batch.worker(thread).visit(chunk.items, form, [&](const PacketAnswer& answer) {
        visitor(answer);
        batch.task().advance(thread, answer.rows.size());
        return batch.task().should_continue(thread);
      });
    });
  }
  batch.task().finish();
}

}  // namespace meshhood::inline v0_1
