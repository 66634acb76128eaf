// SPDX-License-Identifier: MIT
#include "simd/joint.h"

#if defined(MESHHOOD_HAS_X86)
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include <immintrin.h>

#define MESHHOOD_JOINT __attribute__((target("avx2")))

namespace meshhood {
namespace {

constexpr std::size_t kEighths = kLeafCapacity / 8;

MESHHOOD_JOINT inline __m256i load8(const QueryWord* words) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(words));
}

MESHHOOD_JOINT inline void store8(QueryWord* words, __m256i value) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(words), value);
}

MESHHOOD_JOINT inline unsigned sign_bits(__m256 mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask)); }

/// The lanes, of eight, in which the words differ, as bits.
MESHHOOD_JOINT inline LaneMask differing8(__m256i a, __m256i b) {
  return ~sign_bits(_mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b))) & 0xFFU;
}

/// All ones in those of eight lanes that are set, from bit `8 * part` of `lanes` on.
MESHHOOD_JOINT inline __m256i wide_mask(__m256i lanes, std::size_t part) {
  const __m256i bit = _mm256_slli_epi32(_mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128), static_cast<int>(8 * part));
  return _mm256_cmpeq_epi32(_mm256_and_si256(lanes, bit), bit);
}

MESHHOOD_JOINT inline __m256 squares_from_center(const LeafPoints& points, std::size_t i, const PacketBalls& balls) {
  const __m256 x = _mm256_sub_ps(_mm256_load_ps(&points.x[i]), _mm256_set1_ps(balls.center_x));
  const __m256 y = _mm256_sub_ps(_mm256_load_ps(&points.y[i]), _mm256_set1_ps(balls.center_y));
  const __m256 z = _mm256_sub_ps(_mm256_load_ps(&points.z[i]), _mm256_set1_ps(balls.center_z));
  return _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z));
}

/// One vertex against all balls of the packet.
MESHHOOD_JOINT inline QueryWord compare(const LeafPoints& points, std::size_t lane, const PacketBalls& balls,
                                        QueryWord& maybe) {
  const __m256 x = _mm256_set1_ps(points.x[lane]);
  const __m256 y = _mm256_set1_ps(points.y[lane]);
  const __m256 z = _mm256_set1_ps(points.z[lane]);
  const __m256 square = _mm256_set1_ps(points.square[lane]);
  QueryWord sure = 0;
  for (std::size_t i = 0; i < kPacketCapacity; i += 8) {
    const __m256 product = _mm256_add_ps(
        _mm256_add_ps(_mm256_mul_ps(x, _mm256_load_ps(&balls.x[i])), _mm256_mul_ps(y, _mm256_load_ps(&balls.y[i]))),
        _mm256_mul_ps(z, _mm256_load_ps(&balls.z[i])));
    const __m256 height = _mm256_sub_ps(product, square);
    sure |= sign_bits(_mm256_cmp_ps(height, _mm256_load_ps(&balls.surely_inside[i]), _CMP_GE_OQ)) << i;
    maybe |= sign_bits(_mm256_cmp_ps(height, _mm256_load_ps(&balls.maybe_inside[i]), _CMP_GE_OQ)) << i;
  }
  return sure;
}

MESHHOOD_JOINT void convert_points(const float* xyz, unsigned size, const FloatCenter& center, LeafPoints& points) {
  convert_points_in_turn(xyz, size, center, points);
}

MESHHOOD_JOINT BallWords ball_words(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls,
                                    PerLane<QueryWord>& inside, PerLane<QueryWord>& doubts) {
  LaneMask in_all = 0;
  LaneMask in_none = 0;
  for (std::size_t i = 0; i < kLeafCapacity; i += 8) {
    const __m256 square = squares_from_center(points, i, balls);
    in_all |= sign_bits(_mm256_cmp_ps(square, _mm256_set1_ps(balls.inside_all), _CMP_LT_OQ)) << i;
    in_none |= sign_bits(_mm256_cmp_ps(square, _mm256_set1_ps(balls.outside_all), _CMP_GT_OQ)) << i;
  }
  in_none &= lanes;
  in_all &= lanes & ~in_none;
  const __m256i queries = _mm256_set1_epi32(static_cast<int>(balls.queries));
  const __m256i whole = _mm256_set1_epi32(static_cast<int>(in_all));
  for (std::size_t i = 0; i < kEighths; ++i) store8(&inside[8 * i], _mm256_and_si256(queries, wide_mask(whole, i)));
  BallWords result{in_none == 0 ? balls.queries : 0, 0};
  for (LaneMask left = lanes & ~(in_all | in_none); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    QueryWord maybe = 0;
    const QueryWord sure = compare(points, lane, balls, maybe);
    inside[lane] = sure;
    result.all &= sure;
    doubts[lane] = maybe & ~sure;
    result.in_doubt |= LaneMask{maybe != sure} << lane;
  }
  return result;
}

