// SPDX-License-Identifier: MIT
// `MomentKernels` is compiled once for each target; see lanes-inl.h. The loops run over queries or vertices that do not
// depend on each other, so that vectors of any width give the same bits.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/leaf.h"
#include "simd/moments.h"

#define HWY_TARGET_INCLUDE "simd/moment_kernels.cpp"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meshhood::inline v0_1::HWY_NAMESPACE {
namespace {

/// Two numbers whose product is a power.
struct Factors {
  std::size_t first;
  std::size_t second;
};

/// The powers of degree 2 and less, 1 x y z xx xy xz yy yz zz, are products of two of 1 x y z.
constexpr std::array<Factors, 10> kSmallPowers{
    {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 2}, {1, 3}, {2, 2}, {2, 3}, {3, 3}}};

/// The moments are products of two of these: that of the first two of the factors x..., y..., z... in this order, and
/// that of the rest.
constexpr std::array<Factors, PaddedMoments::kPadded> kFactors = [] {
  const auto small = [](std::size_t a, std::size_t b) {
    std::size_t place = 0;
    while (kSmallPowers[place].first != std::min(a, b) || kSmallPowers[place].second != std::max(a, b)) ++place;
    return place;
  };
  std::array<Factors, PaddedMoments::kPadded> factors{};
  for (std::size_t i = 0; i <= 4; ++i) {
    for (std::size_t j = 0; i + j <= 4; ++j) {
      for (std::size_t k = 0; i + j + k <= 4; ++k) {
        std::array<std::size_t, 4> axes{};  // of 1 x y z
        std::fill_n(axes.begin(), i, 1);
        std::fill_n(axes.begin() + i, j, 2);
        std::fill_n(axes.begin() + i + j, k, 3);
        factors[moment_index(i, j, k)] = {small(axes[0], axes[1]), small(axes[2], axes[3])};
      }
    }
  }
  return factors;
}();

/// The small powers of a vector of points, and these times the weight.
template <class D>
struct SmallPowers {
  using Vector = VectorOf<D>;

  SmallPowers() = default;
  HWY_INLINE SmallPowers(const MomentPoints& points, std::size_t i, Vector weight) {
    const D d;
    const auto [x, y, z] = load_rows(d, points, i);
    const Vector coordinates[]{hn::Set(d, 1.0), x, y, z};
#pragma GCC unroll 10
    for (std::size_t m = 0; m < kSmallPowers.size(); ++m) {
      plain[m] = hn::Mul(coordinates[kSmallPowers[m].first], coordinates[kSmallPowers[m].second]);
      weighted[m] = hn::Mul(weight, plain[m]);
    }
  }

  [[nodiscard]] HWY_INLINE Vector power(std::size_t m) const {
    return hn::Mul(weighted[kFactors[m].first], plain[kFactors[m].second]);
  }

  Vector plain[kSmallPowers.size()];
  Vector weighted[kSmallPowers.size()];
};

/// A vector of at most four doubles.
using Four = hn::CappedTag<double, 4>;

/// Lane j of row i becomes lane i of row j.
template <std::size_t Size>
HWY_INLINE void transpose([[maybe_unused]] VectorOf<Four> (&rows)[Size]) {
  static_assert(Size == kLanes<Four>);
#if HWY_TARGET != HWY_SCALAR
  const Four d;
  const auto even = hn::InterleaveLower(d, rows[0], rows[1]);
  const auto odd = hn::InterleaveUpper(d, rows[0], rows[1]);
  if constexpr (Size == 2) {
    rows[0] = even;
    rows[1] = odd;
  } else {
    const auto next_even = hn::InterleaveLower(d, rows[2], rows[3]);
    const auto next_odd = hn::InterleaveUpper(d, rows[2], rows[3]);
    rows[0] = hn::ConcatLowerLower(d, next_even, even);
    rows[1] = hn::ConcatLowerLower(d, next_odd, odd);
    rows[2] = hn::ConcatUpperUpper(d, next_even, even);
    rows[3] = hn::ConcatUpperUpper(d, next_odd, odd);
  }
#endif
}

/// Adds the second half to the first, until one is left.
template <class Vector, std::size_t Size>
HWY_INLINE Vector sum_by_halves(Vector (&parts)[Size]) {
  for (std::size_t half = Size / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) parts[i] = hn::Add(parts[i], parts[half + i]);
  }
  return parts[0];
}

