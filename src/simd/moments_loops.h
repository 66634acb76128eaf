// SPDX-License-Identifier: MIT
#pragma once

// The loops of `MomentKernels`, which the sources moments_*.cpp compile once for each instruction set: they define
// MESHHOOD_MOMENTS, the attribute of each function. The loops run over queries or vertices that do not depend on each
// other, so that the compiler may use vectors of any width without changing a bit of the result.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/moments.h"

namespace meshhood {
namespace {

/// The eight numbers from `first` on, which is aligned to them.
MESHHOOD_MOMENTS inline Eight& eight(double& first) { return reinterpret_cast<Eight&>(first); }
MESHHOOD_MOMENTS inline const Eight& eight(const double& first) { return reinterpret_cast<const Eight&>(first); }

/// How the power of a moment is the power of an earlier one times a coordinate.
struct PowerStep {
  std::size_t from;
  std::size_t axis;
};

constexpr std::array<PowerStep, kMomentCount> kPowers = [] {
  std::array<PowerStep, kMomentCount> steps{};
  for (std::size_t i = 0; i <= 4; ++i) {
    for (std::size_t j = 0; i + j <= 4; ++j) {
      for (std::size_t k = 0; i + j + k <= 4; ++k) {
        PowerStep& step = steps[moment_index(i, j, k)];
        if (k > 0) {
          step = {moment_index(i, j, k - 1), 2};
        } else if (j > 0) {
          step = {moment_index(i, j - 1, k), 1};
        } else if (i > 0) {
          step = {moment_index(i - 1, j, k), 0};
        }
      }
    }
  }
  return steps;
}();

/// Lower powers first: the order in which the steps find their predecessors.
constexpr std::array<std::size_t, kMomentCount> kByDegree = [] {
  std::array<std::size_t, kMomentCount> order{};
  std::size_t at = 0;
  for (std::size_t degree = 0; degree <= 4; ++degree) {
    for (std::size_t i = 0; i <= degree; ++i) {
      for (std::size_t k = 0; i + k <= degree; ++k) order[at++] = moment_index(i, degree - i - k, k);
    }
  }
  return order;
}();

/// Two numbers whose product is a power.
struct Factors {
  std::size_t first;
  std::size_t second;
};

/// The powers of degree 2 and less, 1 x y z xx xy xz yy yz zz, as products of two of 1 x y z.
constexpr std::array<Factors, 10> kSmallPowers{
    {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 2}, {1, 3}, {2, 2}, {2, 3}, {3, 3}}};

/// The moments, as products of two of these: the first two of the factors x..., y..., z... in this order, and the rest.
constexpr std::array<Factors, PaddedMoments::kPadded> kFactors = [] {
  const auto small = [](std::array<std::size_t, 3> n) {
    constexpr std::array<std::size_t, 3> kFirstOfAxis{4, 7, 9};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (n[axis] == 2) return kFirstOfAxis[axis];
      for (std::size_t other = axis + 1; other < 3; ++other) {
        if (n[axis] == 1 && n[other] == 1) return kFirstOfAxis[axis] + other - axis;
      }
    }
    return n[0] + 2 * n[1] + 3 * n[2];
  };
  std::array<Factors, PaddedMoments::kPadded> factors{};
  for (std::size_t i = 0; i <= 4; ++i) {
    for (std::size_t j = 0; i + j <= 4; ++j) {
      for (std::size_t k = 0; i + j + k <= 4; ++k) {
        std::array<std::size_t, 3> first{};
        std::array<std::size_t, 3> rest{i, j, k};
        for (std::size_t taken = 0, axis = 0; taken < 2 && axis < 3;) {
          if (rest[axis] == 0) {
            ++axis;
            continue;
          }
          --rest[axis];
          ++first[axis];
          ++taken;
        }
        factors[moment_index(i, j, k)] = {small(first), small(rest)};
      }
    }
  }
  return factors;
}();

MESHHOOD_MOMENTS void add_powers(const MomentPoints& points, std::size_t size, PartialMoments& sums) {
  static_assert(PartialMoments::kParts == kEight);
  for (std::size_t first = 0; first < size; first += kEight) {
    // NOLINTBEGIN(modernize-avoid-c-arrays): a template would lose the attributes of the type.
    const Eight axes[]{eight(points.x[first]), eight(points.y[first]), eight(points.z[first])};
    Eight powers[kMomentCount];
    // NOLINTEND(modernize-avoid-c-arrays)
    powers[0] = eight(points.weight[first]);
    eight(sums.at[0][0]) += powers[0];
#pragma GCC unroll 34
    for (std::size_t step = 1; step < kMomentCount; ++step) {
      const std::size_t m = kByDegree[step];
      powers[m] = powers[kPowers[m].from] * axes[kPowers[m].axis];
      eight(sums.at[m][0]) += powers[m];
    }
  }
}

