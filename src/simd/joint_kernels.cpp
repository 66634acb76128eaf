// SPDX-License-Identifier: MIT
// `JointKernels` is compiled once for each target; see lanes-inl.h.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/joint.h"
#include "simd/leaf.h"

#define HWY_TARGET_INCLUDE "simd/joint_kernels.cpp"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

using WordsOfRow = Word[kVectors<Words>];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment

/// Returns the lanes in which the words differ.
HWY_INLINE LaneMask differing(const PerLane<QueryWord>& a, const PerLane<QueryWord>& b) {
  MasksOfRow<Words> same;
  for (std::size_t i = 0; i < kVectors<Words>; ++i) {
    same[i] = hn::Eq(load(a[i * kLanes<Words>]), load(b[i * kLanes<Words>]));
  }
  return ~bits_of_row(Words(), same);
}

void convert_points(const float* xyz, unsigned size, const FloatCenter& center, LeafPoints& points) {
  const Floats d;
  for (std::size_t i = 0; i < kLeafCapacity; i += kLanes<Floats>) {
    const auto exists = hn::FirstN(d, size > i ? size - i : 0);
    const auto offset = scaled(difference(load_points(d, xyz + 3 * i), splat_point(d, center)), splat(center.scale));
    const Points<Floats> to{only(d, exists, offset.x), only(d, exists, offset.y), only(d, exists, offset.z)};
    store_rows(to, points, i);
    store(squared_length(to), points.square[i]);
  }
}

/// The queries that surely hold a vertex, and those that may.
struct Held {
  QueryWord surely;
  QueryWord maybe;
};

/// Compares `2 p.q - p.p` of one vertex with the balls of the packet.
HWY_INLINE Held compare(const LeafPoints& points, std::size_t lane, const PacketBalls& balls) {
  const Floats d;
  const Points<Floats> vertex{splat(points.x[lane]), splat(points.y[lane]), splat(points.z[lane])};
  const auto square = splat(points.square[lane]);
  MasksOfRow<Floats> surely;
  MasksOfRow<Floats> maybe;
  for (std::size_t part = 0; part < kVectors<Floats>; ++part) {
    const std::size_t i = part * kLanes<Floats>;
    const auto height = hn::Sub(scalar_product(vertex, load_rows(d, balls, i)), square);
    surely[part] = hn::Ge(height, load(balls.surely_inside[i]));
    maybe[part] = hn::Ge(height, load(balls.maybe_inside[i]));
  }
  return {bits_of_row(d, surely), bits_of_row(d, maybe)};
}

BallWords ball_words(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls, PerLane<QueryWord>& inside,
                     PerLane<QueryWord>& doubts) {
  const Floats d;
  MasksOfRow<Floats> near;
  MasksOfRow<Floats> far;
  for (std::size_t part = 0; part < kVectors<Floats>; ++part) {
    const auto vertices = load_rows(d, points, part * kLanes<Floats>);
    const auto square = squared_length(difference(vertices, splat_point(d, balls.center)));
    near[part] = hn::Lt(square, splat(balls.inside_all));
    far[part] = hn::Gt(square, splat(balls.outside_all));
  }
  const LaneMask in_none = bits_of_row(d, far) & lanes;
  const LaneMask in_all = bits_of_row(d, near) & lanes & ~in_none;
  for (std::size_t i = 0; i < kLeafCapacity; i += kLanes<Words>) {
    store(only(Words(), mask_of(Words(), in_all >> i), splat(balls.queries)), inside[i]);
  }
  BallWords result{in_none == 0 ? balls.queries : 0, 0};
  for (LaneMask left = lanes & ~(in_all | in_none); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const auto [surely, maybe] = compare(points, lane, balls);
    inside[lane] = surely;
    result.all &= surely;
    doubts[lane] = maybe & ~surely;
    result.in_doubt |= LaneMask{maybe != surely} << lane;
  }
  return result;
}

void clear_words(LeafWords& words) {
  for (std::size_t i = 0; i < kLeafCapacity; i += kLanes<Words>) {
    store(hn::Zero(Words()), words.reached[i]);
    store(hn::Zero(Words()), words.pending[i]);
  }
}