/// Adds the second half of the lanes to the first, until at most four are left.
HWY_INLINE VectorOf<Four> as_four(Numbers numbers) {
#if HWY_TARGET == HWY_AVX3
  return hn::Add(hn::LowerHalf(Four(), numbers), hn::UpperHalf(Four(), numbers));
#else
  return numbers;
#endif
}

/// Takes the points vector by vector. A product has one moment of several points; transposed, several products become
/// several moments of each point.
HWY_INLINE void powers(const MomentPoints& points, LaneMask chosen, PaddedMoments* out) {
  const Four d;
  constexpr std::size_t kSize = kLanes<Four>;
  for (std::size_t i = 0; i < kLeafCapacity; i += kSize) {
    const LaneMask here = chosen >> i & first_lanes(kSize);
    if (here == 0) continue;
    const SmallPowers<Four> small(points, i, hn::Load(d, &points.weight[i]));
#pragma GCC unroll 40
    for (std::size_t m = 0; m < PaddedMoments::kPadded; m += kSize) {
      VectorOf<Four> rows[kSize];
#pragma GCC unroll 4
      for (std::size_t k = 0; k < kSize; ++k) rows[k] = small.power(m + k);
      transpose(rows);
      PaddedMoments* to = out;
      for (std::size_t k = 0; k < kSize; ++k) {
        hn::Store(rows[k], d, &to->at[m]);
        to += here >> k & 1U;  // the next writes over one that is not chosen
      }
    }
    out += std::popcount(here);
  }
}

/// Adds eight partial sums by halves; sum i is that of the points 8 k + i.
void sum(const MomentPoints& points, std::size_t size, PaddedMoments& out) {
  constexpr std::size_t kParts = 8 / kLanes<Doubles>;
  const Doubles d;
  SmallPowers<Doubles> small[kVectors<Doubles>];
  std::size_t vectors = 0;
  for (std::size_t i = 0; i < size || vectors % kParts != 0; i += kLanes<Doubles>) {
    const LaneMask exist = i < size ? first_lanes(static_cast<unsigned>(size)) >> i : 0;
    small[vectors++] = SmallPowers<Doubles>(points, i, only(d, mask_of(d, exist), load(points.weight[i])));
  }
  std::fill(out.at.begin() + kMomentCount, out.at.end(), 0);
#pragma GCC unroll 40
  for (std::size_t m = 0; m < kMomentCount; m += kLanes<Four>) {
    VectorOf<Four> rows[kLanes<Four>];
#pragma GCC unroll 4
    for (std::size_t k = 0; k < kLanes<Four>; ++k) {
      Numbers parts[kParts];
      for (std::size_t part = 0; part < kParts; ++part) parts[part] = small[part].power(m + k);
      for (std::size_t v = kParts; v < vectors; v += kParts) {
        for (std::size_t part = 0; part < kParts; ++part) {
          parts[part] = hn::Add(parts[part], small[v + part].power(m + k));
        }
      }
      rows[k] = as_four(sum_by_halves(parts));
    }
    transpose(rows);
    hn::Store(sum_by_halves(rows), Four(), &out.at[m]);
  }
}

/// Transposes the words of up to 64 terms as a matrix of bits: bit `i` of number `q` is bit `q` of word `i`.
HWY_INLINE void terms_of_queries(std::span<const QueryWord> words, std::array<std::uint64_t, kPacketCapacity>& out) {
  const Words d;
  out = {};
  for (std::size_t first = 0; first < words.size(); first += kLanes<Words>) {
    const std::size_t count = std::min(words.size() - first, kLanes<Words>);
    const auto some = hn::LoadU(d, words.data() + first);
    for (std::size_t q = 0; q < kPacketCapacity; ++q) {
      const LaneMask lanes = bits_of(d, hn::TestBit(some, splat(QueryWord{1} << q)));
      out[q] |= std::uint64_t{lanes & first_lanes(static_cast<unsigned>(count))} << first;
    }
  }
}

