// SPDX-License-Identifier: MIT
// `AggregateKernels`, for the target that is being compiled; see targets.cpp. The operations and their order are the
// same for each target, and none is fused, so the results have the same bits.

HWY_BEFORE_NAMESPACE();
namespace meshhood::HWY_NAMESPACE {
namespace {

using Numbers = VectorOf<Doubles>;

// The rows of a packet are processed a block at a time, a few vectors that stay in registers.
constexpr std::size_t kVectors = 4;
constexpr std::size_t kBlock = kVectors * kLanes<Doubles>;
using Block = Numbers[kVectors];  // NOLINT(modernize-avoid-c-arrays): std::array drops the alignment

/// Which rows of a block are in a word.
class RowsOfBlock {
 public:
  explicit RowsOfBlock(std::size_t block) : first_(block) {
    const hn::RebindToUnsigned<Doubles> d;
    for (std::size_t part = 0; part < kVectors; ++part) {
      bits_[part] = hn::Set(d, 1) << hn::Iota(d, part * kLanes<Doubles>);
    }
  }

  /// Those of a vector of the block.
  [[nodiscard]] HWY_INLINE hn::Mask<Doubles> in(QueryWord word, std::size_t part) const {
    const hn::RebindToUnsigned<Doubles> d;
    return hn::RebindMask(Doubles(), hn::TestBit(hn::Set(d, word >> first_), bits_[part]));
  }

 private:
  std::size_t first_;
  VectorOf<hn::RebindToUnsigned<Doubles>> bits_[kVectors];
};

HWY_INLINE Numbers number(double value) { return hn::Set(Doubles(), value); }

HWY_INLINE void load_block(const PerLane<double>& from, std::size_t block, Block& to) {
  for (std::size_t part = 0; part < kVectors; ++part)
    to[part] = hn::LoadU(Doubles(), &from[block + part * kLanes<Doubles>]);
}

HWY_INLINE void store_block(const Block& from, std::size_t block, PerLane<double>& to) {
  for (std::size_t part = 0; part < kVectors; ++part)
    hn::StoreU(from[part], Doubles(), &to[block + part * kLanes<Doubles>]);
}

HWY_INLINE void clear_block(Block& block) {
  for (Numbers& part : block) part = hn::Zero(Doubles());
}

/// Adds a number to each row of a block. Branch-free TwoSum: D. E. Knuth, The Art of Computer Programming, vol. 2, sec.
/// 4.2.2, theorem B.
HWY_INLINE void add_exactly(RowSums& sums, std::size_t block, const Block& addends) {
  Block high;
  Block low;
  load_block(sums.high, block, high);
  load_block(sums.low, block, low);
  for (std::size_t part = 0; part < kVectors; ++part) {
    const auto sum = hn::Add(high[part], addends[part]);
    const auto rounded = hn::Sub(sum, high[part]);
    low[part] =
        hn::Add(low[part], hn::Add(hn::Sub(high[part], hn::Sub(sum, rounded)), hn::Sub(addends[part], rounded)));
    high[part] = sum;
  }
  store_block(high, block, sums.high);
  store_block(low, block, sums.low);
}

void add_values(std::span<const double> values, const QueryWord* words, RowSums& sums) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    const RowsOfBlock rows(block);
    Block sum;
    clear_block(sum);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto value = number(values[k]);
      for (std::size_t part = 0; part < kVectors; ++part) {
        sum[part] = hn::Add(sum[part], hn::IfThenElseZero(rows.in(words[k], part), value));
      }
    }
    add_exactly(sums, block, sum);
  }
}

void lower_minima(std::span<const double> values, const QueryWord* words, PerLane<double>& minima) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    const RowsOfBlock rows(block);
    Block least;
    load_block(minima, block, least);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto value = number(values[k]);
      for (std::size_t part = 0; part < kVectors; ++part) {
        const auto lower = hn::And(rows.in(words[k], part), hn::Lt(value, least[part]));
        least[part] = hn::IfThenElse(lower, value, least[part]);
      }
    }
    store_block(least, block, minima);
  }
}

