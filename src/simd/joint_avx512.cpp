// SPDX-License-Identifier: MIT
#include "simd/joint.h"

#if defined(MESHHOOD_HAS_X86)
// g++ 12 warns of values that its own intrinsics leave undefined on purpose.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <immintrin.h>

#define MESHHOOD_JOINT __attribute__((target("avx512f,avx512bw,avx512cd,avx512vl,avx512dq,bmi,bmi2,popcnt")))

namespace meshhood {
namespace {

/// A word for each of 32 lanes.
struct Words32 {
  __m512i low;
  __m512i high;
};

MESHHOOD_JOINT inline Words32 load(const PerLane<QueryWord>& words) {
  return {_mm512_load_si512(words.data()), _mm512_load_si512(words.data() + 16)};
}

MESHHOOD_JOINT inline void store(PerLane<QueryWord>& words, const Words32& value) {
  _mm512_store_si512(words.data(), value.low);
  _mm512_store_si512(words.data() + 16, value.high);
}

MESHHOOD_JOINT inline Words32 operator&(const Words32& a, const Words32& b) {
  return {_mm512_and_si512(a.low, b.low), _mm512_and_si512(a.high, b.high)};
}

MESHHOOD_JOINT inline Words32 operator|(const Words32& a, const Words32& b) {
  return {_mm512_or_si512(a.low, b.low), _mm512_or_si512(a.high, b.high)};
}

MESHHOOD_JOINT inline LaneMask join(__mmask16 low, __mmask16 high) {
  return static_cast<LaneMask>(_mm512_kunpackw(high, low));
}

/// The words of `lanes`; 0 in the others, which are not read.
MESHHOOD_JOINT inline Words32 load_lanes(const PerLane<QueryWord>& words, LaneMask lanes) {
  return {_mm512_maskz_loadu_epi32(static_cast<__mmask16>(lanes), words.data()),
          _mm512_maskz_loadu_epi32(static_cast<__mmask16>(lanes >> 16), words.data() + 16)};
}

/// The bits of `a` that `b` does not have.
MESHHOOD_JOINT inline Words32 without(const Words32& a, const Words32& b) {
  return {_mm512_andnot_si512(b.low, a.low), _mm512_andnot_si512(b.high, a.high)};
}

/// The bits that the words of all `lanes` have.
MESHHOOD_JOINT inline QueryWord common_bits(const Words32& words, LaneMask lanes) {
  const __m512i ones = _mm512_set1_epi32(-1);
  return static_cast<QueryWord>(_mm512_reduce_and_epi32(
      _mm512_and_si512(_mm512_mask_mov_epi32(ones, static_cast<__mmask16>(lanes), words.low),
                       _mm512_mask_mov_epi32(ones, static_cast<__mmask16>(lanes >> 16), words.high))));
}

/// Writes the halves of a word. Joining them first takes the ports that the comparisons need.
MESHHOOD_JOINT inline void store_halves(__mmask16 low, __mmask16 high, QueryWord& word) {
  using Half [[gnu::may_alias]] = __mmask16;
  auto* halves = reinterpret_cast<Half*>(&word);
  _store_mask16(halves, low);
  _store_mask16(halves + 1, high);
}

/// The lanes in which the words differ.
MESHHOOD_JOINT inline LaneMask differing(const Words32& a, const Words32& b) {
  return join(_mm512_cmpneq_epi32_mask(a.low, b.low), _mm512_cmpneq_epi32_mask(a.high, b.high));
}

/// `word` in the lanes of `lanes`, 0 in the others.
MESHHOOD_JOINT inline Words32 in_lanes(LaneMask lanes, QueryWord word) {
  const auto value = static_cast<int>(word);
  return {_mm512_maskz_set1_epi32(static_cast<__mmask16>(lanes), value),
          _mm512_maskz_set1_epi32(static_cast<__mmask16>(lanes >> 16), value)};
}

/// The lanes whose word has one of `bits`.
MESHHOOD_JOINT inline LaneMask lanes_with(const QueryWord* reached, __m512i bits) {
  return join(_mm512_test_epi32_mask(_mm512_loadu_si512(reached), bits),
              _mm512_test_epi32_mask(_mm512_loadu_si512(reached + 16), bits));
}

/// Where three vectors hold one coordinate of sixteen vertices.
struct CoordinateOrder {
  alignas(64) std::array<std::int32_t, 16> in_first_two;
  alignas(64) std::array<std::int32_t, 16> in_third;  // or in what was found in the first two
};

constexpr std::array<CoordinateOrder, 3> kCoordinateOrders = [] {
  std::array<CoordinateOrder, 3> orders{};
  for (std::int32_t axis = 0; axis < 3; ++axis) {
    for (std::int32_t i = 0; i < 16; ++i) {
      const std::int32_t place = 3 * i + axis;
      const auto at = static_cast<std::size_t>(i);
      orders[static_cast<std::size_t>(axis)].in_first_two[at] = place < 32 ? place : 0;
      orders[static_cast<std::size_t>(axis)].in_third[at] = place < 32 ? i : 16 + (place - 32);
    }
  }
  return orders;
}();

/// Three vectors with the coordinates of sixteen vertices; zeros from `count` floats on.
struct Interleaved {
  __m512 first;
  __m512 second;
  __m512 third;
};

MESHHOOD_JOINT inline __m512 load_floats(const float* from, unsigned begin, unsigned count) {
  const auto wanted = static_cast<__mmask16>(_bzhi_u32(0xFFFF, count > begin ? count - begin : 0));
  return _mm512_maskz_loadu_ps(wanted, from + begin);
}

/// One coordinate of the vertices of `lanes`, relative to the center; 0 in the other lanes.
MESHHOOD_JOINT inline __m512 coordinate(const Interleaved& xyz, const CoordinateOrder& order, __mmask16 lanes,
                                        float center, float scale) {
  const __m512 two = _mm512_permutex2var_ps(xyz.first, _mm512_load_si512(order.in_first_two.data()), xyz.second);
  const __m512 all = _mm512_permutex2var_ps(two, _mm512_load_si512(order.in_third.data()), xyz.third);
  return _mm512_maskz_mul_ps(lanes, _mm512_sub_ps(all, _mm512_set1_ps(center)), _mm512_set1_ps(scale));
}

MESHHOOD_JOINT void convert_points(const float* xyz, unsigned size, const FloatCenter& center, LeafPoints& points) {
  for (unsigned i = 0; i < kLeafCapacity; i += 16) {
    const Interleaved some{load_floats(xyz, 3 * i, 3 * size), load_floats(xyz, 3 * i + 16, 3 * size),
                           load_floats(xyz, 3 * i + 32, 3 * size)};
    const auto lanes = static_cast<__mmask16>(_bzhi_u32(0xFFFFFFFF, size) >> i);
    const __m512 x = coordinate(some, kCoordinateOrders[0], lanes, center.x, center.scale);
    const __m512 y = coordinate(some, kCoordinateOrders[1], lanes, center.y, center.scale);
    const __m512 z = coordinate(some, kCoordinateOrders[2], lanes, center.z, center.scale);
    _mm512_store_ps(&points.x[i], x);
    _mm512_store_ps(&points.y[i], y);
    _mm512_store_ps(&points.z[i], z);
    _mm512_store_ps(&points.square[i],
                    _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z)));
  }
}