MESHHOOD_JOINT void clear_words(LeafWords& words) {
  for (std::size_t i = 0; i < kEighths; ++i) {
    store8(&words.reached[8 * i], _mm256_setzero_si256());
    store8(&words.pending[8 * i], _mm256_setzero_si256());
  }
}

/// Moves what is pending to `reached`; returns the lanes that gained.
MESHHOOD_JOINT inline LaneMask take_pending(LeafWords& words, QueryWord whole) {
  __m256i arriving[kEighths];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment
  __m256i any = _mm256_setzero_si256();
  for (std::size_t i = 0; i < kEighths; ++i) {
    arriving[i] = _mm256_and_si256(load8(&words.pending[8 * i]), load8(&words.inside[8 * i]));
    store8(&words.pending[8 * i], _mm256_setzero_si256());
    any = _mm256_or_si256(any, _mm256_or_si256(arriving[i], load8(&words.reached[8 * i])));
  }
  // The words of all lanes together, in each lane.
  any = _mm256_or_si256(any, _mm256_permute4x64_epi64(any, 0x4E));
  any = _mm256_or_si256(any, _mm256_shuffle_epi32(any, 0x4E));
  any = _mm256_or_si256(any, _mm256_shuffle_epi32(any, 0xB1));
  any = _mm256_and_si256(any, _mm256_set1_epi32(static_cast<int>(whole)));
  LaneMask gained = 0;
  for (std::size_t i = 0; i < kEighths; ++i) {
    const __m256i before = load8(&words.reached[8 * i]);
    const __m256i all = _mm256_and_si256(any, load8(&words.inside[8 * i]));
    const __m256i grown = _mm256_or_si256(before, _mm256_or_si256(arriving[i], all));
    gained |= differing8(grown, before) << (8 * i);
    store8(&words.reached[8 * i], grown);
  }
  return gained;
}

MESHHOOD_JOINT inline LaneMask open_lanes(const LeafWords& words) {
  LaneMask open = 0;
  for (std::size_t i = 0; i < kEighths; ++i) {
    open |= differing8(load8(&words.reached[8 * i]), load8(&words.inside[8 * i])) << (8 * i);
  }
  return open;
}

/// Reaches the open neighbors of the lanes `from`; returns those that have gained.
MESHHOOD_JOINT inline LaneMask spread_once(LeafWords& words, const LaneMask* adjacency, LaneMask from, LaneMask open) {
  __m256i a = _mm256_setzero_si256();
  __m256i b = a;
  __m256i c = a;
  __m256i d = a;
  for (; from != 0; from &= from - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(from));
    if ((adjacency[lane] & open) == 0) continue;
    const __m256i to = _mm256_set1_epi32(static_cast<int>(adjacency[lane]));
    const __m256i word = _mm256_set1_epi32(static_cast<int>(words.reached[lane]));
    a = _mm256_or_si256(a, _mm256_and_si256(word, wide_mask(to, 0)));
    b = _mm256_or_si256(b, _mm256_and_si256(word, wide_mask(to, 1)));
    c = _mm256_or_si256(c, _mm256_and_si256(word, wide_mask(to, 2)));
    d = _mm256_or_si256(d, _mm256_and_si256(word, wide_mask(to, 3)));
  }
  const __m256i arriving[kEighths] = {a, b, c, d};  // NOLINT(modernize-avoid-c-arrays)
  LaneMask gained = 0;
  for (std::size_t i = 0; i < kEighths; ++i) {
    const __m256i before = load8(&words.reached[8 * i]);
    const __m256i grown = _mm256_or_si256(before, _mm256_and_si256(arriving[i], load8(&words.inside[8 * i])));
    gained |= differing8(grown, before) << (8 * i);
    store8(&words.reached[8 * i], grown);
  }
  return gained;
}

MESHHOOD_JOINT SpreadWords spread_words(LeafWords& words, const LaneMask* adjacency, QueryWord whole) {
  SpreadWords result{take_pending(words, whole), false};
  LaneMask open = open_lanes(words);
  for (LaneMask fresh = result.gained; fresh != 0 && open != 0; open = open_lanes(words)) {
    fresh = spread_once(words, adjacency, fresh, open);
    result.gained |= fresh;
  }
  result.closed = open == 0;
  return result;
}

/// Adds words to counters for each bit, a plane for each binary digit: of every 2^n vectors of words, one carry reaches
/// plane n.
class BitCounters {
 public:
  MESHHOOD_JOINT void add(const PerLane<QueryWord>& words) {
    add_pair(load8(words.data()), load8(&words[8]));
    add_pair(load8(&words[16]), load8(&words[24]));
  }

  MESHHOOD_JOINT void add_to(PerLane<std::uint64_t>& counts) const {
    for (std::size_t plane = 0; plane < used_; ++plane) {
      add_plane(planes_[plane], plane, counts);
      if (plane > 0 && (pairs_ >> (plane - 1) & 1U) != 0) add_plane(waiting_[plane], plane, counts);
    }
  }