/// Adds what arrives, where the balls have it, to the words that are reached; returns the lanes that gain.
HWY_INLINE LaneMask grow(LeafWords& words, const WordsOfRow& arriving) {
  MasksOfRow<Words> stay;
  for (std::size_t part = 0; part < kVectors<Words>; ++part) {
    const std::size_t i = part * kLanes<Words>;
    const auto before = load(words.reached[i]);
    const auto grown = hn::Or(before, hn::And(arriving[part], load(words.inside[i])));
    stay[part] = hn::Eq(grown, before);
    store(grown, words.reached[i]);
  }
  return ~bits_of_row(Words(), stay);
}

/// Moves what is pending to `reached`; returns the lanes that gained.
HWY_INLINE LaneMask take_pending(LeafWords& words, QueryWord whole) {
  const Words d;
  WordsOfRow arriving;
  auto any = hn::Zero(d);
  for (std::size_t part = 0; part < kVectors<Words>; ++part) {
    const std::size_t i = part * kLanes<Words>;
    arriving[part] = hn::And(load(words.pending[i]), load(words.inside[i]));
    store(hn::Zero(d), words.pending[i]);
    any = hn::Or(any, hn::Or(arriving[part], load(words.reached[i])));
  }
  const auto all = splat(any_of(d, any) & whole);
  for (Word& word : arriving) word = hn::Or(word, all);
  return grow(words, arriving);
}

/// The edges within a leaf. `pass` sets what arrives at each lane over the edges from the lanes `from`, or from more;
/// it may leave out lanes that are not open.
#if HWY_TARGET == HWY_AVX3
/// Keeps them as lists with one neighbor of each lane. A lane that has no more names itself. One instruction then takes
/// 16 words from any of 32 lanes.
class Neighbors {
 public:
  explicit Neighbors(const LaneMask* adjacency) {
    const Words d;
    const Word lanes[]{hn::Iota(d, 0), hn::Iota(d, 16)};
    WordsOfRow left{hn::LoadU(d, adjacency), hn::LoadU(d, adjacency + 16)};
    for (; !hn::AllFalse(d, hn::Ne(hn::Or(left[0], left[1]), hn::Zero(d))); ++size_) {
      for (std::size_t part = 0; part < 2; ++part) lists_[size_][part] = take_first(left[part], lanes[part]);
    }
  }

  void pass(const PerLane<QueryWord>& words, LaneMask /*from*/, LaneMask /*open*/, WordsOfRow& arriving) const {
    const Word low = load(words[0]);
    const Word high = load(words[16]);
    arriving[0] = arriving[1] = hn::Zero(Words());
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t part = 0; part < 2; ++part) {
        const Word from{_mm512_permutex2var_epi32(low.raw, lists_[i][part].raw, high.raw)};
        arriving[part] = hn::Or(arriving[part], from);
      }
    }
  }

 private:
  /// Removes the first neighbor of each lane, and returns its number. The removal does not wait for that number.
  static Word take_first(Word& neighbors, Word lanes) {
    const Words d;
    const auto has = hn::Ne(neighbors, hn::Zero(d));
    const auto first = hn::And(neighbors, hn::Sub(hn::Zero(d), neighbors));
    neighbors = hn::AndNot(first, neighbors);
    // The number of a bit is the exponent of its power of two as a float.
    const Word exponent{_mm512_srli_epi32(_mm512_castps_si512(_mm512_cvtepu32_ps(first.raw)), 23)};
    return hn::IfThenElse(has, hn::Sub(exponent, hn::Set(d, 127)), lanes);
  }

  WordsOfRow lists_[kLeafCapacity];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment
  std::size_t size_ = 0;
};
#else
class Neighbors {
 public:
  explicit Neighbors(const LaneMask* adjacency) : adjacency_(adjacency) {}

  void pass(const PerLane<QueryWord>& words, LaneMask from, LaneMask open, WordsOfRow& arriving) const {
    for (Word& word : arriving) word = hn::Zero(Words());
    for (; from != 0; from &= from - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(from));
      if ((adjacency_[lane] & open) == 0) continue;
      const auto word = splat(words[lane]);
      const auto neighbors = splat(adjacency_[lane]);
      for (std::size_t part = 0; part < kVectors<Words>; ++part) {
        const auto to = hn::TestBit(neighbors, lane_bits(Words(), part * kLanes<Words>));
        arriving[part] = hn::Or(arriving[part], only(Words(), to, word));
      }
    }
  }

 private:
  const LaneMask* adjacency_;
};
#endif