/// Sixteen balls of a packet.
struct Balls16 {
  __m512 x;
  __m512 y;
  __m512 z;
  __m512 surely_inside;
  __m512 maybe_inside;
};

MESHHOOD_JOINT inline Balls16 load_balls(const PacketBalls& balls, std::size_t i) {
  return {_mm512_load_ps(&balls.x[i]), _mm512_load_ps(&balls.y[i]), _mm512_load_ps(&balls.z[i]),
          _mm512_load_ps(&balls.surely_inside[i]), _mm512_load_ps(&balls.maybe_inside[i])};
}

/// `2 p.q - p.p` for sixteen queries.
MESHHOOD_JOINT inline __m512 heights(const LeafPoints& points, std::size_t lane, const Balls16& balls) {
  const __m512 x = _mm512_mul_ps(_mm512_set1_ps(points.x[lane]), balls.x);
  const __m512 y = _mm512_mul_ps(_mm512_set1_ps(points.y[lane]), balls.y);
  const __m512 z = _mm512_mul_ps(_mm512_set1_ps(points.z[lane]), balls.z);
  return _mm512_sub_ps(_mm512_add_ps(_mm512_add_ps(x, y), z), _mm512_set1_ps(points.square[lane]));
}

MESHHOOD_JOINT inline __m512 squares_from_center(const LeafPoints& points, std::size_t i, const PacketBalls& balls) {
  const __m512 x = _mm512_sub_ps(_mm512_load_ps(&points.x[i]), _mm512_set1_ps(balls.center_x));
  const __m512 y = _mm512_sub_ps(_mm512_load_ps(&points.y[i]), _mm512_set1_ps(balls.center_y));
  const __m512 z = _mm512_sub_ps(_mm512_load_ps(&points.z[i]), _mm512_set1_ps(balls.center_z));
  return _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z));
}