void sum_deviations(std::span<const double> values, const double* weights, const QueryWord* words,
                    const PerLane<double>& means, PerLane<double>& deviations, PerLane<double>& squares) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    const RowsOfBlock rows(block);
    Block mean;
    Block sum;
    Block square;
    load_block(means, block, mean);
    clear_block(sum);
    clear_block(square);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto value = number(values[k]);
      const auto weight = number(weights[k]);
      for (std::size_t part = 0; part < kVectors; ++part) {
        const auto deviation = hn::IfThenElseZero(rows.in(words[k], part), hn::Sub(value, mean[part]));
        const auto weighted = hn::Mul(deviation, weight);
        sum[part] = hn::Add(sum[part], weighted);
        square[part] = hn::Add(square[part], hn::Mul(weighted, deviation));
      }
    }
    store_block(sum, block, deviations);
    store_block(square, block, squares);
  }
}

void merge_spreads(const RowSpreads& added, RowSpreads& spreads) {
  const Doubles d;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    const auto weight = hn::Load(d, &spreads.weight[i]);
    const auto mean = hn::Load(d, &spreads.mean[i]);
    const auto low = hn::Load(d, &spreads.low[i]);
    const auto squares = hn::Load(d, &spreads.squares[i]);
    const auto added_weight = hn::Load(d, &added.weight[i]);
    const auto added_mean = hn::Load(d, &added.mean[i]);
    const auto added_low = hn::Load(d, &added.low[i]);
    const auto added_squares = hn::Load(d, &added.squares[i]);
    const auto sum = hn::Add(weight, added_weight);
    const auto step = hn::Add(hn::Sub(added_mean, mean), hn::Sub(added_low, low));
    const auto share = hn::Div(added_weight, sum);
    const auto move = hn::Mul(step, share);
    const auto moved = hn::Add(mean, move);
    const auto rounded = hn::Sub(moved, mean);
    const auto rest = hn::Add(low, hn::Add(hn::Sub(mean, hn::Sub(moved, rounded)), hn::Sub(move, rounded)));
    const auto between = hn::Mul(hn::Mul(hn::Mul(step, step), weight), share);
    const auto merged = hn::Add(squares, hn::Add(added_squares, between));
    const auto is_first = hn::Eq(weight, hn::Zero(d));  // then the difference of means would round
    const auto stays = hn::Eq(added_weight, hn::Zero(d));
    hn::Store(sum, d, &spreads.weight[i]);
    hn::Store(hn::IfThenElse(stays, mean, hn::IfThenElse(is_first, added_mean, moved)), d, &spreads.mean[i]);
    hn::Store(hn::IfThenElse(stays, low, hn::IfThenElse(is_first, added_low, rest)), d, &spreads.low[i]);
    hn::Store(hn::IfThenElse(stays, squares, hn::IfThenElse(is_first, added_squares, merged)), d, &spreads.squares[i]);
  }
}

void set_offsets(const Point& point, const PacketCenters& centers, Offsets& offsets) {
  const Doubles d;
  const auto unit = number(centers.unit);
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    const auto x = hn::Mul(hn::Sub(number(point.x), hn::Load(d, &centers.x[i])), unit);
    const auto y = hn::Mul(hn::Sub(number(point.y), hn::Load(d, &centers.y[i])), unit);
    const auto z = hn::Mul(hn::Sub(number(point.z), hn::Load(d, &centers.z[i])), unit);
    hn::Store(x, d, &offsets.x[i]);
    hn::Store(y, d, &offsets.y[i]);
    hn::Store(z, d, &offsets.z[i]);
    hn::Store(squared_length(x, y, z), d, &offsets.square[i]);
  }
}

// Not 1 - d^2 / r^2, whose rounding would give a vertex at the rim a weight.
void set_weights(const Offsets& offsets, const KernelRadius& radius, bool squared, PerLane<double>& weights) {
  const Doubles d;
  for (std::size_t i = 0; i < kPacketCapacity; i += kLanes<Doubles>) {
    const auto rest = hn::Add(hn::Sub(number(radius.square), hn::Load(d, &offsets.square[i])), number(radius.low));
    const auto raw = hn::Mul(rest, number(radius.inverse));
    auto weight = hn::IfThenElseZero(hn::Gt(raw, hn::Zero(d)), raw);  // the rim may be beyond it by rounding
    if (squared) weight = hn::Mul(weight, weight);
    hn::StoreU(weight, d, &weights[i]);
  }
}

