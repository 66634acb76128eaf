// SPDX-License-Identifier: MIT
#include "io/weld.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/adjacency.h"

#include "support/random.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Real>
bool is_near(const std::vector<Real>& xyz, std::size_t v, std::size_t w, double eps) {
  if (eps == 0) return std::equal(&xyz[3 * v], &xyz[3 * v] + 3, &xyz[3 * w]);
  return distance(xyz, static_cast<VertexId>(v), static_cast<VertexId>(w)) <= eps;
}

/// The rule of io/weld.h, word by word.
template <class Real>
std::vector<std::uint32_t> ids_of_rule(const std::vector<Real>& xyz, double eps) {
  std::vector<std::size_t> kept;
  std::vector<std::uint32_t> ids;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
    std::uint32_t id = 0;
    while (id < kept.size() && !is_near(xyz, v, kept[id], eps)) ++id;
    if (id == kept.size()) kept.push_back(v);
    ids.push_back(id);
  }
  return ids;
}

/// How many vertices are welded.
template <class Real>
std::size_t expect_rule(const std::vector<Real>& xyz, double eps) {
  const std::vector<std::uint32_t> ids = io::welded_ids(xyz, eps);
  EXPECT_EQ(ids, ids_of_rule(xyz, eps)) << "eps " << eps;
  return ids.size() - std::set(ids.begin(), ids.end()).size();
}

/// Points of a lattice of `cells` steps along each axis: many at equal places, and many at exactly one step. The places
/// are moved by `offset`.
template <class Real>
std::vector<Real> lattice_points(Random& random, std::size_t count, std::size_t cells, double step, double offset) {
  std::vector<Real> xyz;
  for (std::size_t i = 0; i < 3 * count; ++i) {
    xyz.push_back(static_cast<Real>(offset + step * static_cast<double>(random.below(cells))));
  }
  return xyz;
}

template <class Real>
std::vector<Real> random_points(Random& random, std::size_t count, double size, double offset) {
  std::vector<Real> xyz;
  for (std::size_t i = 0; i < 3 * count; ++i) xyz.push_back(static_cast<Real>(offset + random.uniform(-size, size)));
  return xyz;
}

TEST(Weld, VerticesAtEqualPositionsBecomeOne) {
  const std::vector<float> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, -0.0F, 1, 1, 0};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 5, 4};
  const io::WeldedMesh welded = io::weld({xyz, FacesView::triangles(corners)});
  EXPECT_THAT(welded.ids, ElementsAre(0, 1, 2, 1, 2, 3));
  EXPECT_THAT(std::get<std::vector<float>>(welded.positions), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0));
  EXPECT_THAT(welded.corners, ElementsAre(0, 1, 2, 1, 3, 2));
  EXPECT_TRUE(welded.offsets.empty());
  const Adjacency joined = adjacency(welded.view());
  EXPECT_EQ(joined.view()[2].size(), 3U);
}

TEST(Weld, EveryFaceStaysWithAllItsCorners) {
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint32_t> corners{0, 1, 2, 1, 2, 0, 1, 2, 3};
  const std::vector<std::uint32_t> offsets{0, 3, 5, 5, 9};
  const io::WeldedMesh welded = io::weld({xyz, FacesView::polygons(offsets, corners)});
  EXPECT_THAT(welded.offsets, ElementsAre(0, 3, 5, 5, 9));
  EXPECT_THAT(welded.corners, ElementsAre(0, 1, 1, 1, 1, 0, 1, 1, 2));
  EXPECT_EQ(welded.view().faces.size(), 4U);
}

TEST(Weld, AVertexBecomesTheFirstKeptOneWithinEps) {
  // 1 is near 0; 2 is near 1, which is not kept; 3 is at exactly eps from both kept ones.
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0};
  EXPECT_THAT(io::welded_ids(xyz, 1), ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(io::welded_ids(xyz, std::nextafter(1.0, 0.0)), ElementsAre(0, 1, 2, 1));
}