template <class Real>
void set_points(const Real* xyz, std::size_t size, const Point& center, double scale, MomentPoints& points) {
  const Doubles d;
  for (std::size_t i = 0; i < (size + 7) / 8 * 8; i += kLanes<Doubles>) {
    const auto exist = mask_of(d, i < size ? first_lanes(static_cast<unsigned>(size)) >> i : 0);
    const auto at = scaled(difference(load_points(d, xyz + 3 * i), splat_point(d, center)), splat(scale));
    const Points<Doubles> existing{only(d, exist, at.x), only(d, exist, at.y), only(d, exist, at.z)};
    store_rows(existing, points, i);
  }
}

void add_terms(const PaddedMoments* terms, std::span<const QueryWord> words, MomentsByQuery& sums) {
  constexpr std::size_t kAtOnce = std::min<std::size_t>(PaddedMoments::kPadded, 10 * kLanes<Doubles>);
  std::array<std::uint64_t, kPacketCapacity> terms_of;
  terms_of_queries(words, terms_of);
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    for (std::size_t m = 0; m < PaddedMoments::kPadded && terms_of[q] != 0; m += kAtOnce) {
      Numbers some[kAtOnce / kLanes<Doubles>];  // these stay in registers
#pragma GCC unroll 10
      for (std::size_t k = 0; k < std::size(some); ++k) some[k] = load(sums[q].at[m + k * kLanes<Doubles>]);
      for (std::uint64_t left = terms_of[q]; left != 0; left &= left - 1) {
        const PaddedMoments& term = terms[std::countr_zero(left)];
#pragma GCC unroll 10
        for (std::size_t k = 0; k < std::size(some); ++k) {
          some[k] = hn::Add(some[k], load(term.at[m + k * kLanes<Doubles>]));
        }
      }
#pragma GCC unroll 10
      for (std::size_t k = 0; k < std::size(some); ++k) store(some[k], sums[q].at[m + k * kLanes<Doubles>]);
    }
  }
}

/// Returns those of the queries `among` that vertex `i` faces.
HWY_INLINE QueryWord facing(const NormalColumns& normals, std::size_t i, const FacingTest& test, QueryWord among) {
  const Doubles d;
  const Points<Doubles> normal{splat(normals.x[i]), splat(normals.y[i]), splat(normals.z[i])};
  QueryWord word = 0;
  for (std::size_t q = 0; q < kPacketCapacity; q += kLanes<Doubles>) {
    const auto product = scalar_product(normal, load_rows(d, test.normals, q));
    word |= bits_of(d, hn::Gt(product, hn::Zero(d))) << q;
  }
  return word & among;
}

/// First compares all vertices with the axis, without branches, which could not be predicted.
void keep_facing(const NormalColumns& normals, const FacingTest& test, std::span<QueryWord> words) {
  const Floats d;
  PointPerLane<float> rounded{};
  LaneMask used = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    rounded.set(i, {normals.x[i], normals.y[i], normals.z[i]});
    used |= LaneMask{words[i] != 0} << i;
  }
  const auto [x, y, z] = test.axis;
  const Points<Floats> axis{splat(static_cast<float>(x)), splat(static_cast<float>(y)), splat(static_cast<float>(z))};
  MasksOfRow<Floats> above;
  MasksOfRow<Floats> not_below;
  for (std::size_t part = 0; part < kVectors<Floats>; ++part) {
    const auto product = scalar_product(axis, load_rows(d, rounded, part * kLanes<Floats>));
    above[part] = hn::Gt(product, splat(test.all));
    not_below[part] = hn::Gt(product, splat(-test.all));
  }
  const LaneMask faces_all = bits_of_row(d, above);
  const LaneMask faces_some = bits_of_row(d, not_below);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] &= 0 - (faces_some >> i & 1U);
  for (LaneMask left = used & faces_some & ~faces_all; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    words[i] = facing(normals, i, test, words[i]);
  }
}

/// Returns the place of the moment with power p of the axis, and powers a and b of the next two.
constexpr std::size_t rotated_index(std::size_t axis, std::size_t p, std::size_t a, std::size_t b) {
  if (axis == 0) return moment_index(p, a, b);
  return axis == 1 ? moment_index(b, p, a) : moment_index(a, b, p);
}

