// SPDX-License-Identifier: MIT
#include "batch/kept_packets.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "meshhood/mesh.h"

namespace meshhood {
namespace {

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return sizeof(T) * values.size();
}

}  // namespace

void KeptPackets::add(std::span<const RowPiece> pieces, std::span<const std::uint64_t> counts) {
  const std::uint64_t ids = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  const auto leaves = static_cast<std::size_t>(
      std::ranges::count_if(pieces, [](const RowPiece& piece) { return piece.reached != nullptr; }));
  const bool is_single = counts.size() == 1;
  const std::size_t bytes = sizeof(Packet) + sizeof(std::uint32_t) * counts.size() + sizeof(Piece) * pieces.size() +
                            (is_single ? sizeof(LaneMask) : sizeof(PerLane<QueryWord>)) * leaves;
  if (bytes > sizeof(VertexId) * ids) {
    packets_.push_back({0, 0});
    return;
  }
  packets_.push_back({static_cast<std::uint32_t>(pieces.size()), static_cast<std::uint32_t>(counts.size())});
  for (const std::uint64_t count : counts) counts_.push_back(static_cast<std::uint32_t>(count));
  for (const RowPiece& piece : pieces) {
    pieces_.push_back({piece.first, piece.size, piece.reached == nullptr ? piece.queries : 0});
    if (piece.reached == nullptr) continue;
    if (is_single) {
      LaneMask lanes = 0;
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) lanes |= (piece.reached[lane] & 1) << lane;
      lanes_.push_back(lanes);
    } else {
      std::copy_n(piece.reached, kLeafCapacity, words_.emplace_back().begin());
    }
  }
}

void KeptPackets::clear() {
  packets_.clear();
  counts_.clear();
  pieces_.clear();
  words_.clear();
  lanes_.clear();
}

std::size_t KeptPackets::bytes() const {
  return bytes_of(packets_) + bytes_of(counts_) + bytes_of(pieces_) + bytes_of(words_) + bytes_of(lanes_);
}

bool KeptPackets::Reader::next() {
  if (kept_ == nullptr) return false;
  assert(packets_ < kept_->packets_.size());
  const Packet& packet = kept_->packets_[packets_++];
  if (packet.rows == 0) return false;
  std::copy_n(kept_->counts_.begin() + static_cast<std::ptrdiff_t>(counts_), packet.rows, row_counts_.begin());
  counts_ += packet.rows;
  row_pieces_.clear();
  expanded_.resize(packet.rows == 1 ? packet.pieces : 0);
  for (const Piece& piece : std::span(kept_->pieces_).subspan(pieces_, packet.pieces)) {
    const QueryWord* reached = nullptr;
    if (piece.queries == 0 && packet.rows == 1) {
      PerLane<QueryWord>& words = expanded_[row_pieces_.size()];
      const LaneMask lanes = kept_->lanes_[lanes_++];
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) words[lane] = lanes >> lane & 1;
      reached = words.data();
    } else if (piece.queries == 0) {
      reached = kept_->words_[words_++].data();
    }
    row_pieces_.push_back({piece.first, piece.size, piece.queries, reached});
  }
  pieces_ += packet.pieces;
  return true;
}

KeptPackets* KeptChunks::find(std::size_t first_row) {
  for (PerThread& thread : threads_) {
    const auto found = thread.chunks.find(first_row);
    if (found != thread.chunks.end()) return &found->second;
  }
  return nullptr;
}

std::size_t KeptChunks::bytes() const {
  std::size_t bytes = 0;
  for (const PerThread& thread : threads_) {
    for (const auto& [row, chunk] : thread.chunks) bytes += chunk.bytes();
  }
  return bytes;
}

}  // namespace meshhood