/// The powers of point `i`, times its weight.
MESHHOOD_MOMENTS inline void powers_of(const MomentPoints& points, std::size_t i, PaddedMoments& out) {
  const std::array<double, 4> coordinates{1, points.x[i], points.y[i], points.z[i]};
  std::array<double, kSmallPowers.size()> small;
#pragma GCC unroll 10
  for (std::size_t m = 0; m < small.size(); ++m) {
    small[m] = coordinates[kSmallPowers[m].first] * coordinates[kSmallPowers[m].second];
  }
#pragma GCC unroll 40
  for (std::size_t m = 0; m < PaddedMoments::kPadded; ++m) {
    out.at[m] = (points.weight[i] * small[kFactors[m].first]) * small[kFactors[m].second];
  }
}

/// Bit `i` is set if part `i` of the word is not 0.
MESHHOOD_MOMENTS inline std::uint64_t used_parts(QueryWord word) {
  static_assert(MomentsByWord::kQueries == 4 && MomentsByWord::kParts == 8);
  word |= word >> 1;
  word = (word | word >> 2) & 0x11111111U;
  word = (word | word >> 3) & 0x03030303U;  // two bits of each byte
  word = (word | word >> 6) & 0x000F000FU;
  return (word | word >> 12) & 0xFFU;
}

/// As `MomentKernels::add_powers_by_word`. Finds the powers of eight points before it adds them, because a processor
/// waits if it reads as a vector what it has just written number by number. The parts of eight words that are not 0 are
/// the bits of one number, so that few branches cannot be predicted.
template <void (*PowersOf)(const MomentPoints&, std::size_t, PaddedMoments&)>
MESHHOOD_MOMENTS void add_powers_by_word(const MomentPoints& points, std::span<const QueryWord> words,
                                         MomentsByWord& sums) {
  std::array<PaddedMoments, kEight> powers;
  for (std::size_t first = 0; first < words.size(); first += kEight) {
    const std::size_t count = std::min(kEight, words.size() - first);
    std::uint64_t used = 0;
    for (std::size_t i = 0; i < count; ++i) {
      PowersOf(points, first + i, powers[i]);
      used |= used_parts(words[first + i]) << (MomentsByWord::kParts * i);
    }
    for (; used != 0; used &= used - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(used));
      const std::size_t i = bit / MomentsByWord::kParts;
      const std::size_t part = bit % MomentsByWord::kParts;
      const QueryWord value = words[first + i] >> (MomentsByWord::kQueries * part) & (MomentsByWord::kValues - 1);
      PaddedMoments& sum = sums.at[part][value];
      for (std::size_t m = 0; m < PaddedMoments::kPadded; m += kEight) eight(sum.at[m]) += eight(powers[i].at[m]);
    }
  }
}

MESHHOOD_MOMENTS inline const Sixteen& sixteen(const float& first) { return reinterpret_cast<const Sixteen&>(first); }

/// The products of a vector and sixteen others.
MESHHOOD_MOMENTS inline void multiply(float x, float y, float z, const RoundedVectors& by, std::size_t first,
                                      Sixteen& out) {
  out = (x * sixteen(by.x[first]) + y * sixteen(by.y[first])) + z * sixteen(by.z[first]);
}

/// Those of the queries `among` that vertex `i` faces. Single precision decides almost all.
MESHHOOD_MOMENTS inline QueryWord facing(const NormalColumns& normals, const RoundedVectors& rounded, std::size_t i,
                                         const FacingTest& test, QueryWord among) {
  QueryWord surely = 0;
  QueryWord perhaps = 0;
  for (std::size_t q = 0; q < kPacketCapacity; q += kSixteen) {
    Sixteen products;
    multiply(rounded.x[i], rounded.y[i], rounded.z[i], test.rounded, q, products);
    surely |= greater(products, kFacingMargin) << q;
    perhaps |= greater(products, -kFacingMargin) << q;
  }
  QueryWord word = among & perhaps;
  for (QueryWord open = word & ~surely; open != 0; open &= open - 1) {
    const auto q = static_cast<std::size_t>(std::countr_zero(open));
    const QueryVectors& to = test.normals;
    const double product = (normals.x[i] * to.x[q] + normals.y[i] * to.y[q]) + normals.z[i] * to.z[q];
    if (!(product > 0)) word &= ~(QueryWord{1} << q);
  }
  return word;
}