/// This is Horner's scheme for a Taylor shift: each `start` replaces one factor x of the powers above it by x + t.
void shift(QueryMoments& moments, const QueryVectors& by) {
  const std::array<const QueryRow*, 3> axes{&by.x, &by.y, &by.z};
  const auto step = [&](std::size_t axis, std::size_t p, std::size_t a, std::size_t b) HWY_ATTR {
    const QueryRow& t = *axes[axis];
    const QueryRow& from = moments.at[rotated_index(axis, p - 1, a, b)];
    QueryRow& to = moments.at[rotated_index(axis, p, a, b)];
    for (std::size_t q = 0; q < kPacketCapacity; q += kLanes<Doubles>)
      add_to(to[q], hn::Mul(load(t[q]), load(from[q])));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t start = 0; start < 4; ++start) {
      for (std::size_t p = 4; p > start; --p) {
        for (std::size_t a = 0; a + p <= 4; ++a) {
          for (std::size_t b = 0; a + b + p <= 4; ++b) step(axis, p, a, b);
        }
      }
    }
  }
}

// NOLINTBEGIN(modernize-avoid-c-arrays): std::array drops the alignment

/// The components of a symmetric tensor in space: that with m indices y or z, k of them z, is at m (m + 1) / 2 + k.
template <std::size_t Degree>
struct Tensor {
  Numbers at[(Degree + 1) * (Degree + 2) / 2];
};

/// Returns the moments of one degree, of the queries from `q` on.
template <std::size_t Degree>
HWY_INLINE Tensor<Degree> tensor(const QueryMoments& moments, std::size_t q) {
  Tensor<Degree> result;
#pragma GCC unroll 5
  for (std::size_t m = 0; m <= Degree; ++m) {
#pragma GCC unroll 5
    for (std::size_t k = 0; k <= m; ++k) {
      result.at[m * (m + 1) / 2 + k] = load(moments.at[moment_index(Degree - m, m - k, k)][q]);
    }
  }
  return result;
}

/// Contracts one index of the tensor with a vector.
template <std::size_t Degree>
HWY_INLINE Tensor<Degree - 1> contract(const Tensor<Degree>& in, const Points<Doubles>& by) {
  Tensor<Degree - 1> result;
#pragma GCC unroll 4
  for (std::size_t m = 0; m < Degree; ++m) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k <= m; ++k) {
      const std::size_t at = m * (m + 1) / 2 + k;
      const std::size_t below = (m + 1) * (m + 2) / 2 + k;
      result.at[at] = scalar_product(by, {in.at[at], in.at[below], in.at[below + 1]});
    }
  }
  return result;
}

void rotate(const QueryMoments& moments, const QueryFrames& frames, FrameMoments& out) {
  const Doubles d;
  for (std::size_t q = 0; q < kPacketCapacity; q += kLanes<Doubles>) {
    const auto u = load_rows(d, frames.u, q);
    const auto v = load_rows(d, frames.v, q);
    const auto n = load_rows(d, frames.n, q);
    const auto put = [q](const Tensor<1>& last, const Points<Doubles>& by, QueryRow& row)
                         HWY_ATTR { store(contract(last, by).at[0], row[q]); };
    const auto fourth = tensor<4>(moments, q);
    const auto fourth_uu = contract(contract(fourth, u), u);
    const auto fourth_vv = contract(contract(fourth, v), v);
    put(contract(fourth_uu, u), u, out.u4);
    put(contract(fourth_uu, u), v, out.u3v);
    put(contract(fourth_uu, v), v, out.u2v2);
    put(contract(fourth_vv, v), u, out.uv3);
    put(contract(fourth_vv, v), v, out.v4);
    const auto third = tensor<3>(moments, q);
    const auto third_uu = contract(contract(third, u), u);
    const auto third_uv = contract(contract(third, v), u);
    const auto third_vv = contract(contract(third, v), v);
    put(third_uu, u, out.u3);
    put(third_uu, v, out.u2v);
    put(third_uu, n, out.uun);
    put(third_uv, n, out.uvn);
    put(third_vv, u, out.uv2);
    put(third_vv, v, out.v3);
    put(third_vv, n, out.vvn);
    const auto second_u = contract(tensor<2>(moments, q), u);
    const auto second_v = contract(tensor<2>(moments, q), v);
    put(second_u, u, out.uu);
    put(second_u, v, out.uv);
    put(second_u, n, out.un);
    put(second_v, v, out.vv);
    put(second_v, n, out.vn);
    const auto first = tensor<1>(moments, q);
    put(first, u, out.u);
    put(first, v, out.v);
    put(first, n, out.n);
    store(load(moments.at[0][q]), out.one[q]);
  }
}