SpreadWords spread_words(LeafWords& words, const LaneMask* adjacency, QueryWord whole) {
  SpreadWords result{take_pending(words, whole), false};
  LaneMask open = differing(words.reached, words.inside);
  if (result.gained != 0 && open != 0) {
    const Neighbors neighbors(adjacency);
    for (LaneMask fresh = result.gained; fresh != 0 && open != 0; open = differing(words.reached, words.inside)) {
      WordsOfRow arriving;
      neighbors.pass(words.reached, fresh, open, arriving);
      fresh = grow(words, arriving);
      result.gained |= fresh;
    }
  }
  result.closed = open == 0;
  return result;
}

LaneMask step_words(LeafWords& words, FreshWords& fresh, const LaneMask* adjacency, LaneMask from, LaneMask open,
                    QueryWord alive) {
  const Words d;
  WordsOfRow arriving;
  if (from != 0) {
    Neighbors(adjacency).pass(fresh, from, open, arriving);
  } else {
    for (Word& word : arriving) word = hn::Zero(d);
  }
  MasksOfRow<Words> has_none;
  for (std::size_t part = 0; part < kVectors<Words>; ++part) {
    const std::size_t i = part * kLanes<Words>;
    const auto coming = hn::Or(arriving[part], load(words.pending[i]));
    const auto reached = load(words.reached[i]);
    const auto added = only(d, mask_of(d, open >> i), hn::AndNot(reached, hn::And(coming, splat(alive))));
    store(added, fresh[i]);
    store(hn::Or(reached, added), words.reached[i]);
    store(hn::Zero(d), words.pending[i]);
    has_none[part] = hn::Eq(added, hn::Zero(d));
  }
  return ~bits_of_row(d, has_none);
}

/// Adds to the counts how many words of a vector have each bit, times a power of two.
class BitSums {
 public:
  explicit BitSums(PerLane<std::uint64_t>& counts) : counts_(counts) {
    for (Word& sum : sums_) sum = hn::Zero(Words());
  }
  ~BitSums() {
    PerLane<std::uint32_t> sums;
    for (std::size_t part = 0; part < kVectors<Words>; ++part) store(sums_[part], sums[part * kLanes<Words>]);
    for (std::size_t i = 0; i < kPacketCapacity; ++i) counts_[i] += sums[i];
  }
  BitSums(const BitSums&) = delete;
  BitSums& operator=(const BitSums&) = delete;

  void add(Word words, std::size_t digit) {
    alignas(64) std::array<QueryWord, kLanes<Words>> each;
    store(words, each[0]);
    const auto weight = splat(std::uint32_t{1} << digit);
    for (const QueryWord word : each) {
      for (std::size_t part = 0; part < kVectors<Words>; ++part) {
        const auto has = hn::TestBit(splat(word), lane_bits(Words(), part * kLanes<Words>));
        sums_[part] = hn::Add(sums_[part], only(Words(), has, weight));
      }
    }
  }

 private:
  PerLane<std::uint64_t>& counts_;
  WordsOfRow sums_;  // less than 2^32, because no mesh has more vertices
};

/// Counts the set bits at each position of many words. The vector of a binary digit has that digit of each count.
class BitCounters {
 public:
  BitCounters() {
    const Words d;
    ones_ = twos_ = fours_ = eights_ = hn::Zero(d);
  }

  void add(const Word (&words)[16]) {
    Word fours[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto a = add_digit(ones_, words[4 * i], words[4 * i + 1]);
      const auto b = add_digit(ones_, words[4 * i + 2], words[4 * i + 3]);
      fours[i] = add_digit(twos_, a, b);
    }
    const auto a = add_digit(fours_, fours[0], fours[1]);
    const auto b = add_digit(fours_, fours[2], fours[3]);
    add_sixteens(add_digit(eights_, a, b));
  }

  void add_to(PerLane<std::uint64_t>& counts) const {
    BitSums sums(counts);
    sums.add(ones_, 0);
    sums.add(twos_, 1);
    sums.add(fours_, 2);
    sums.add(eights_, 3);
    for (std::size_t digit = 0; digit < used_; ++digit) sums.add(planes_[digit], digit + 4);
  }

 private:
  /// Adds `a` and `b` to a digit, and returns the carry.
  static Word add_digit(Word& digit, Word a, Word b) {
    const auto old = digit;
    digit = hn::Xor(old, hn::Xor(a, b));
    return hn::Or(hn::And(a, b), hn::And(old, hn::Xor(a, b)));
  }

