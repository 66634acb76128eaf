// SPDX-License-Identifier: MIT
// Moments, principal components, curvatures and features of a row are a function of index, vertex and radius: the same
// bits whichever rows are asked with it, at whichever radii, in any order, by any number of threads.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/random.h"
#include "support/scale.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

/// A mesh with leaves of all sizes, and what is asked about it.
struct Subject {
  TestMesh mesh;
  Index index;
  Surface surface;
  std::vector<double> areas;
  bool has_features = true;  // they have no radius of 0 or infinity

  explicit Subject(TestMesh made)
      : mesh(std::move(made)),
        index(build(mesh.view())),
        surface(index, mesh.view()),
        areas(vertex_areas(mesh.view())) {}
};

void append(std::vector<double>& out, const std::vector<double>& values, std::size_t row, std::size_t columns) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * columns);
  out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(columns));
}

/// All results of each row, one after the other.
std::vector<std::vector<double>> results(const Subject& s, const BatchQuery& query, unsigned threads) {
  const std::size_t rows = query.result_rows(s.mesh.size());
  std::vector<std::vector<double>> out(rows);
  const auto sums = moments(s.index, query, {.degree = 4, .weights = s.areas}, {.threads = threads});
  const PrincipalComponents patch = principal_components(s.index, query, {}, {.threads = threads});
  const auto feature =
      !s.has_features ? std::vector<double>(3 * rows)
                      : features(s.surface, query,
                                 {.kinds = {Feature::Crease, Feature::Height, Feature::Variation}, .areas = s.areas},
                                 {.threads = threads});
  for (std::size_t row = 0; row < rows; ++row) {
    append(out[row], sums, row, moment_count(4));
    append(out[row], patch.center, row, 3);
    append(out[row], patch.variances, row, 3);
    append(out[row], patch.axes, row, 9);
    append(out[row], feature, row, 3);
  }
  for (const CurvatureOptions& options : {CurvatureOptions{.filter = true, .fit = CurvatureFit::Quadric},
                                          CurvatureOptions{.filter = false, .fit = CurvatureFit::Quadric},
                                          CurvatureOptions{.filter = true, .open_ball = true, .fit = CurvatureFit::Jet},
                                          CurvatureOptions{.filter = false, .fit = CurvatureFit::Jet}}) {
    const Curvatures k = curvatures(s.surface, query, options, {.threads = threads});
    for (std::size_t row = 0; row < rows; ++row) {
      append(out[row], k.k1, row, 1);
      append(out[row], k.k2, row, 1);
      append(out[row], k.d1, row, 3);
      append(out[row], k.d2, row, 3);
      out[row].push_back(k.count[row]);
    }
  }
  return out;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Which vertices and radii are queried.
struct Rows {
  std::vector<VertexId> vertices;
  std::vector<double> radii;

  [[nodiscard]] BatchQuery query() const { return {.vertices = vertices, .radius = radii}; }
  [[nodiscard]] BatchQuery row(std::size_t i) const {
    return {.vertices = std::span(vertices).subspan(i, 1), .radius = radii[i]};
  }
};

/// Rows in any order, each of one of the radii.
Rows random_rows(const Subject& s, std::span<const double> radii, Random& random) {
  Rows rows;
  for (std::size_t i = 0; i < s.mesh.size(); ++i) {
    rows.vertices.push_back(static_cast<VertexId>(random.below(s.mesh.size())));
    rows.radii.push_back(radii[random.below(radii.size())]);
  }
  return rows;
}

/// Compares rows of different radii with themselves: by several threads, some of them, each alone, and in calls of one
/// radius and of scales for all vertices.
void expect_equal_bits_of(const Subject& s, const Rows& rows, Random& random) {
  const auto all = results(s, rows.query(), 1);
  const auto by_threads = results(s, rows.query(), 3);
  Rows some;
  std::vector<std::size_t> chosen;
  for (std::size_t i = all.size(); i > 0; --i) {
    if (random.below(3) != 0) continue;
    chosen.push_back(i - 1);
    some.vertices.push_back(rows.vertices[i - 1]);
    some.radii.push_back(rows.radii[i - 1]);
  }
  const auto part = results(s, some.query(), 2);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(same_bits(all[i], by_threads[i])) << "threads, row " << i;
  for (std::size_t i = 0; i < part.size(); ++i) {
    EXPECT_TRUE(same_bits(all[chosen[i]], part[i])) << "one of three, row " << chosen[i];
  }
  for (std::size_t k = 0; k < std::min<std::size_t>(all.size(), scaled(60, 20)); ++k) {
    const std::size_t i = random.below(all.size());
    EXPECT_TRUE(same_bits(all[i], results(s, rows.row(i), 1).front())) << "alone, row " << i;
  }
  const double radius = rows.radii.front();
  const auto common = results(s, {.radius = radius}, 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_common = rows.radii[i] == radius;
    EXPECT_TRUE(!is_common || same_bits(all[i], common[rows.vertices[i]])) << "one radius, row " << i;
  }
  const auto scales = results(s, {.radius = BatchRadius::scales({rows.radii.back(), radius})}, 2);
  ASSERT_EQ(scales.size(), 2 * common.size());
  for (std::size_t v = 0; v < common.size(); ++v) {
    EXPECT_TRUE(same_bits(scales[common.size() + v], common[v])) << "scales, vertex " << v;
  }
}

TEST(Bits, OfARowDoNotDependOnTheRadiiOfOthers) {
  Random random(11);
  Subject bumps(bumpy_grid(40).finish(false));
  const auto expect = [&](const std::vector<double>& radii) {
    expect_equal_bits_of(bumps, random_rows(bumps, radii, random), random);
  };
  expect({1.5, 3.0, 7.0, 20.0});
  expect({7.0, 7.0 * (1 - 0x1p-52), 7.0 * (1 + 0x1p-52)});
  bumps.has_features = false;
  expect({0.0, 1e-300, 1e-9, 0.9, 2.5, 30.0, 1e9, std::numeric_limits<double>::infinity()});
}

TEST(Bits, OfARowDoNotDependOnOthersWithWallsAndIgnoredVertices) {
  Random random(12);
  Subject bumps(bumpy_grid(30).finish(true));
  const Index whole = std::move(bumps.index);
  std::vector<std::uint8_t> walls(bumps.mesh.size());
  std::vector<std::uint8_t> ignored(bumps.mesh.size());
  for (std::uint8_t& value : walls) value = random.below(40) == 0 ? 1 : 0;
  for (std::uint8_t& value : ignored) value = random.below(40) == 0 ? 1 : 0;
  const std::vector<double> radii{1.2, 4.0, 9.0, 18.0};
  for (const Masks& masks : {Masks{.walls = walls}, Masks{.ignored = ignored}, Masks{walls, ignored}}) {
    bumps.index = masked(whole, masks);
    bumps.surface = bumps.surface.on(bumps.index);
    expect_equal_bits_of(bumps, random_rows(bumps, radii, random), random);
  }
}

TEST(Bits, OfARowDoNotDependOnTheRadiiOfOthersOnEveryFamily) {
  Random random(13);
  std::size_t meshes = 0;
  for (const Family& family : families()) {
    TestMesh mesh = make_mesh(family, 5, scaled(300, 80));
    if (mesh.size() < 10 || mesh.face_count() == 0) continue;
    SCOPED_TRACE(family.name);
    const Subject s(std::move(mesh));
    const Adjacency graph = adjacency(s.mesh.view());
    const double edge = mean_edge_length(GraphView{s.mesh.view().positions, graph.view()});
    if (!(edge > 0 && 100 * edge < std::numeric_limits<double>::infinity())) continue;
    const std::vector<double> radii{0.01 * edge, 1.2 * edge, 2 * edge, 5 * edge, 100 * edge};
    expect_equal_bits_of(s, random_rows(s, radii, random), random);
    ++meshes;
  }
  EXPECT_GT(meshes, 15U);
  std::printf("%zu meshes\n", meshes);
}

}  // namespace
}  // namespace meshhood::test