/// Solves b x = right by the decomposition b = L D L^T, where `b` is symmetric and given by its lower triangle, and
/// writes x to `right`; returns the determinant of `MomentKernels::fit_quadrics`. The scaling to a diagonal of ones is
/// left out, since it changes L, D and x by factors only; so are the roots of Cholesky's method.
template <std::size_t N>
HWY_INLINE Numbers solve(Numbers (&b)[N][N], Numbers (&right)[N]) {
  const auto one = splat(1.0);
  Numbers l[N][N];  // L, while `b` becomes L D
  Numbers inverse[N];
  auto product = one;
  auto determinant = one;
#pragma GCC unroll 6
  for (std::size_t j = 0; j < N; ++j) {
    const auto diagonal = b[j][j];
#pragma GCC unroll 6
    for (std::size_t i = j; i < N; ++i) {
#pragma GCC unroll 6
      for (std::size_t k = 0; k < j; ++k) b[i][j] = hn::Sub(b[i][j], hn::Mul(b[i][k], l[j][k]));
    }
    const auto is_positive = hn::Gt(diagonal, hn::Zero(Doubles()));
    product = hn::Mul(product, hn::IfThenElse(is_positive, hn::Div(b[j][j], diagonal), splat(-1.0)));
    determinant = hn::IfThenElse(hn::Ge(product, determinant), determinant, product);  // a NaN stays
    inverse[j] = hn::Div(one, b[j][j]);
#pragma GCC unroll 6
    for (std::size_t i = j + 1; i < N; ++i) l[i][j] = hn::Mul(b[i][j], inverse[j]);
  }
#pragma GCC unroll 6
  for (std::size_t i = 0; i < N; ++i) {
#pragma GCC unroll 6
    for (std::size_t k = 0; k < i; ++k) right[i] = hn::Sub(right[i], hn::Mul(l[i][k], right[k]));
  }
#pragma GCC unroll 6
  for (std::size_t solved = 0; solved < N; ++solved) {
    const std::size_t i = N - 1 - solved;
    right[i] = hn::Mul(right[i], inverse[i]);
#pragma GCC unroll 6
    for (std::size_t k = i + 1; k < N; ++k) right[i] = hn::Sub(right[i], hn::Mul(l[k][i], right[k]));
  }
  return determinant;
}

/// Fits with a constant term if N is 6.
template <std::size_t N>
void fit(const FrameMoments& s, QueryQuadrics& out) {
  for (std::size_t q = 0; q < kPacketCapacity; q += kLanes<Doubles>) {
    const auto at = [q](const QueryRow& row) HWY_ATTR { return load(row[q]); };
    Numbers b[N][N]{{at(s.u4)},
                    {at(s.u3v), at(s.u2v2)},
                    {at(s.u2v2), at(s.uv3), at(s.v4)},
                    {at(s.u3), at(s.u2v), at(s.uv2), at(s.uu)},
                    {at(s.u2v), at(s.uv2), at(s.v3), at(s.uv), at(s.vv)}};
    Numbers x[N]{at(s.uun), at(s.uvn), at(s.vvn), at(s.un), at(s.vn)};
    if constexpr (N == 6) {
      const Numbers last[]{at(s.uu), at(s.uv), at(s.vv), at(s.u), at(s.v), at(s.one)};
      for (std::size_t i = 0; i < N; ++i) b[5][i] = last[i];
      x[5] = at(s.n);
    }
    store(solve(b, x), out.determinant[q]);
    store(x[0], out.a[q]);
    store(x[1], out.b[q]);
    store(x[2], out.c[q]);
    store(x[3], out.d[q]);
    store(x[4], out.e[q]);
  }
}
// NOLINTEND(modernize-avoid-c-arrays)

/// Symmetric matrices [[p, o], [o, q]].
struct Matrices {
  Numbers p, o, q;
};

/// Eigenvalues and unit eigenvectors: (x, y) belongs to `high`, and (-y, x) to `low`.
struct EigenPairs {
  Numbers low, high;
  Numbers x, y;
};