void add_weighted(std::span<const double> values, const QueryWord* words, const RowWeights& weights, RowSums& sums) {
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    const RowsOfBlock rows(block);
    Block sum;
    clear_block(sum);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto value = number(values[k]);
      Block weight;
      load_block(weights.of_vertex[k], block, weight);
      for (std::size_t part = 0; part < kVectors; ++part) {
        sum[part] = hn::Add(sum[part], hn::IfThenElseZero(rows.in(words[k], part), hn::Mul(weight[part], value)));
      }
    }
    add_exactly(sums, block, sum);
  }
}

/// What a node adds to each row if the parenthesis of `AggregateKernels::add_moments` is not squared, and if it is.
// With q the offset of a vertex from c, and t that of c from the query vertex, d^2 = |q + t|^2, so
//   sum of s d^2 = sum s|q|^2 + 2 t . sum s q + |t|^2 sum s
//   sum of s d^4 = sum s|q|^4 + 4 t . sum s|q|^2 q + 4 t^T (sum s q q^T) t + 2 |t|^2 sum s|q|^2
//                  + 4 |t|^2 (t . sum s q) + |t|^4 sum s
void add_moments(const Moments& moments, const Offsets& offsets, double inverse_square, bool squared, QueryWord word,
                 RowSums& sums) {
  const Doubles d;
  const auto& [xx, xy, xz, yy, yz, zz] = moments.second;
  const auto two = number(2);
  const auto four = number(4);
  const auto zeroth = number(moments.zeroth);
  const auto inverse = number(inverse_square);
  const auto scalar_product = [](const std::array<double, 3>& by, Numbers x, Numbers y, Numbers z) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(x, number(by[0])), hn::Mul(y, number(by[1]))), hn::Mul(z, number(by[2])));
  };
  for (std::size_t block = 0; block < kPacketCapacity; block += kBlock) {
    const RowsOfBlock rows(block);
    Block sum;
    for (std::size_t part = 0; part < kVectors; ++part) {
      const std::size_t i = block + part * kLanes<Doubles>;
      const auto x = hn::Load(d, &offsets.x[i]);
      const auto y = hn::Load(d, &offsets.y[i]);
      const auto z = hn::Load(d, &offsets.z[i]);
      const auto square = hn::Load(d, &offsets.square[i]);
      const auto along = scalar_product(moments.first, x, y, z);
      auto less = hn::Add(hn::Add(number(moments.trace), hn::Mul(two, along)), hn::Mul(square, zeroth));
      if (squared) {
        const auto diagonal = hn::Add(hn::Add(hn::Mul(hn::Mul(x, x), number(xx)), hn::Mul(hn::Mul(y, y), number(yy))),
                                      hn::Mul(hn::Mul(z, z), number(zz)));
        const auto mixed = hn::Add(hn::Add(hn::Mul(hn::Mul(x, y), number(xy)), hn::Mul(hn::Mul(x, z), number(xz))),
                                   hn::Mul(hn::Mul(y, z), number(yz)));
        const auto quadratic = hn::Add(diagonal, hn::Mul(two, mixed));
        const auto cubic = scalar_product(moments.third, x, y, z);
        const auto by_square =
            hn::Add(hn::Add(number(2.0 * moments.trace), hn::Mul(four, along)), hn::Mul(square, zeroth));
        const auto fourths = hn::Add(hn::Add(number(moments.fourth), hn::Mul(four, hn::Add(cubic, quadratic))),
                                     hn::Mul(square, by_square));
        less = hn::Sub(hn::Mul(two, less), hn::Mul(inverse, fourths));
      }
      sum[part] = hn::IfThenElseZero(rows.in(word, part), hn::Sub(zeroth, hn::Mul(inverse, less)));
    }
    add_exactly(sums, block, sum);
  }
}

constexpr AggregateKernels kAggregateKernels{add_values,  lower_minima, sum_deviations, merge_spreads,
                                             set_offsets, set_weights,  add_weighted,   add_moments};

}  // namespace
}  // namespace meshhood::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