/// The axis decides first, for all vertices together, without branches, which could not be predicted.
MESHHOOD_MOMENTS void keep_facing(const NormalColumns& normals, const FacingTest& test, std::span<QueryWord> words) {
  RoundedVectors rounded{};
  QueryWord undecided = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    rounded.x[i] = static_cast<float>(normals.x[i]);
    rounded.y[i] = static_cast<float>(normals.y[i]);
    rounded.z[i] = static_cast<float>(normals.z[i]);
    undecided |= QueryWord{words[i] != 0} << i;
  }
  QueryWord some = 0;
  const auto [x, y, z] = test.axis;
  for (std::size_t i = 0; i < kLeafCapacity; i += kSixteen) {
    Sixteen products;
    multiply(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), rounded, i, products);
    some |= greater(products, -test.all) << i;
    undecided &= ~(greater(products, test.all) << i);
  }
  for (std::size_t i = 0; i < words.size(); ++i) words[i] &= 0 - (some >> i & 1U);
  for (QueryWord left = undecided & some; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    words[i] = facing(normals, rounded, i, test, words[i]);
  }
}

/// Written without branches, which could not be predicted: each vertex goes to the end of both lists, and the lists
/// that keep it grow.
MESHHOOD_MOMENTS void append(std::uint32_t first, std::span<const QueryWord> words, QueryWord all, VertexList& common,
                             VertexList& some) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_common = words[i] == all;
    common.places[common.size] = first + static_cast<std::uint32_t>(i);
    common.words[common.size] = words[i];
    some.places[some.size] = first + static_cast<std::uint32_t>(i);
    some.words[some.size] = words[i];
    common.size += static_cast<std::size_t>(is_common);
    some.size += static_cast<std::size_t>(!is_common) & static_cast<std::size_t>(words[i] != 0);
  }
}

MESHHOOD_MOMENTS void collect(const PartialMoments& common, const MomentsByWord& some, QueryMoments& out) {
  constexpr std::size_t kQueries = MomentsByWord::kQueries;
  PaddedMoments all{};
  for (std::size_t m = 0; m < kMomentCount; ++m) all.at[m] = common.total(m);
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    PaddedMoments sum = all;
    for (std::size_t value = 0; value < MomentsByWord::kValues; ++value) {
      if ((value >> q % kQueries & 1U) == 0) continue;
      const PaddedMoments& term = some.at[q / kQueries][value];
      for (std::size_t m = 0; m < PaddedMoments::kPadded; m += kEight) eight(sum.at[m]) += eight(term.at[m]);
    }
    for (std::size_t m = 0; m < kMomentCount; ++m) out.at[m][q] = sum.at[m];
  }
}

/// `M_p += t M_(p-1)`, where p is the power of the axis.
struct ShiftStep {
  std::size_t axis;
  std::size_t to;
  std::size_t from;
};

/// The place of the moment with power p of the axis, and powers a and b of the next two.
constexpr std::size_t rotated_index(std::size_t axis, std::size_t p, std::size_t a, std::size_t b) {
  if (axis == 0) return moment_index(p, a, b);
  return axis == 1 ? moment_index(b, p, a) : moment_index(a, b, p);
}

/// Each `start` replaces one factor x of the powers above it by x + t: Horner's scheme for a Taylor shift.
constexpr std::array<ShiftStep, 105> kShift = [] {
  std::array<ShiftStep, 105> steps{};
  std::size_t at = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t start = 0; start < 4; ++start) {
      for (std::size_t p = 4; p > start; --p) {
        for (std::size_t a = 0; a + p <= 4; ++a) {
          for (std::size_t b = 0; a + b + p <= 4; ++b) {
            steps[at++] = {axis, rotated_index(axis, p, a, b), rotated_index(axis, p - 1, a, b)};
          }
        }
      }
    }
  }
  return steps;
}();

MESHHOOD_MOMENTS void shift(QueryMoments& moments, const QueryVectors& by) {
  const std::array<const QueryRow*, 3> axes{&by.x, &by.y, &by.z};
  for (const ShiftStep& step : kShift) {
    const QueryRow& t = *axes[step.axis];
    const QueryRow& from = moments.at[step.from];
    QueryRow& to = moments.at[step.to];
    for (std::size_t q = 0; q < kPacketCapacity; q += kEight) eight(to[q]) += eight(t[q]) * eight(from[q]);
  }
}

/// The components of a symmetric tensor of degree n in space: those with m of the indices y or z, and k of these z, at
/// m (m + 1) / 2 + k.
template <std::size_t Degree>
using Tensor = std::array<QueryRow, (Degree + 1) * (Degree + 2) / 2>;