MESHHOOD_JOINT BallWords ball_words(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls,
                                    PerLane<QueryWord>& inside, PerLane<QueryWord>& doubts) {
  const __m512 low = squares_from_center(points, 0, balls);
  const __m512 high = squares_from_center(points, 16, balls);
  const __m512 nearest = _mm512_set1_ps(balls.inside_all);
  const __m512 farthest = _mm512_set1_ps(balls.outside_all);
  const LaneMask in_all =
      lanes & join(_mm512_cmp_ps_mask(low, nearest, _CMP_LT_OQ), _mm512_cmp_ps_mask(high, nearest, _CMP_LT_OQ));
  const LaneMask in_none =
      lanes & join(_mm512_cmp_ps_mask(low, farthest, _CMP_GT_OQ), _mm512_cmp_ps_mask(high, farthest, _CMP_GT_OQ));
  store(inside, in_lanes(in_all & ~in_none, balls.queries));
  const LaneMask undecided = lanes & ~(in_all | in_none);
  const Balls16 first = load_balls(balls, 0);
  const Balls16 second = load_balls(balls, 16);
  PerLane<QueryWord> maybe;
  for (LaneMask left = undecided; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const __m512 a = heights(points, lane, first);
    const __m512 b = heights(points, lane, second);
    store_halves(_mm512_cmp_ps_mask(a, first.surely_inside, _CMP_GE_OQ),
                 _mm512_cmp_ps_mask(b, second.surely_inside, _CMP_GE_OQ), inside[lane]);
    store_halves(_mm512_cmp_ps_mask(a, first.maybe_inside, _CMP_GE_OQ),
                 _mm512_cmp_ps_mask(b, second.maybe_inside, _CMP_GE_OQ), maybe[lane]);
  }
  const Words32 sure = load(inside);
  const Words32 in_doubt = without(load_lanes(maybe, undecided), sure);
  _mm512_storeu_si512(doubts.data(), in_doubt.low);
  _mm512_storeu_si512(doubts.data() + 16, in_doubt.high);
  const QueryWord all = in_none != 0 ? 0 : balls.queries & common_bits(sure, undecided);
  return {all, differing(in_doubt, {_mm512_setzero_si512(), _mm512_setzero_si512()})};
}

MESHHOOD_JOINT void clear_words(LeafWords& words) {
  const Words32 none{_mm512_setzero_si512(), _mm512_setzero_si512()};
  store(words.reached, none);
  store(words.pending, none);
}

/// Moves what is pending to `reached`.
MESHHOOD_JOINT inline Words32 take_pending(LeafWords& words, const Words32& inside, QueryWord whole) {
  Words32 reached = load(words.reached) | (load(words.pending) & inside);
  const Words32 zero{_mm512_setzero_si512(), _mm512_setzero_si512()};
  store(words.pending, zero);
  if (whole != 0) {
    const auto any = static_cast<QueryWord>(_mm512_reduce_or_epi32(_mm512_or_si512(reached.low, reached.high)));
    reached = reached | (in_lanes(~LaneMask{0}, any & whole) & inside);
  }
  return reached;
}

/// The edges within a leaf as lists with one neighbor of each lane. A lane that has no more names itself.
class NeighborLists {
 public:
  MESHHOOD_JOINT explicit NeighborLists(const LaneMask* adjacency) {
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    Words32 left{_mm512_loadu_si512(adjacency), _mm512_loadu_si512(adjacency + 16)};
    while (_mm512_test_epi32_mask(_mm512_or_si512(left.low, left.high), _mm512_set1_epi32(-1)) != 0) {
      lists_[size_++] = {take_first(left.low, lanes),
                         take_first(left.high, _mm512_add_epi32(lanes, _mm512_set1_epi32(16)))};
    }
  }

