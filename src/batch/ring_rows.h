// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/search.h"

#include "batch/row_search.h"
#include "exact/bound_index.h"
#include "exact/joint/ring_packet.h"
#include "exact/joint/row_writer.h"
#include "exact/query/vertex_rings.h"
#include "exact/weighted_graph.h"

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
  std::size_t run(VertexId v, double radius);
  template <class F>
  void search(VertexId v, double radius, F&& f);

  BoundIndex index_;
  std::shared_ptr<KeptGraph> graph_;
  RingPacket packet_;
  std::optional<VertexRings> by_vertex_;  // for a graph unlike a surface, instead of the packet
  std::vector<VertexRange> ranges_;       // of the last call of that name
};

/// The same for the rows of a batch: those of a leaf are answered together, with distances one by one.
class RingRows final : public RowSearch {
 public:
  explicit RingRows(const Index& index);

  [[nodiscard]] bool pays(std::span<const BatchItem> /*items*/, bool distances) const override { return !distances; }
  [[nodiscard]] bool run(std::span<const RowRun> runs) override;
  [[nodiscard]] const PerLane<std::uint64_t>& counts() override { return counts_; }
  [[nodiscard]] QueryWord queries() const override { return first_lanes(static_cast<unsigned>(queries_.size())); }
  [[nodiscard]] std::span<const Piece> pieces() override { return packet_.pieces(); }
  [[nodiscard]] bool writes_pieces(bool distances) const override { return !distances; }
  bool write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
             RowReceiver& receiver) override;

 private:
  void write_distances(std::span<double> distances);

  RingPacket packet_;
  RowWriter writer_;
  std::vector<RingQuery> queries_;  // of the last run
  PerLane<std::uint64_t> counts_{};
};

}  // namespace meshhood