HWY_INLINE EigenPairs eigen(const Matrices& m) {
  const Doubles d;
  const auto middle = hn::Mul(splat(0.5), hn::Add(m.p, m.q));
  const auto half = hn::Mul(splat(0.5), hn::Sub(m.p, m.q));
  const auto radius = hn::Sqrt(hn::Add(hn::Mul(half, half), hn::Mul(m.o, m.o)));
  // The half-angle formula gives first the component that is at least as large, in which nothing cancels.
  const auto cosine = hn::Div(hn::Abs(half), radius);
  const auto larger = hn::Sqrt(hn::Mul(splat(0.5), hn::Add(splat(1.0), cosine)));
  const auto smaller = hn::Div(m.o, hn::Mul(hn::Mul(splat(2.0), radius), larger));
  const auto exist = hn::Gt(radius, hn::Zero(d));  // a multiple of the unit matrix gets the axes
  const auto first = either(d, exist, larger, splat(1.0));
  const auto second = only(d, exist, smaller);
  const auto swapped = hn::And(exist, hn::Lt(half, hn::Zero(d)));
  return {hn::Sub(middle, radius), hn::Add(middle, radius), either(d, swapped, second, first),
          either(d, swapped, first, second)};
}

/// Returns a x + b y + c z, where a, b and c are vectors.
HWY_INLINE Points<Doubles> combined(const Points<Doubles>& a, Numbers x, const Points<Doubles>& b, Numbers y,
                                    const Points<Doubles>& c, Numbers z) {
  const auto at = [&](Numbers of_a, Numbers of_b, Numbers of_c)
                      HWY_ATTR { return scalar_product(Points<Doubles>{x, y, z}, {of_a, of_b, of_c}); };
  return {at(a.x, b.x, c.x), at(a.y, b.y, c.y), at(a.z, b.z, c.z)};
}

/// Scales vectors to length 1, except those of length 0.
HWY_INLINE Points<Doubles> unit(const Points<Doubles>& v) {
  const Doubles d;
  const auto size = hn::Sqrt(squared_length(v));
  return scaled(v, either(d, hn::Eq(size, hn::Zero(d)), splat(1.0), hn::Div(splat(1.0), size)));
}

void set_tangents(std::size_t queries, QueryFrames& frames) {
  const Doubles d;
  const auto one = splat(1.0);
  for (std::size_t q = 0; q < queries; q += kLanes<Doubles>) {
    const auto n = load_rows(d, frames.n, q);
    const auto is_x = hn::And(hn::Le(hn::Abs(n.x), hn::Abs(n.y)), hn::Le(hn::Abs(n.x), hn::Abs(n.z)));
    const auto y = only(d, hn::Le(hn::Abs(n.y), hn::Abs(n.z)), one);
    const Points<Doubles> axis{only(d, is_x, one), either(d, is_x, hn::Zero(d), y),
                               either(d, is_x, hn::Zero(d), hn::Sub(one, y))};
    const auto u = unit(difference(axis, scaled(n, scalar_product(axis, n))));
    const auto component = [](Numbers a, Numbers b, Numbers c, Numbers e)
                               HWY_ATTR { return hn::Sub(hn::Mul(a, b), hn::Mul(c, e)); };
    store_rows(u, frames.u, q);
    store_rows(
        Points<Doubles>{component(n.y, u.z, n.z, u.y), component(n.z, u.x, n.x, u.z), component(n.x, u.y, n.y, u.x)},
        frames.v, q);
  }
}

/// Returns the unit vector along `v` or `-v` whose component of largest magnitude, the first of several, is positive.
HWY_INLINE Points<Doubles> direction(const Points<Doubles>& v) {
  const Doubles d;
  const auto at = unit(v);
  const auto largest = hn::Max(hn::Max(hn::Abs(at.x), hn::Abs(at.y)), hn::Abs(at.z));
  const auto of_y_or_z = either(d, hn::Eq(hn::Abs(at.y), largest), at.y, at.z);
  const auto decides = either(d, hn::Eq(hn::Abs(at.x), largest), at.x, of_y_or_z);
  return scaled(at, either(d, hn::Lt(decides, hn::Zero(d)), splat(-1.0), splat(1.0)));
}

