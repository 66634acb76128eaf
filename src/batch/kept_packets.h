// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/raw_vector.h"
#include "simd/joint.h"

namespace meshhood::inline v0_1 {

/// Keeps the answers of packets that one thread found, in that order, while rows are counted, so that they need not be
/// searched again when they are written. An answer that would take more memory than its ids is left out.
class KeptPackets {
 public:
  class Reader;

  /// The place of a packet: its block, and how many words are before it there.
  struct Place {
    std::size_t block = 0;
    std::size_t word = 0;
  };

  /// Adds the answer of a packet whose rows, 1 to 32, have `counts` vertices.
  void add(std::span<const Piece> pieces, std::span<const std::uint64_t> counts);

  /// Returns the place of the next packet that is added.
  [[nodiscard]] Place end() const;

  /// Returns the memory of all blocks, with what is not used of them.
  [[nodiscard]] std::size_t bytes() const;

 private:
  using Word = std::uint32_t;

  [[nodiscard]] Word* add_words(std::size_t count);

  // A packet lies in one block: the number of its rows, or 0 if it is left out; that of its pieces; the sizes of the
  // rows; and for each piece its leaves and `queries`, and what is reached if these are 0: 32 words, or for a packet of
  // one row the lanes.
  std::vector<RawVector<Word>> blocks_;
};

/// Reads packets in the order in which they were added.
class KeptPackets::Reader {
 public:
  void begin(const KeptPackets& kept, const Place& place);

  /// Goes to the next packet. Returns false if its answer was not kept.
  bool next();

  // These return the answer of this packet.
  [[nodiscard]] std::span<const Piece> pieces() const { return pieces_; }
  [[nodiscard]] const PerLane<std::uint64_t>& counts() const { return counts_; }

 private:
  const KeptPackets* kept_ = nullptr;
  Place place_;
  std::vector<Piece> pieces_;
  std::vector<PerLane<QueryWord>> reached_;  // by piece
  PerLane<std::uint64_t> counts_{};
};

/// What is kept of the chunks of a batch, which are numbered from 0 on.
class KeptChunks {
 public:
  explicit KeptChunks(unsigned threads) : threads_(threads) {}

  /// Begins a chunk on a thread, which adds the packets of the chunk to the result.
  [[nodiscard]] KeptPackets& begin(unsigned thread, std::size_t number);

  /// Must be called once, after all chunks and before `find`.
  void finish();

  /// Returns the reader of a thread, set to the first packet of a chunk, whichever thread has added it. Null after
  /// `clear`.
  [[nodiscard]] KeptPackets::Reader* find(unsigned thread, std::size_t number);

  [[nodiscard]] std::size_t bytes() const;

  void clear();

 private:
  struct Chunk {
    std::size_t number;
    KeptPackets::Place begin;
  };

  /// Each thread has cache lines of its own, because the others write to theirs all the time.
  struct alignas(64) PerThread {
    KeptPackets packets;
    std::vector<Chunk> chunks;
    alignas(64) KeptPackets::Reader reader;
  };

  struct Found {
    const KeptPackets* packets;
    KeptPackets::Place begin;
  };

  std::vector<PerThread> threads_;
  std::vector<Found> chunks_;  // by number, after `finish`
};

}  // namespace meshhood::inline v0_1
