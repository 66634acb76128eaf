// SPDX-License-Identifier: MIT
#include <bit>
#include <cstddef>

#include "simd/joint.h"

namespace meshhood {
namespace {

/// Bit `i` for each `i`. The loops below select from it instead of shifting, so that compilers can vectorize them.
constexpr PerLane<std::uint32_t> kBits = [] {
  PerLane<std::uint32_t> bits{};
  for (unsigned i = 0; i < kLeafCapacity; ++i) bits[i] = std::uint32_t{1} << i;
  return bits;
}();

/// The words of one vertex: compares it with all balls of the packet.
QueryWord compare(const LeafPoints& points, std::size_t lane, const PacketBalls& balls, QueryWord& maybe) {
  const float x = points.x[lane];
  const float y = points.y[lane];
  const float z = points.z[lane];
  const float square = points.square[lane];
  PerLane<float> heights;
  for (std::size_t i = 0; i < kPacketCapacity; ++i) {
    heights[i] = ((x * balls.x[i] + y * balls.y[i]) + z * balls.z[i]) - square;
  }
  QueryWord sure = 0;
  QueryWord some = 0;
  for (std::size_t i = 0; i < kPacketCapacity; ++i) {
    sure |= (0 - QueryWord{heights[i] >= balls.surely_inside[i]}) & kBits[i];
    some |= (0 - QueryWord{heights[i] >= balls.maybe_inside[i]}) & kBits[i];
  }
  maybe = some;
  return sure;
}

float squared_distance_to_center(const LeafPoints& points, std::size_t lane, const PacketBalls& balls) {
  const float x = points.x[lane] - balls.center_x;
  const float y = points.y[lane] - balls.center_y;
  const float z = points.z[lane] - balls.center_z;
  return (x * x + y * y) + z * z;
}

BallWords ball_words(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls, PerLane<QueryWord>& inside,
                     PerLane<QueryWord>& doubts) {
  BallWords result{balls.queries, 0};
  inside = {};
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const float square = squared_distance_to_center(points, lane, balls);
    if (square > balls.outside_all) {
      result.all = 0;
    } else if (square < balls.inside_all) {
      inside[lane] = balls.queries;
    } else {
      QueryWord maybe = 0;
      inside[lane] = compare(points, lane, balls, maybe);
      result.all &= inside[lane];
      doubts[lane] = maybe & ~inside[lane];
      result.in_doubt |= LaneMask{doubts[lane] != 0} << lane;
    }
  }
  return result;
}

void clear_words(LeafWords& words) {
  words.reached = {};
  words.pending = {};
}

/// Reaches the open neighbors of the lanes `from`; returns those that have gained.
LaneMask spread_once(LeafWords& words, const LaneMask* adjacency, LaneMask from, LaneMask open) {
  LaneMask gained = 0;
  for (; from != 0; from &= from - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(from));
    for (LaneMask left = adjacency[lane] & open; left != 0; left &= left - 1) {
      const auto neighbor = static_cast<std::size_t>(std::countr_zero(left));
      const QueryWord grown = words.reached[neighbor] | (words.reached[lane] & words.inside[neighbor]);
      gained |= LaneMask{grown != words.reached[neighbor]} << neighbor;
      words.reached[neighbor] = grown;
    }
  }
  return gained;
}

/// The lanes in which the words differ.
LaneMask differing(const PerLane<QueryWord>& a, const PerLane<QueryWord>& b) {
  LaneMask lanes = 0;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) lanes |= a[i] != b[i] ? kBits[i] : 0;
  return lanes;
}

/// Moves what is pending to `reached`; returns the lanes that gained.
LaneMask take_pending(LeafWords& words, QueryWord whole) {
  const PerLane<QueryWord> before = words.reached;
  QueryWord any = 0;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) {
    words.reached[i] |= words.pending[i] & words.inside[i];
    any |= words.reached[i];
  }
  for (std::size_t i = 0; i < kLeafCapacity; ++i) words.reached[i] |= any & whole & words.inside[i];
  words.pending = {};
  return differing(words.reached, before);
}

SpreadWords spread_words(LeafWords& words, const LaneMask* adjacency, QueryWord whole) {
  SpreadWords result{take_pending(words, whole), false};
  LaneMask open = differing(words.reached, words.inside);
  for (LaneMask fresh = result.gained; fresh != 0 && open != 0; open = differing(words.reached, words.inside)) {
    fresh = spread_once(words, adjacency, fresh, open);
    result.gained |= fresh;
  }
  result.closed = open == 0;
  return result;
}

/// Counters for each bit of a word, a plane for each binary digit, so that a word is added to all of them at once.
class BitCounters {
 public:
  void add(QueryWord word) {
    for (std::size_t digit = 0; word != 0; ++digit) {
      const QueryWord carry = planes_[digit] & word;
      planes_[digit] ^= word;
      word = carry;
    }
  }

  void add_to(PerLane<std::uint64_t>& counts) const {
    for (std::size_t digit = 0; digit < planes_.size(); ++digit) {
      for (QueryWord left = planes_[digit]; left != 0; left &= left - 1) {
        counts[static_cast<std::size_t>(std::countr_zero(left))] += std::uint64_t{1} << digit;
      }
    }
  }

 private:
  std::array<QueryWord, 40> planes_{};  // enough for every vertex of an index
};

void count_words(const LeafWords* words, std::span<const LeafOfWords> list, PerLane<std::uint64_t>& counts) {
  BitCounters counters;
  for (const LeafOfWords& leaf : list) {
    for (const QueryWord word : words[leaf.words].reached) counters.add(word);
  }
  counters.add_to(counts);
}

LaneMask lanes_of(const QueryWord* reached, unsigned query) {
  LaneMask lanes = 0;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) lanes |= (reached[i] & kBits[query]) != 0 ? kBits[i] : 0;
  return lanes;
}

void write_row(std::span<const RowPiece> pieces, unsigned query, const VertexId* permutation, std::span<VertexId> out) {
  VertexId* next = out.data();
  const auto write = [&](std::uint32_t vertex) {
    *next++ = permutation == nullptr ? static_cast<VertexId>(vertex) : permutation[vertex];
  };
  for (const RowPiece& piece : pieces) {
    if (piece.reached != nullptr) {
      for_each_lane(lanes_of(piece.reached, query), [&](unsigned lane) { write(piece.first + lane); });
    } else if ((piece.queries >> query & 1U) != 0) {
      for (std::uint32_t i = 0; i < piece.size; ++i) write(piece.first + i);
    }
  }
}

}  // namespace

const JointKernels& portable_joint_kernels() {
  static constexpr JointKernels kAll{
      convert_points_in_turn, clear_words, ball_words, spread_words, count_words, lanes_of, write_row};
  return kAll;
}

const JointKernels& joint_kernels(Isa isa) {
#if defined(MESHHOOD_HAS_X86)
  if (isa == Isa::Avx512) return avx512_joint_kernels();
  if (isa == Isa::Avx2) return avx2_joint_kernels();
#endif
  static_cast<void>(isa);
  return portable_joint_kernels();
}

}  // namespace meshhood
