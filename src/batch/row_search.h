// SPDX-License-Identifier: MIT
// The search by which a metric answers the rows of a batch, and the writer of rows that come as pieces.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <variant>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"
#include "meshhood/search.h"

#include "exact/joint/packet_answer.h"
#include "exact/layout.h"
#include "shared/distance.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Writes the rows of packets. The vertices of a row ascend in index order, so a row does not depend on the rows that
/// were answered together with it, and its ids ascend if the caller numbers the vertices in index order.
class RowWriter {
 public:
  RowWriter(const IndexView& index, Isa isa) : index_(&index), kernels_(&joint_kernels(isa)) {}

  /// Writes the ids of a row from the pieces of its packet. `ids` has as many places as the row has vertices.
  void write_ids(std::span<const Piece> pieces, unsigned query, std::span<VertexId> ids) const;

  /// Writes the distances from the vertex at a slot in the order of the ids.
  void write_distances(std::span<const Piece> pieces, unsigned query, std::uint32_t slot,
                       std::span<double> distances) const;

 private:
  const IndexView* index_;
  const JointKernels* kernels_;
};

inline void RowWriter::write_ids(std::span<const Piece> pieces, unsigned query, std::span<VertexId> ids) const {
  const VertexId* permutation = index_->permutation.empty() ? nullptr : index_->permutation.data();
  kernels_->write_row(pieces, index_->leaf_begin.data(), query, permutation, ids);
}

inline void RowWriter::write_distances(std::span<const Piece> pieces, unsigned query, std::uint32_t slot,
                                       std::span<double> distances) const {
  const Point center = index_->position_at(slot);
  double* next = distances.data();
  std::visit(
      [&](auto xyz) {
        const auto write = [&](std::size_t vertex) {
          *next++ = std::sqrt(squared_distance(point(xyz, vertex), center));
        };
        for (const Piece& piece : pieces) {
          const std::size_t first = index_->leaf_begin[piece.leaves.begin];
          if (!piece.is_run()) {
            for_each_lane(kernels_->lanes_of(piece.reached, query), [&](unsigned lane) { write(first + lane); });
          } else if ((piece.queries >> query & 1U) != 0) {
            for (std::size_t vertex = first; vertex < index_->leaf_begin[piece.leaves.end]; ++vertex) write(vertex);
          }
        }
      },
      index_->positions);
  assert(next == distances.data() + distances.size());
}

struct BatchItem {
  std::size_t row;
  VertexId vertex;
  std::uint32_t position;  // `SearcherFactory::position`
  double radius;
};

/// Receives rows in memory that it provides, so that ids are written once.
class RowReceiver {
 public:
  RowReceiver() = default;
  RowReceiver(const RowReceiver&) = delete;
  RowReceiver& operator=(const RowReceiver&) = delete;
  virtual ~RowReceiver() = default;

  /// Returns memory for the ids of a row of `size` vertices, and for its distances if they are requested.
  virtual BatchMemory memory(std::size_t row, std::size_t size) = 0;

  /// Reports that the row has been written there. Returns false to drop the rest of the chunk.
  virtual bool done(std::size_t row) = 0;
};

/// Rows that are answered at once: consecutive rows of one leaf, or one row.
struct RowRun {
  std::span<const BatchItem> items;  // 1 to 32
  bool is_joint;                     // else it is one row
};

/// Answers the rows of a batch by a metric, up to 32 of one leaf at once. Each thread needs its own. What is found for
/// a row depends on the index, its vertex and its radius alone.
class RowSearch {
 public:
  RowSearch() = default;
  RowSearch(const RowSearch&) = delete;
  RowSearch& operator=(const RowSearch&) = delete;
  virtual ~RowSearch() = default;

  /// Begins with another chunk.
  virtual void begin_chunk() {}

  /// Returns whether `items`, rows of one leaf, are answered faster together than one by one.
  [[nodiscard]] virtual bool pays(std::span<const BatchItem> items, bool distances) const = 0;

  /// Answers the first of `runs`; the others follow it in its chunk. Returns false if its rows must be answered one by
  /// one, each as a run.
  [[nodiscard]] virtual bool run(std::span<const RowRun> runs) = 0;

  // The functions below answer for the last run. Results are valid until the next.

  /// Returns how many vertices each row has.
  [[nodiscard]] virtual const PerLane<std::uint64_t>& counts() = 0;

  /// Returns the queries that have a neighborhood, as far as it is known.
  [[nodiscard]] virtual QueryWord queries() const = 0;

  /// Returns the answers as pieces without overlap, in index order if that is wanted. `SingleRows` has none.
  [[nodiscard]] virtual std::span<const Piece> pieces(bool in_order) = 0;

  /// Returns the lengths of what `pieces` has returned, if `pays` was asked with distances; null by straight lines.
  [[nodiscard]] virtual PacketLengths* lengths() { return nullptr; }

  /// Returns whether rows are written from their pieces and counts alone, by a `RowWriter`.
  [[nodiscard]] virtual bool writes_pieces(bool distances) const = 0;

  /// Writes the rows of the last run if `writes_pieces` is false. Returns false as soon as the receiver does.
  virtual bool write(std::span<const BatchItem> /*items*/, bool /*distances*/, RowReceiver& /*receiver*/) {
    assert(false);
    return false;
  }
};

/// What a `SearchMethod` refers to. Any thread may call the functions.
struct SearcherFactory {
  std::size_t vertex_count;

  /// Makes a searcher, for one thread.
  std::function<AnySearcher()> make_searcher;

  /// Ascends with the order in which vertices are best searched: near vertices have near positions.
  std::function<std::uint32_t(VertexId v)> position;

  /// If the method has metrics, the positions are slots of this index, which lives as long as the functions; else it is
  /// null.
  const Index* of_slots = nullptr;

  /// Whether counting takes much less time than listing. If not, rows to be kept are searched once, and copied.
  bool is_count_cheap = false;

  /// Rows that lie between two multiples of this many positions are computed together.
  std::uint32_t positions_together = 1;

  /// Makes the search of the rows of a batch, for one thread.
  std::function<std::unique_ptr<RowSearch>()> make_rows;
};

/// The positions of a group: rows by straight lines that lie between two multiples of it should come in one chunk.
inline constexpr std::uint32_t kGroupPositions = kFanOut * kLeafCapacity;

/// Makes a search of straight lines, or in space. The index must outlive this search and the others.
[[nodiscard]] std::unique_ptr<RowSearch> make_straight_rows(const Index& index, Metric metric, Isa isa = best_isa());
[[nodiscard]] std::unique_ptr<RowSearch> make_path_rows(const Index& index);
[[nodiscard]] std::unique_ptr<RowSearch> make_ring_rows(const Index& index);

}  // namespace meshhood::inline v0_1
