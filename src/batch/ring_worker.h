// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/search.h"

#include "batch/searcher_factory.h"
#include "exact/bound_index.h"
#include "exact/joint/ring_packet.h"
#include "exact/joint/row_writer.h"

namespace meshhood {

/// The vertices that at most `radius` edges, rounded down, separate from one; distances are numbers of edges. A
/// `NeighborhoodSearcher` whose ids are in index order. The index may be filtered.
class RingSearcher {
 public:
  explicit RingSearcher(const Index& index);

  [[nodiscard]] std::size_t vertex_count() const { return index_->vertex_count(); }
  [[nodiscard]] std::span<const VertexId> permutation() const;
  [[nodiscard]] std::vector<VertexId> neighborhood(VertexId v, double radius);
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);
  [[nodiscard]] std::size_t count(VertexId v, double radius);
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius);

 private:
  void run(VertexId v, double radius);
  template <class F>
  void search(VertexId v, double radius, F&& f);

  BoundIndex index_;
  RingPacket packet_;
  std::vector<VertexRange> ranges_;  // of the last call of that name
};

/// The same for the rows of a batch: those of a leaf are answered together, with distances one by one.
class RingWorker final : public BatchWorker {
 public:
  explicit RingWorker(const Index& index);

  void count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) override;
  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
            KeptPackets::Reader* kept) override;

 private:
  static std::span<const BatchItem> first_packet(std::span<const BatchItem> chunk);
  template <class F>
  void for_each_packet(std::span<const BatchItem> chunk, F&& f);
  const PerLane<std::uint64_t>& search(std::span<const BatchItem> items);
  bool write(std::span<const BatchItem> items, const PerLane<std::uint64_t>& counts, RowReceiver& receiver);
  void find_with_distances(std::span<const BatchItem> chunk, RowReceiver& receiver);

  RingSearcher searcher_;
  RingPacket packet_;
  RowWriter writer_;
  std::vector<RingQuery> queries_;
  PerLane<std::uint64_t> counts_{};
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
};

}  // namespace meshhood
