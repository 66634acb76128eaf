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

#define MESHHOOD_AVX512 __attribute__((target("avx512f,avx512bw,avx512vl,avx512dq,bmi,bmi2,popcnt")))

namespace meshhood {
namespace {

/// A word for each of 32 lanes.
struct Words32 {
  __m512i low;
  __m512i high;
};

MESHHOOD_AVX512 inline Words32 load(const PerLane<QueryWord>& words) {
  return {_mm512_load_si512(words.data()), _mm512_load_si512(words.data() + 16)};
}

MESHHOOD_AVX512 inline void store(PerLane<QueryWord>& words, const Words32& value) {
  _mm512_store_si512(words.data(), value.low);
  _mm512_store_si512(words.data() + 16, value.high);
}

MESHHOOD_AVX512 inline Words32 operator&(const Words32& a, const Words32& b) {
  return {_mm512_and_si512(a.low, b.low), _mm512_and_si512(a.high, b.high)};
}

MESHHOOD_AVX512 inline Words32 operator|(const Words32& a, const Words32& b) {
  return {_mm512_or_si512(a.low, b.low), _mm512_or_si512(a.high, b.high)};
}

MESHHOOD_AVX512 inline LaneMask join(__mmask16 low, __mmask16 high) {
  return static_cast<LaneMask>(_mm512_kunpackw(high, low));
}

/// The lanes in which the words differ.
MESHHOOD_AVX512 inline LaneMask differing(const Words32& a, const Words32& b) {
  return join(_mm512_cmpneq_epi32_mask(a.low, b.low), _mm512_cmpneq_epi32_mask(a.high, b.high));
}

/// `word` in the lanes of `lanes`, 0 in the others.
MESHHOOD_AVX512 inline Words32 in_lanes(LaneMask lanes, QueryWord word) {
  const auto value = static_cast<int>(word);
  return {_mm512_maskz_set1_epi32(static_cast<__mmask16>(lanes), value),
          _mm512_maskz_set1_epi32(static_cast<__mmask16>(lanes >> 16), value)};
}

/// The lanes whose word has one of `bits`.
MESHHOOD_AVX512 inline LaneMask lanes_with(const QueryWord* reached, __m512i bits) {
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

MESHHOOD_AVX512 inline __m512 load_floats(const float* from, unsigned begin, unsigned count) {
  const auto wanted = static_cast<__mmask16>(_bzhi_u32(0xFFFF, count > begin ? count - begin : 0));
  return _mm512_maskz_loadu_ps(wanted, from + begin);
}

/// One coordinate of the vertices of `lanes`, relative to the center; 0 in the other lanes.
MESHHOOD_AVX512 inline __m512 coordinate(const Interleaved& xyz, const CoordinateOrder& order, __mmask16 lanes,
                                         float center, float scale) {
  const __m512 two = _mm512_permutex2var_ps(xyz.first, _mm512_load_si512(order.in_first_two.data()), xyz.second);
  const __m512 all = _mm512_permutex2var_ps(two, _mm512_load_si512(order.in_third.data()), xyz.third);
  // mutant: avx512-points-in-every-lane
  return _mm512_maskz_mul_ps(lanes, _mm512_sub_ps(all, _mm512_set1_ps(center)), _mm512_set1_ps(scale));
}

MESHHOOD_AVX512 void convert_points(const float* xyz, unsigned size, const FloatCenter& center, LeafPoints& points) {
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

MESHHOOD_AVX512 inline Balls16 load_balls(const PacketBalls& balls, std::size_t i) {
  return {_mm512_load_ps(&balls.x[i]), _mm512_load_ps(&balls.y[i]), _mm512_load_ps(&balls.z[i]),
          _mm512_load_ps(&balls.surely_inside[i]), _mm512_load_ps(&balls.maybe_inside[i])};
}

/// `2 p.q - p.p` for sixteen queries.
MESHHOOD_AVX512 inline __m512 heights(const LeafPoints& points, std::size_t lane, const Balls16& balls) {
  const __m512 x = _mm512_mul_ps(_mm512_set1_ps(points.x[lane]), balls.x);
  const __m512 y = _mm512_mul_ps(_mm512_set1_ps(points.y[lane]), balls.y);
  const __m512 z = _mm512_mul_ps(_mm512_set1_ps(points.z[lane]), balls.z);
  return _mm512_sub_ps(_mm512_add_ps(_mm512_add_ps(x, y), z), _mm512_set1_ps(points.square[lane]));
}

MESHHOOD_AVX512 inline __m512 squares_from_center(const LeafPoints& points, std::size_t i, const PacketBalls& balls) {
  const __m512 x = _mm512_sub_ps(_mm512_load_ps(&points.x[i]), _mm512_set1_ps(balls.center_x));
  const __m512 y = _mm512_sub_ps(_mm512_load_ps(&points.y[i]), _mm512_set1_ps(balls.center_y));
  const __m512 z = _mm512_sub_ps(_mm512_load_ps(&points.z[i]), _mm512_set1_ps(balls.center_z));
  return _mm512_add_ps(_mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y)), _mm512_mul_ps(z, z));
}

MESHHOOD_AVX512 BallWords ball_words(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls,
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
  BallWords result{in_none == 0 ? balls.queries : 0, 0};
  const Balls16 first = load_balls(balls, 0);
  const Balls16 second = load_balls(balls, 16);
  for (LaneMask left = lanes & ~(in_all | in_none); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const __m512 a = heights(points, lane, first);
    const __m512 b = heights(points, lane, second);
    const QueryWord sure = join(_mm512_cmp_ps_mask(a, first.surely_inside, _CMP_GE_OQ),
                                _mm512_cmp_ps_mask(b, second.surely_inside, _CMP_GE_OQ));
    const QueryWord maybe = join(_mm512_cmp_ps_mask(a, first.maybe_inside, _CMP_GE_OQ),
                                 _mm512_cmp_ps_mask(b, second.maybe_inside, _CMP_GE_OQ));
    inside[lane] = sure;
    result.all &= sure;
    doubts[lane] = maybe & ~sure;  // mutant: avx512-words-without-doubts
    result.in_doubt |= LaneMask{maybe != sure} << lane;
  }
  return result;
}

MESHHOOD_AVX512 void clear_words(LeafWords& words) {
  const Words32 none{_mm512_setzero_si512(), _mm512_setzero_si512()};
  store(words.reached, none);
  store(words.pending, none);
}

/// Moves what is pending to `reached`.
MESHHOOD_AVX512 inline Words32 take_pending(LeafWords& words, const Words32& inside, QueryWord whole) {
  Words32 reached = load(words.reached) | (load(words.pending) & inside);
  const Words32 zero{_mm512_setzero_si512(), _mm512_setzero_si512()};
  store(words.pending, zero);
  if (whole != 0) {
    const auto any = static_cast<QueryWord>(_mm512_reduce_or_epi32(_mm512_or_si512(reached.low, reached.high)));
    reached = reached | (in_lanes(~LaneMask{0}, any & whole) & inside);
  }
  return reached;
}

MESHHOOD_AVX512 SpreadWords spread_words(LeafWords& words, const LaneMask* adjacency, QueryWord whole) {
  const Words32 inside = load(words.inside);
  const Words32 before = load(words.reached);
  Words32 reached = take_pending(words, inside, whole);
  store(words.reached, reached);
  LaneMask open = differing(reached, inside);
  for (LaneMask fresh = differing(reached, before); fresh != 0 && open != 0;) {
    Words32 arriving{_mm512_setzero_si512(), _mm512_setzero_si512()};
    for (fresh &= lanes_with(adjacency, _mm512_set1_epi32(static_cast<int>(open))); fresh != 0; fresh &= fresh - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(fresh));
      arriving = arriving | in_lanes(adjacency[lane], words.reached[lane]);
    }
    const Words32 grown = reached | (arriving & inside);  // mutant: avx512-words-spread-outside
    fresh = differing(grown, reached);
    reached = grown;
    store(words.reached, reached);
    open = differing(reached, inside);
  }
  return {differing(reached, before), open == 0};
}

/// Adds words to counters for each bit, a plane for each binary digit: of every 2^n vectors of words, one carry reaches
/// plane n.
class BitCounters {
 public:
  MESHHOOD_AVX512 BitCounters() { planes_[0] = _mm512_setzero_si512(); }