TEST(Weld, EqualsTheRule) {
  Random random(1);
  const std::size_t count = 300;
  std::size_t cases = 0;
  std::size_t welded = 0;
  for (std::size_t round = 0; round < scaled(40, 2); ++round) {
    for (const double step : {1.0, 0.1, 0x1p-300, 0x1p-540, 0x1p400}) {
      for (const double eps : {0.0, step, 1.7 * step, 0.4 * step}) {
        welded += expect_rule(lattice_points<double>(random, count, 5, step, 0), eps);
        welded += expect_rule(lattice_points<double>(random, count, 5, step, -2 * step), eps);
        welded += expect_rule(random_points<double>(random, count, 3 * step, 0), eps);
        cases += 3;
      }
    }
    for (const double eps : {0.0, 0.01, 0.3, 100.0}) {
      welded += expect_rule(random_points<float>(random, count, 1, 0), eps);
      welded += expect_rule(lattice_points<float>(random, count, 4, 0.3, -0.6), eps);
      cases += 2;
    }
  }
  std::printf("%zu meshes of %zu vertices, %zu vertices welded\n", cases, count, welded);
  EXPECT_GT(welded, cases * count / 10);
}

// Where neighboring coordinates are about as far apart as eps, cells have one coordinate or few.
TEST(Weld, EqualsTheRuleWhereCoordinatesAreCoarse) {
  Random random(2);
  std::size_t welded = 0;
  for (std::size_t round = 0; round < scaled(20, 2); ++round) {
    for (const double offset : {1.0, 0x1p52, -0x1p300}) {
      const double spacing = std::abs(std::nextafter(offset, 2 * offset) - offset);
      for (int exponent = -3; exponent <= 4; ++exponent) {
        for (const double factor : {1.0, 1.2, 1.9}) {
          const double eps = factor * std::ldexp(spacing, exponent);
          welded += expect_rule(random_points<double>(random, 200, 4 * spacing, offset), eps);
        }
      }
    }
  }
  std::printf("%zu vertices welded\n", welded);
  EXPECT_GT(welded, 0U);
}

TEST(Weld, AnEpsOfTheSmallestOrLargestSizeIsExact) {
  Random random(3);
  for (const double eps :
       {std::numeric_limits<double>::denorm_min(), 1e-200, 1e200, std::numeric_limits<double>::max()}) {
    for (const double size : {1e-310, 1e-170, 1.0, 0x1p500}) {
      expect_rule(random_points<double>(random, 100, size, 0), eps);
      expect_rule(lattice_points<double>(random, 100, 3, size / 3, 0), eps);
    }
  }
}

TEST(Weld, PositionsAndFacesMayBeStrided) {
  const std::vector<double> columns{0, 1, 1, 0, 0, 0, 0, 0, 0};
  const std::vector<std::int64_t> corners{0, 1, 2};
  const io::WeldedMesh welded =
      io::weld({PositionsView::column_major(columns), FacesView::column_major_triangles(corners)});
  EXPECT_THAT(welded.ids, ElementsAre(0, 1, 1));
  EXPECT_THAT(welded.corners, ElementsAre(0, 1, 1));
}

TEST(Weld, AnEmptyMeshIsAccepted) {
  EXPECT_TRUE(io::weld({}).ids.empty());
  EXPECT_TRUE(io::weld({}, 1).corners.empty());
}

TEST(Weld, BadArgumentsAreRefused) {
  const std::vector<double> xyz{0, 0, 0, 1, std::nan(""), 0};
  const std::vector<double> good{0, 0, 0};
  const std::vector<std::uint32_t> corners{0, 1, 2};
  for (const double eps : {-1.0, -0x1p-1074, std::nan(""), kInfinity}) {
    expect_refused(ErrorCode::InvalidOption, "expected a finite number >= 0",
                   [&] { return io::weld({good, {}}, eps); });
    expect_refused(ErrorCode::InvalidOption, "eps", [&] { return io::welded_ids(good, eps); });
  }
  expect_refused(ErrorCode::InvalidMesh, "vertex 1", [&] { return io::weld({xyz, {}}); });
  expect_refused(ErrorCode::InvalidMesh, "vertex 1", [&] { return io::welded_ids(xyz, 0.5); });
  expect_refused(ErrorCode::InvalidMesh, "face 0", [&] { return io::weld({good, FacesView::triangles(corners)}); });
}

}  // namespace
}  // namespace meshhood::test