  /// Adds a vector of carries to the higher digits.
  void add_sixteens(Word carry) {
    const Words d;
    for (std::size_t digit = 0;; ++digit) {
      if (digit == used_) {
        planes_[used_++] = carry;
        return;
      }
      const auto old = planes_[digit];
      planes_[digit] = hn::Xor(old, carry);
      carry = hn::And(old, carry);
      if (hn::AllFalse(d, hn::Ne(carry, hn::Zero(d)))) return;
    }
  }

  static constexpr std::size_t kPlanes = 32;  // as many as the leaves of any index need
  Word ones_;
  Word twos_;
  Word fours_;
  Word eights_;
  Word planes_[kPlanes];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment
  std::size_t used_ = 0;
};

void count_words(const LeafWords* words, std::span<const LeafOfWords> list, PerLane<std::uint64_t>& counts) {
  static constexpr PerLane<QueryWord> kNone{};
  BitCounters counters;
  const std::size_t vectors = list.size() * kVectors<Words>;
  for (std::size_t i = 0; i < vectors; i += 16) {
    Word block[16];
    for (std::size_t k = 0; k < 16; ++k) {
      const std::size_t leaf = (i + k) / kVectors<Words>;
      const std::size_t part = (i + k) % kVectors<Words>;
      const auto& reached = leaf < list.size() ? words[list[leaf].words].reached : kNone;
      block[k] = load(reached[part * kLanes<Words>]);
    }
    counters.add(block);
  }
  counters.add_to(counts);
}

LaneMask lanes_of(const QueryWord* reached, unsigned query) {
  const auto bit = splat(QueryWord{1} << query);
  MasksOfRow<Words> has;
  for (std::size_t part = 0; part < kVectors<Words>; ++part) {
    has[part] = hn::TestBit(hn::LoadU(Words(), reached + part * kLanes<Words>), bit);
  }
  return bits_of_row(Words(), has);
}

/// Returns the ids of the vertices from `first` on.
HWY_INLINE VectorOf<Ids> load_ids(const VertexId* permutation, std::uint32_t first) {
  const Ids d;
  if (permutation != nullptr) return hn::LoadU(d, permutation + first);
  return hn::Add(hn::Set(d, static_cast<VertexId>(first)), hn::Iota(d, 0));
}

void write_row(std::span<const Piece> pieces, const VertexId* leaf_begin, unsigned query, const VertexId* permutation,
               std::span<VertexId> out) {
  const Ids d;
  VertexId* next = out.data();
  // Vertices are written as vectors, which may end beyond them, so the last of a row are written elsewhere first.
  constexpr std::ptrdiff_t kRoom = kLeafCapacity + kLanes<Ids>;
  std::array<VertexId, 2 * kRoom> end_of_row;
  VertexId* begin_of_end = nullptr;
  for (const Piece& piece : pieces) {
    const std::uint32_t first = leaf_begin[piece.leaves.begin];
    if (!piece.is_run()) {
      if (begin_of_end == nullptr && out.data() + out.size() - next < kRoom) {
        begin_of_end = next;
        next = end_of_row.data();
      }
      const LaneMask lanes = lanes_of(piece.reached, query);
      for (std::uint32_t k = 0; k < kLeafCapacity; k += kLanes<Ids>) {
        next = write_chosen(d, load_ids(permutation, first + k), lanes >> k, next);
      }
    } else if ((piece.queries >> query & 1U) != 0) {
      const std::uint32_t size = leaf_begin[piece.leaves.end] - first;
      std::uint32_t k = 0;
      for (; k + kLanes<Ids> <= size; k += kLanes<Ids>, next += kLanes<Ids>) {
        hn::StoreU(load_ids(permutation, first + k), d, next);
      }
      for (; k < size; ++k) {
        *next++ = permutation == nullptr ? static_cast<VertexId>(first + k) : permutation[first + k];
      }
    }
  }
  if (begin_of_end != nullptr) std::copy(end_of_row.data(), next, begin_of_end);
}

constexpr JointKernels kJointKernels{convert_points, clear_words, ball_words, spread_words,
                                     step_words,     count_words, lanes_of,   write_row};

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
const meshhood::JointKernels& meshhood::joint_kernels(Isa isa) { return MESHHOOD_TABLE(kJointKernels, isa); }
#endif