  MESHHOOD_AVX512 void add(const Words32& words) {
    __m512i carry = add_to_plane(0, words.low, words.high);
    std::size_t plane = 1;
    for (; (leaves_ >> (plane - 1) & 1U) != 0; ++plane) carry = add_to_plane(plane, waiting_[plane], carry);
    waiting_[plane] = carry;
    if (plane == used_) planes_[used_++] = _mm512_setzero_si512();
    ++leaves_;
  }

  MESHHOOD_AVX512 void add_to(PerLane<std::uint64_t>& counts) {
    // What waits is added first, so that a digit has one plane.
    const __m512i none = _mm512_setzero_si512();
    __m512i carry = none;
    for (std::size_t plane = 0; plane < used_; ++plane) {
      const bool waits = plane > 0 && (leaves_ >> (plane - 1) & 1U) != 0;
      carry = add_to_plane(plane, waits ? waiting_[plane] : none, carry);
      add_plane(planes_[plane], plane, counts);
    }
    add_plane(carry, used_, counts);
  }

 private:
  /// The sum of three bits each stays in the plane, the carry is returned.
  MESHHOOD_AVX512 __m512i add_to_plane(std::size_t plane, __m512i a, __m512i b) {
    const __m512i old = planes_[plane];
    planes_[plane] = _mm512_ternarylogic_epi32(old, a, b, 0x96);
    return _mm512_ternarylogic_epi32(old, a, b, 0xE8);
  }