template <bool OfLibigl>
void principal_curvatures(const QueryQuadrics& quadrics, const QueryFrames& frames, std::size_t queries,
                          QueryCurvatures& out) {
  const Doubles doubles;
  const auto one = splat(1.0);
  const auto two = splat(2.0);
  for (std::size_t i = 0; i < queries; i += kLanes<Doubles>) {
    const auto d = load(quadrics.d[i]);
    const auto e = load(quadrics.e[i]);
    // The first fundamental form is E, F, G, the second L, M, N.
    // NOLINTBEGIN(readability-identifier-naming): the names of the field
    const auto E = hn::Add(one, hn::Mul(d, d));
    const auto F = hn::Mul(d, e);
    const auto G = hn::Add(one, hn::Mul(e, e));
    const auto determinant = hn::Add(E, hn::Mul(e, e));  // EG - F^2
    const auto root = hn::Sqrt(determinant);
    const auto s = hn::Div(one, root);
    const auto L = hn::Mul(hn::Mul(two, load(quadrics.a[i])), s);
    const auto M = hn::Mul(load(quadrics.b[i]), s);
    const auto N = hn::Mul(hn::Mul(two, load(quadrics.c[i])), s);
    // NOLINTEND(readability-identifier-naming)
    const auto u = load_rows(doubles, frames.u, i);
    const auto v = load_rows(doubles, frames.v, i);
    const auto n = load_rows(doubles, frames.n, i);
    const auto put = [&](const EigenPairs& found, const Points<Doubles>& d1, const Points<Doubles>& d2) HWY_ATTR {
      store(hn::Neg(found.low), out.k1[i]);
      store(hn::Neg(found.high), out.k2[i]);
      store_rows(direction(d1), out.d1, i);
      store_rows(direction(d2), out.d2, i);
    };
    if constexpr (OfLibigl) {
      const auto over = [&](Numbers a, Numbers b, Numbers c, Numbers f)
                            HWY_ATTR { return hn::Div(hn::Sub(hn::Mul(a, b), hn::Mul(c, f)), determinant); };
      const EigenPairs found = eigen({over(L, G, M, F), over(M, E, L, F), over(N, E, M, F)});
      const auto zero = hn::Zero(doubles);
      const auto in_plane = [&](Numbers curvature, Numbers x, Numbers y) HWY_ATTR {
        const auto is_none = hn::Eq(curvature, zero);
        return combined(u, either(doubles, is_none, zero, x), v, either(doubles, is_none, zero, y), n, zero);
      };
      put(found, in_plane(found.low, hn::Neg(found.y), found.x), in_plane(found.high, found.x, found.y));
    } else {
      // With I = C C^T, C = [[r, 0], [F / r, t]], the shape operator is similar to the symmetric C^-1 II C^-T, whose
      // eigenvectors q belong to the directions C^-T q.
      const auto r = hn::Sqrt(E);
      const auto t = hn::Div(root, r);
      const auto f = hn::Div(F, r);
      const auto o = hn::Div(hn::Sub(M, hn::Div(hn::Mul(f, L), r)), hn::Mul(r, t));
      const auto bent = hn::Sub(N, hn::Div(hn::Mul(hn::Mul(two, f), M), r));
      const auto q = hn::Div(hn::Add(bent, hn::Div(hn::Mul(hn::Mul(f, f), L), E)), hn::Mul(t, t));
      const EigenPairs found = eigen({hn::Div(L, E), o, q});
      const auto on_quadric = [&](Numbers first, Numbers second) HWY_ATTR {
        const auto y = hn::Div(second, t);
        const auto x = hn::Div(hn::Sub(first, hn::Mul(f, y)), r);
        return combined(u, x, v, y, n, hn::Add(hn::Mul(d, x), hn::Mul(e, y)));
      };
      put(found, on_quadric(hn::Neg(found.y), found.x), on_quadric(found.x, found.y));
    }
  }
}

constexpr MomentKernels kMomentKernels{
    .set_points_float = set_points<float>,
    .set_points_double = set_points<double>,
    .powers = powers,
    .sum = sum,
    .add_terms = add_terms,
    .keep_facing = keep_facing,
    .shift = shift,
    .set_tangents = set_tangents,
    .rotate = rotate,
    .fit_quadrics = fit<5>,
    .fit_jets = fit<6>,
    .principal_curvatures = principal_curvatures<false>,
    .principal_curvatures_of_libigl = principal_curvatures<true>,
};

}  // namespace
}  // namespace meshhood::inline v0_1::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
const meshhood::MomentKernels& meshhood::moment_kernels(Isa isa) { return MESHHOOD_TABLE(kMomentKernels, isa); }
#endif
