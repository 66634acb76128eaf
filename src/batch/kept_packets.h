// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "simd/joint.h"

namespace meshhood {

/// The answers of packets in the order in which they were found: kept while rows are counted, so that they need not be
/// searched again when they are written. An answer that would take more memory than its ids is left out.
class KeptPackets {
 public:
  class Reader;

  /// Adds the answer of a packet whose rows, 1 to 32, have `counts` vertices.
  void add(std::span<const RowPiece> pieces, std::span<const std::uint64_t> counts);

  void clear();

 private:
  /// A `RowPiece` whose words, if it is a leaf, are the next ones.
  struct Piece {
    std::uint32_t first;
    std::uint32_t size;
    QueryWord queries;  // 0: a leaf
  };

  struct Packet {
    std::uint32_t pieces;
    std::uint32_t rows;  // 0: left out
  };

  std::vector<Packet> packets_;
  std::vector<std::uint32_t> counts_;  // of all packets, one after the other, and so on
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> words_;  // of the leaves of packets of several rows
  std::vector<LaneMask> lanes_;            // of the leaves of packets of one row

  friend class KeptChunks;
  [[nodiscard]] std::size_t bytes() const;
};

/// Reads the packets in the order in which they were added.
class KeptPackets::Reader {
 public:
  /// `kept` is null where nothing was kept.
  explicit Reader(const KeptPackets* kept) : kept_(kept) {}

  /// Goes to the next packet. Returns false if its answer was not kept.
  bool next();

  // Of this packet:
  [[nodiscard]] std::span<const RowPiece> pieces() const { return row_pieces_; }
  [[nodiscard]] const PerLane<std::uint64_t>& counts() const { return row_counts_; }

 private:
  const KeptPackets* kept_;
  std::size_t packets_ = 0;  // how many have been read, and so on
  std::size_t counts_ = 0;
  std::size_t pieces_ = 0;
  std::size_t words_ = 0;
  std::size_t lanes_ = 0;
  std::vector<RowPiece> row_pieces_;
  PerLane<std::uint64_t> row_counts_{};
  std::vector<PerLane<QueryWord>> expanded_;  // words of a packet of one row
};

/// What is kept of the chunks of a batch.
class KeptChunks {
 public:
  explicit KeptChunks(unsigned threads) : threads_(threads) {}

  /// Empty, for the next chunk of a thread.
  KeptPackets& begin(unsigned thread) {
    threads_[thread].scratch.clear();
    return threads_[thread].scratch;
  }

  /// The chunk, named by its first row, is complete.
  void end(unsigned thread, std::size_t first_row) {
    threads_[thread].chunks.emplace(first_row, threads_[thread].scratch);  // a copy, which is as small as possible
  }

  /// What is kept of a chunk; null after `clear`.
  [[nodiscard]] KeptPackets* find(std::size_t first_row);

  [[nodiscard]] std::size_t bytes() const;

  void clear() { threads_.clear(); }

 private:
  /// Not beside that of another thread, which writes to its own all the time.
  struct alignas(64) PerThread {
    KeptPackets scratch;
    std::unordered_map<std::size_t, KeptPackets> chunks;
  };

  std::vector<PerThread> threads_;
};

}  // namespace meshhood