 private:
  MESHHOOD_JOINT void add_pair(__m256i a, __m256i b) {
    __m256i carry = add_to_plane(0, a, b);
    std::size_t plane = 1;
    for (; (pairs_ >> (plane - 1) & 1U) != 0; ++plane) carry = add_to_plane(plane, waiting_[plane], carry);
    waiting_[plane] = carry;
    if (plane == used_) planes_[used_++] = _mm256_setzero_si256();
    ++pairs_;
  }

  /// The sum of three bits each stays in the plane, the carry is returned.
  MESHHOOD_JOINT __m256i add_to_plane(std::size_t plane, __m256i a, __m256i b) {
    const __m256i old = planes_[plane];
    const __m256i either = _mm256_xor_si256(a, b);
    planes_[plane] = _mm256_xor_si256(old, either);
    return _mm256_or_si256(_mm256_and_si256(a, b), _mm256_and_si256(old, either));
  }

  MESHHOOD_JOINT static void add_plane(__m256i plane, std::size_t digit, PerLane<std::uint64_t>& counts) {
    for (unsigned query = kPacketCapacity; query-- > 0; plane = _mm256_slli_epi32(plane, 1)) {
      const unsigned set = sign_bits(_mm256_castsi256_ps(plane));
      counts[query] += static_cast<std::uint64_t>(std::popcount(set)) << digit;
    }
  }

  static constexpr std::size_t kPlanes = 35;  // enough for all leaves of an index
  alignas(32) __m256i planes_[kPlanes]{};     // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment
  alignas(32) __m256i waiting_[kPlanes];      // NOLINT(modernize-avoid-c-arrays)
  std::size_t used_ = 1;
  std::uint64_t pairs_ = 0;
};

MESHHOOD_JOINT void count_words(const LeafWords* words, std::span<const LeafOfWords> list,
                                PerLane<std::uint64_t>& counts) {
  BitCounters counters;
  for (const LeafOfWords& leaf : list) counters.add(words[leaf.words].reached);
  counters.add_to(counts);
}

/// Which of eight words have the bit that `shift` moves to the top.
MESHHOOD_JOINT inline unsigned with_bit(const QueryWord* words, __m128i shift) {
  const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(words));
  return sign_bits(_mm256_castsi256_ps(_mm256_sll_epi32(eight, shift)));
}

MESHHOOD_JOINT LaneMask lanes_of(const QueryWord* reached, unsigned query) {
  const __m128i shift = _mm_cvtsi32_si128(static_cast<int>(31 - query));
  return with_bit(reached, shift) | with_bit(reached + 8, shift) << 8 | with_bit(reached + 16, shift) << 16 |
         with_bit(reached + 24, shift) << 24;
}

/// Writes those of eight ids whose bit is set.
MESHHOOD_JOINT inline VertexId* write8(__m256i ids, unsigned set, VertexId* out) {
  const auto* list = reinterpret_cast<const __m128i*>(kBitPositions[set].data());
  const __m256i order = _mm256_cvtepu8_epi32(_mm_loadl_epi64(list));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_permutevar8x32_epi32(ids, order));
  return out + std::popcount(set);
}

/// The ids of eight vertices.
MESHHOOD_JOINT inline __m256i load_ids(const VertexId* permutation, std::uint32_t first) {
  if (permutation != nullptr) return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(permutation + first));
  return _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}

MESHHOOD_JOINT void write_row(std::span<const RowPiece> pieces, unsigned query, const VertexId* permutation,
                              std::span<VertexId> out) {
  const __m128i shift = _mm_cvtsi32_si128(static_cast<int>(31 - query));
  VertexId* next = out.data();
  // The vertices of a leaf are written in steps of eight, up to seven beyond their end. So the last of a row are
  // written elsewhere first.
  constexpr std::ptrdiff_t kRoom = kLeafCapacity + 8;
  std::array<VertexId, 2 * kRoom> end_of_row;
  VertexId* begin_of_end = nullptr;
  for (const RowPiece& piece : pieces) {
    if (piece.reached != nullptr) {
      if (begin_of_end == nullptr && out.data() + out.size() - next < kRoom) {
        begin_of_end = next;
        next = end_of_row.data();
      }
      for (std::uint32_t k = 0; k < kLeafCapacity; k += 8) {
        next = write8(load_ids(permutation, piece.first + k), with_bit(piece.reached + k, shift), next);
      }
    } else if ((piece.queries >> query & 1U) != 0) {
      std::uint32_t k = 0;
      for (; k + 8 <= piece.size; k += 8, next += 8) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(next), load_ids(permutation, piece.first + k));
      }
      for (; k < piece.size; ++k) *next++ = permutation == nullptr ? piece.first + k : permutation[piece.first + k];
    }
  }
  if (begin_of_end != nullptr) std::copy(end_of_row.data(), next, begin_of_end);
}

}  // namespace

const JointKernels& avx2_joint_kernels() {
  static constexpr JointKernels kAll{convert_points, clear_words, ball_words, spread_words,
                                     count_words,    lanes_of,    write_row};
  return kAll;
}

}  // namespace meshhood
#endif