template <std::size_t Degree>
MESHHOOD_MOMENTS void take(const QueryMoments& moments, Tensor<Degree>& out) {
  for (std::size_t m = 0; m <= Degree; ++m) {
    for (std::size_t k = 0; k <= m; ++k) out[m * (m + 1) / 2 + k] = moments.at[moment_index(Degree - m, m - k, k)];
  }
}

/// One index of the tensor, summed with the components of a vector.
template <std::size_t Degree>
MESHHOOD_MOMENTS void contract(const Tensor<Degree>& in, const QueryVectors& by, Tensor<Degree - 1>& out) {
  for (std::size_t m = 0; m < Degree; ++m) {
    for (std::size_t k = 0; k <= m; ++k) {
      const QueryRow& x = in[m * (m + 1) / 2 + k];
      const QueryRow& y = in[(m + 1) * (m + 2) / 2 + k];
      const QueryRow& z = in[(m + 1) * (m + 2) / 2 + k + 1];
      QueryRow& to = out[m * (m + 1) / 2 + k];
      for (std::size_t q = 0; q < kPacketCapacity; q += kEight) {
        eight(to[q]) = (eight(by.x[q]) * eight(x[q]) + eight(by.y[q]) * eight(y[q])) + eight(by.z[q]) * eight(z[q]);
      }
    }
  }
}

MESHHOOD_MOMENTS void contract(const Tensor<1>& in, const QueryVectors& by, QueryRow& out) {
  for (std::size_t q = 0; q < kPacketCapacity; q += kEight) {
    eight(out[q]) =
        (eight(by.x[q]) * eight(in[0][q]) + eight(by.y[q]) * eight(in[1][q])) + eight(by.z[q]) * eight(in[2][q]);
  }
}

MESHHOOD_MOMENTS void rotate_fourth(const QueryMoments& moments, const QueryVectors& u, const QueryVectors& v,
                                    FrameMoments& out) {
  alignas(64) Tensor<4> all;
  alignas(64) Tensor<3> once;
  alignas(64) Tensor<2> uu;
  alignas(64) Tensor<2> vv;
  alignas(64) Tensor<1> last;
  take<4>(moments, all);
  contract<4>(all, u, once);
  contract<3>(once, u, uu);
  contract<4>(all, v, once);
  contract<3>(once, v, vv);
  contract<2>(uu, u, last);
  contract(last, u, out.u4);
  contract(last, v, out.u3v);
  contract<2>(vv, v, last);
  contract(last, u, out.uv3);
  contract(last, v, out.v4);
  contract<2>(uu, v, last);
  contract(last, v, out.u2v2);
}

MESHHOOD_MOMENTS void rotate_third(const QueryMoments& moments, const QueryVectors& u, const QueryVectors& v,
                                   const QueryVectors& n, FrameMoments& out) {
  alignas(64) Tensor<3> all;
  alignas(64) Tensor<2> once;
  alignas(64) Tensor<1> last;
  take<3>(moments, all);
  contract<3>(all, u, once);
  contract<2>(once, u, last);
  contract(last, u, out.u3);
  contract(last, v, out.u2v);
  contract(last, n, out.uun);
  contract<3>(all, v, once);
  contract<2>(once, v, last);
  contract(last, u, out.uv2);
  contract(last, v, out.v3);
  contract(last, n, out.vvn);
  contract<2>(once, u, last);
  contract(last, n, out.uvn);
}

MESHHOOD_MOMENTS void rotate_second(const QueryMoments& moments, const QueryVectors& u, const QueryVectors& v,
                                    const QueryVectors& n, FrameMoments& out) {
  alignas(64) Tensor<2> all;
  alignas(64) Tensor<1> last;
  take<2>(moments, all);
  contract<2>(all, u, last);
  contract(last, u, out.uu);
  contract(last, v, out.uv);
  contract(last, n, out.un);
  contract<2>(all, v, last);
  contract(last, v, out.vv);
  contract(last, n, out.vn);
}

MESHHOOD_MOMENTS void rotate(const QueryMoments& moments, const QueryVectors& u, const QueryVectors& v,
                             const QueryVectors& n, FrameMoments& out) {
  rotate_fourth(moments, u, v, out);
  rotate_third(moments, u, v, n, out);
  rotate_second(moments, u, v, n, out);
}

// NOLINTBEGIN(modernize-avoid-c-arrays): a template would lose the attributes of `Eight`.

