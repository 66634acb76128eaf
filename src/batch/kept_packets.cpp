// SPDX-License-Identifier: MIT
#include "batch/kept_packets.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kWordsBeforePieces = 2;
constexpr std::size_t kWordsOfPiece = 3;

}  // namespace

void KeptPackets::add(std::span<const Piece> pieces, std::span<const std::uint64_t> counts) {
  const std::uint64_t ids = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const auto leaves =
      static_cast<std::size_t>(std::ranges::count_if(pieces, [](const Piece& piece) { return !piece.is_run(); }));
  const bool is_single = counts.size() == 1;
  const std::size_t words =
      kWordsBeforePieces + counts.size() + kWordsOfPiece * pieces.size() + (is_single ? 1 : kLeafCapacity) * leaves;
  if (sizeof(Word) * words > sizeof(VertexId) * ids) {
    *add_words(1) = 0;
    return;
  }
  Word* next = add_words(words);
  *next++ = static_cast<Word>(counts.size());
  *next++ = static_cast<Word>(pieces.size());
  for (const std::uint64_t count : counts) *next++ = static_cast<Word>(count);
  for (const Piece& piece : pieces) {
    *next++ = piece.leaves.begin;
    *next++ = piece.leaves.end;
    *next++ = piece.queries;
    if (piece.is_run()) continue;
    if (is_single) {
      LaneMask lanes = 0;
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) lanes |= (piece.reached[lane] & 1) << lane;
      *next++ = lanes;
    } else {
      next = std::copy_n(piece.reached, kLeafCapacity, next);
    }
  }
}

KeptPackets::Place KeptPackets::end() const {
  if (blocks_.empty()) return {};
  return {blocks_.size() - 1, blocks_.back().size()};
}

std::size_t KeptPackets::bytes() const {
  std::size_t words = 0;
  for (const RawVector<Word>& block : blocks_) words += block.capacity();
  return sizeof(Word) * words;
}

KeptPackets::Word* KeptPackets::add_words(std::size_t count) {
  // In words. Blocks stay smaller than those for which the allocator of glibc asks the system each time.
  constexpr std::size_t kBlock = std::size_t{1} << 14;
  if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < count) {
    blocks_.emplace_back().reserve(std::max(kBlock, count));
  }
  return add_raw(blocks_.back(), count).data();
}

void KeptPackets::Reader::begin(const KeptPackets& kept, const Place& place) {
  kept_ = &kept;
  place_ = place;
}

bool KeptPackets::Reader::next() {
  assert(place_.block < kept_->blocks_.size());
  if (place_.word == kept_->blocks_[place_.block].size()) place_ = {place_.block + 1, 0};
  assert(place_.block < kept_->blocks_.size());
  const RawVector<Word>& block = kept_->blocks_[place_.block];
  const Word* next = block.data() + place_.word;
  const std::size_t rows = *next++;
  if (rows == 0) {
    ++place_.word;
    return false;
  }
  const std::size_t pieces = *next++;
  std::copy_n(next, rows, counts_.begin());
  next += rows;
  pieces_.clear();
  if (reached_.size() < pieces) reached_.resize(pieces);
  for (std::size_t i = 0; i < pieces; ++i, next += kWordsOfPiece) {
    const QueryWord queries = next[2];
    pieces_.push_back({{next[0], next[1]}, queries, queries == 0 ? reached_[i].data() : nullptr});
    if (queries != 0) continue;
    const Word* const words = next + kWordsOfPiece;
    if (rows == 1) {
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) reached_[i][lane] = *words >> lane & 1;
    } else {
      std::copy_n(words, kLeafCapacity, reached_[i].begin());
    }
    next += rows == 1 ? 1 : kLeafCapacity;
  }
  place_.word = static_cast<std::size_t>(next - block.data());
  assert(place_.word <= block.size());
  return true;
}

KeptPackets& KeptChunks::begin(unsigned thread, std::size_t number) {
  PerThread& own = threads_[thread];
  own.chunks.push_back({number, own.packets.end()});
  return own.packets;
}

void KeptChunks::finish() {
  std::size_t count = 0;
  for (const PerThread& thread : threads_) count += thread.chunks.size();
  chunks_.resize(count);
  for (const PerThread& thread : threads_) {
    for (const Chunk& chunk : thread.chunks) chunks_[chunk.number] = {&thread.packets, chunk.begin};
  }
}

KeptPackets::Reader* KeptChunks::find(unsigned thread, std::size_t number) {
  if (chunks_.empty()) return nullptr;
  KeptPackets::Reader& reader = threads_[thread].reader;
  reader.begin(*chunks_[number].packets, chunks_[number].begin);
  return &reader;
}

void KeptChunks::clear() {
  chunks_.clear();
  for (PerThread& thread : threads_) thread = PerThread();
}

std::size_t KeptChunks::bytes() const {
  std::size_t bytes = 0;
  for (const PerThread& thread : threads_) bytes += thread.packets.bytes();
  return bytes;
}

}  // namespace meshhood::inline v0_1