  /// The words of all neighbors of each lane, and its own.
  [[nodiscard]] MESHHOOD_JOINT Words32 gather(const Words32& words) const {
    Words32 all = words;
    for (std::size_t i = 0; i < size_; ++i) {
      all = all | Words32{_mm512_permutex2var_epi32(words.low, lists_[i].low, words.high),
                          _mm512_permutex2var_epi32(words.low, lists_[i].high, words.high)};
    }
    return all;
  }

 private:
  /// Removes the first neighbor of each lane, and returns it. What is left does not wait for which it was.
  MESHHOOD_JOINT static __m512i take_first(__m512i& neighbors, __m512i lanes) {
    const __mmask16 has = _mm512_test_epi32_mask(neighbors, neighbors);
    const __m512i first = _mm512_and_si512(neighbors, _mm512_sub_epi32(_mm512_setzero_si512(), neighbors));
    neighbors = _mm512_andnot_si512(first, neighbors);
    return _mm512_mask_sub_epi32(lanes, has, _mm512_set1_epi32(31), _mm512_lzcnt_epi32(first));
  }

  Words32 lists_[kLeafCapacity];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment
  std::size_t size_ = 0;
};

MESHHOOD_JOINT SpreadWords spread_words(LeafWords& words, const LaneMask* adjacency, QueryWord whole) {
  const Words32 inside = load(words.inside);
  const Words32 before = load(words.reached);
  Words32 reached = take_pending(words, inside, whole);
  LaneMask open = differing(reached, inside);
  if (open != 0 && differing(reached, before) != 0) {
    const NeighborLists neighbors(adjacency);
    for (LaneMask gained = open; gained != 0 && open != 0;) {
      const Words32 grown = neighbors.gather(reached) & inside;
      gained = differing(grown, reached);
      open = differing(grown, inside);
      reached = grown;
    }
  }
  store(words.reached, reached);
  return {differing(reached, before), open == 0};
}

/// Counts bits in each position of many words. Sixteen vectors are added at once, as binary numbers: a vector for each
/// digit, with a number in each of its bits.
class BitCounters {
 public:
  MESHHOOD_JOINT BitCounters() { ones_ = twos_ = fours_ = eights_ = counts_ = _mm512_setzero_si512(); }

  /// Adds the words of eight leaves.
  MESHHOOD_JOINT void add(const std::array<const QueryWord*, 8>& leaves) {
    const __m512i fours0 = add_four(leaves[0], leaves[1]);
    const __m512i fours1 = add_four(leaves[2], leaves[3]);
    const __m512i eights0 = add_digit(fours_, fours0, fours1);
    const __m512i fours2 = add_four(leaves[4], leaves[5]);
    const __m512i fours3 = add_four(leaves[6], leaves[7]);
    const __m512i eights1 = add_digit(fours_, fours2, fours3);
    count(add_digit(eights_, eights0, eights1), 16);
  }

  MESHHOOD_JOINT void add_to(PerLane<std::uint64_t>& counts) {
    count(ones_, 1);
    count(twos_, 2);
    count(fours_, 4);
    count(eights_, 8);
    flush(counts);
  }

  /// Moves what was counted to `counts`. To be called every `kMostBlocks` calls of `add`.
  MESHHOOD_JOINT void flush(PerLane<std::uint64_t>& counts) {
    alignas(64) std::array<std::uint16_t, kPacketCapacity> small;
    _mm512_store_si512(small.data(), counts_);
    counts_ = _mm512_setzero_si512();
    for (std::size_t i = 0; i < kPacketCapacity; ++i) counts[i] += small[i];
  }

  static constexpr std::size_t kMostBlocks = 128;

 private:
  /// The sum of three bits each stays in the digit, the carry is returned.
  MESHHOOD_JOINT static __m512i add_digit(__m512i& digit, __m512i a, __m512i b) {
    const __m512i old = digit;
    digit = _mm512_ternarylogic_epi32(old, a, b, 0x96);
    return _mm512_ternarylogic_epi32(old, a, b, 0xE8);
  }