/// Solves b x = right by the decomposition b = L D L^T, where `b` is symmetric and given by its lower triangle, and
/// writes x to `right`. The scaling to a diagonal of ones is left out, since it changes L, D and x by factors only; so
/// are the roots of Cholesky's method.
template <std::size_t N>
MESHHOOD_MOMENTS inline void solve(Eight (&b)[N][N], Eight (&right)[N], Eight& determinant) {
  const Eight one = Eight{} + 1;
  Eight l[N][N];  // while `b` becomes L D
  Eight inverse[N];
  Eight product = one;
  determinant = one;
#pragma GCC unroll 6
  for (std::size_t j = 0; j < N; ++j) {
    const Eight diagonal = b[j][j];
    for (std::size_t i = j; i < N; ++i) {
      for (std::size_t k = 0; k < j; ++k) b[i][j] -= b[i][k] * l[j][k];
    }
    product *= diagonal > 0 ? b[j][j] / diagonal : -one;
    determinant = product >= determinant ? determinant : product;  // NaN stays
    inverse[j] = 1 / b[j][j];
    for (std::size_t i = j + 1; i < N; ++i) l[i][j] = b[i][j] * inverse[j];
  }
#pragma GCC unroll 6
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < i; ++k) right[i] -= l[i][k] * right[k];
  }
#pragma GCC unroll 6
  for (std::size_t solved = 0; solved < N; ++solved) {
    const std::size_t i = N - 1 - solved;
    right[i] *= inverse[i];
    for (std::size_t k = i + 1; k < N; ++k) right[i] -= l[k][i] * right[k];
  }
}

/// The queries from `q` on.
template <std::size_t N>
MESHHOOD_MOMENTS inline void store(const Eight (&x)[N], const Eight& determinant, std::size_t q, QueryQuadrics& out) {
  eight(out.a[q]) = x[0];
  eight(out.b[q]) = x[1];
  eight(out.c[q]) = x[2];
  eight(out.d[q]) = x[3];
  eight(out.e[q]) = x[4];
  eight(out.determinant[q]) = determinant;
}

MESHHOOD_MOMENTS void fit_quadrics(const FrameMoments& s, QueryQuadrics& out) {
  for (std::size_t q = 0; q < kPacketCapacity; q += kEight) {
    Eight b[5][5]{{eight(s.u4[q])},
                  {eight(s.u3v[q]), eight(s.u2v2[q])},
                  {eight(s.u2v2[q]), eight(s.uv3[q]), eight(s.v4[q])},
                  {eight(s.u3[q]), eight(s.u2v[q]), eight(s.uv2[q]), eight(s.uu[q])},
                  {eight(s.u2v[q]), eight(s.uv2[q]), eight(s.v3[q]), eight(s.uv[q]), eight(s.vv[q])}};
    Eight right[5]{eight(s.uun[q]), eight(s.uvn[q]), eight(s.vvn[q]), eight(s.un[q]), eight(s.vn[q])};
    Eight determinant;
    solve(b, right, determinant);
    store(right, determinant, q, out);
  }
}

MESHHOOD_MOMENTS void fit_jets(const FrameMoments& s, const QueryVectors& sums, const QueryRow& counts,
                               QueryQuadrics& out) {
  for (std::size_t q = 0; q < kPacketCapacity; q += kEight) {
    Eight b[6][6]{
        {eight(s.u4[q])},
        {eight(s.u3v[q]), eight(s.u2v2[q])},
        {eight(s.u2v2[q]), eight(s.uv3[q]), eight(s.v4[q])},
        {eight(s.u3[q]), eight(s.u2v[q]), eight(s.uv2[q]), eight(s.uu[q])},
        {eight(s.u2v[q]), eight(s.uv2[q]), eight(s.v3[q]), eight(s.uv[q]), eight(s.vv[q])},
        {eight(s.uu[q]), eight(s.uv[q]), eight(s.vv[q]), eight(sums.x[q]), eight(sums.y[q]), eight(counts[q])}};
    Eight right[6]{eight(s.uun[q]), eight(s.uvn[q]), eight(s.vvn[q]), eight(s.un[q]), eight(s.vn[q]), eight(sums.z[q])};
    Eight determinant;
    solve(b, right, determinant);
    store(right, determinant, q, out);
  }
}
// NOLINTEND(modernize-avoid-c-arrays)

constexpr MomentKernels kMomentKernels{
    .add_powers = add_powers,
    .add_powers_by_word = add_powers_by_word<powers_of>,
    .keep_facing = keep_facing,
    .append = append,
    .collect = collect,
    .shift = shift,
    .rotate = rotate,
    .fit_quadrics = fit_quadrics,
    .fit_jets = fit_jets,
};

}  // namespace
}  // namespace meshhood