  MESHHOOD_AVX512 static void add_plane(__m512i plane, std::size_t digit, PerLane<std::uint64_t>& counts) {
    for (unsigned query = 0; query < kPacketCapacity; ++query) {
      const __mmask16 set = _mm512_test_epi32_mask(plane, _mm512_set1_epi32(static_cast<int>(1U << query)));
      counts[query] += static_cast<std::uint64_t>(_mm_popcnt_u32(set)) << digit;
    }
  }

  static constexpr std::size_t kPlanes = 34;  // enough for all leaves of an index
  alignas(64) __m512i planes_[kPlanes];       // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment
  alignas(64) __m512i waiting_[kPlanes];      // NOLINT(modernize-avoid-c-arrays)
  std::size_t used_ = 1;
  std::uint64_t leaves_ = 0;
};

MESHHOOD_AVX512 void count_words(const LeafWords* words, std::span<const LeafOfWords> list,
                                 PerLane<std::uint64_t>& counts) {
  BitCounters counters;
  for (const LeafOfWords& leaf : list) counters.add(load(words[leaf.words].reached));
  counters.add_to(counts);
}

MESHHOOD_AVX512 LaneMask lanes_of(const QueryWord* reached, unsigned query) {
  return lanes_with(reached, _mm512_set1_epi32(static_cast<int>(1U << query)));
}

/// Writes the first `count` of sixteen ids, and nothing after them.
MESHHOOD_AVX512 inline VertexId* write_first(__m512i ids, unsigned count, VertexId* out) {
  // mutant: avx512-row-beyond-its-end
  _mm512_mask_storeu_epi32(out, static_cast<__mmask16>(_bzhi_u32(0xFFFF, count)), ids);
  return out + count;
}

/// Writes those of sixteen ids whose lane is set. Compressed in a register: compressing stores are slow on some
/// processors.
MESHHOOD_AVX512 inline VertexId* write16(__m512i ids, LaneMask lanes, VertexId* out) {
  const auto set = static_cast<__mmask16>(lanes);
  return write_first(_mm512_maskz_compress_epi32(set, ids), static_cast<unsigned>(_mm_popcnt_u32(set)), out);
}

/// The ids of sixteen vertices.
MESHHOOD_AVX512 inline __m512i load_ids(const VertexId* permutation, std::uint32_t first) {
  if (permutation != nullptr) return _mm512_loadu_si512(permutation + first);
  const __m512i count = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  return _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), count);
}

MESHHOOD_AVX512 void write_row(std::span<const RowPiece> pieces, unsigned query, const VertexId* permutation,
                               std::span<VertexId> out) {
  const __m512i bit = _mm512_set1_epi32(static_cast<int>(1U << query));
  VertexId* next = out.data();
  for (const RowPiece& piece : pieces) {
    if (piece.reached != nullptr) {
      const LaneMask lanes = lanes_with(piece.reached, bit);
      next = write16(load_ids(permutation, piece.first), lanes, next);
      next = write16(load_ids(permutation, piece.first + 16), lanes >> 16, next);
    } else if ((piece.queries >> query & 1U) != 0) {  // mutant: avx512-row-with-every-run
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