  MESHHOOD_JOINT __m512i add_four(const QueryWord* first, const QueryWord* second) {
    const __m512i a = add_digit(ones_, _mm512_load_si512(first), _mm512_load_si512(first + 16));
    const __m512i b = add_digit(ones_, _mm512_load_si512(second), _mm512_load_si512(second + 16));
    return add_digit(twos_, a, b);
  }

  /// Adds `weight` to the counters of all bits that are set, word by word.
  MESHHOOD_JOINT void count(__m512i words, std::int16_t weight) {
    alignas(64) std::array<QueryWord, 16> each;
    _mm512_store_si512(each.data(), words);
    const __m512i weights = _mm512_set1_epi16(weight);
    __m512i other = _mm512_setzero_si512();
    for (std::size_t i = 0; i < each.size(); i += 2) {
      counts_ = _mm512_mask_add_epi16(counts_, each[i], counts_, weights);
      other = _mm512_mask_add_epi16(other, each[i + 1], other, weights);
    }
    counts_ = _mm512_add_epi16(counts_, other);
  }

  __m512i ones_;
  __m512i twos_;
  __m512i fours_;
  __m512i eights_;
  __m512i counts_;  // 16 bits for each query
};

MESHHOOD_JOINT void count_words(const LeafWords* words, std::span<const LeafOfWords> list,
                                PerLane<std::uint64_t>& counts) {
  alignas(64) static constexpr PerLane<QueryWord> kNone{};
  BitCounters counters;
  std::size_t blocks = 0;
  for (std::size_t i = 0; i < list.size(); i += 8) {
    std::array<const QueryWord*, 8> leaves;
    for (std::size_t k = 0; k < leaves.size(); ++k) {
      leaves[k] = i + k < list.size() ? words[list[i + k].words].reached.data() : kNone.data();
    }
    counters.add(leaves);
    if (++blocks % BitCounters::kMostBlocks == 0) counters.flush(counts);
  }
  counters.add_to(counts);
}

MESHHOOD_JOINT LaneMask lanes_of(const QueryWord* reached, unsigned query) {
  return lanes_with(reached, _mm512_set1_epi32(static_cast<int>(1U << query)));
}

/// Writes the first `count` of sixteen ids, and nothing after them.
MESHHOOD_JOINT inline VertexId* write_first(__m512i ids, unsigned count, VertexId* out) {
  _mm512_mask_storeu_epi32(out, static_cast<__mmask16>(_bzhi_u32(0xFFFF, count)), ids);
  return out + count;
}

/// Writes those of sixteen ids whose lane is set. Compressed in a register: compressing stores are slow on some
/// processors.
MESHHOOD_JOINT inline VertexId* write16(__m512i ids, LaneMask lanes, VertexId* out) {
  const auto set = static_cast<__mmask16>(lanes);
  return write_first(_mm512_maskz_compress_epi32(set, ids), static_cast<unsigned>(_mm_popcnt_u32(set)), out);
}

/// The ids of sixteen vertices.
MESHHOOD_JOINT inline __m512i load_ids(const VertexId* permutation, std::uint32_t first) {
  if (permutation != nullptr) return _mm512_loadu_si512(permutation + first);
  const __m512i count = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  return _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), count);
}

MESHHOOD_JOINT void write_row(std::span<const RowPiece> pieces, unsigned query, const VertexId* permutation,
                              std::span<VertexId> out) {
  const __m512i bit = _mm512_set1_epi32(static_cast<int>(1U << query));
  VertexId* next = out.data();
  for (const RowPiece& piece : pieces) {
    if (piece.reached != nullptr) {
      const LaneMask lanes = lanes_with(piece.reached, bit);
      next = write16(load_ids(permutation, piece.first), lanes, next);
      next = write16(load_ids(permutation, piece.first + 16), lanes >> 16, next);
    } else if ((piece.queries >> query & 1U) != 0) {
      for (std::uint32_t k = 0; k < piece.size; k += 16) {
        next = write_first(load_ids(permutation, piece.first + k), std::min(piece.size - k, 16U), next);
      }
    }
  }
}

}  // namespace

const JointKernels& avx512_joint_kernels() {
  static constexpr JointKernels kAll{convert_points, clear_words, ball_words, spread_words,
                                     count_words,    lanes_of,    write_row};
  return kAll;
}

}  // namespace meshhood
#endif
