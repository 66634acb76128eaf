// SPDX-License-Identifier: MIT
// Moments, principal components, curvatures and features of a row are a function of index, vertex and radius: the same
// bits whichever rows are asked with it, in any order, by any number of threads.
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
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
struct Surface {
  TestMesh mesh;
  Index index;
  CurvatureIndex surface;
  std::vector<double> areas;

  explicit Surface(TestMesh made)
      : mesh(std::move(made)),
        index(build(mesh.view())),
        surface(CurvatureIndex::build(index, mesh.view())),
        areas(vertex_areas(mesh.view())) {}
};

void append(std::vector<double>& out, const std::vector<double>& values, std::size_t row, std::size_t columns) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * columns);
  out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(columns));
}

/// All results of each row, one after the other.
std::vector<std::vector<double>> results(const Surface& s, const BatchVertices& vertices, double radius,
                                         unsigned threads) {
  const std::size_t rows = vertices.list() ? vertices.list()->size() : s.mesh.size();
  std::vector<std::vector<double>> out(rows);
  const BatchQuery query{.vertices = vertices, .radius = radius};
  const auto sums = moments(s.index, query, {.degree = 4, .weights = s.areas, .threads = threads});
  const PrincipalComponents patch = principal_components(s.index, query, {.threads = threads});
  const auto feature =
      features(s.surface, {vertices, radius},
               {.kinds = {Feature::Crease, Feature::Height, Feature::Variation}, .areas = s.areas, .threads = threads});
  for (std::size_t row = 0; row < rows; ++row) {
    append(out[row], sums, row, moment_count(4));
    append(out[row], patch.center, row, 3);
    append(out[row], patch.variances, row, 3);
    append(out[row], patch.axes, row, 9);
    append(out[row], feature, row, 3);
  }
  for (const bool filter : {true, false}) {
    for (const CurvatureFit fit : {CurvatureFit::Quadric, CurvatureFit::Jet}) {
      const Curvatures k = curvatures(s.surface, query, {.filter = filter, .fit = fit, .threads = threads});
      for (std::size_t row = 0; row < rows; ++row) {
        append(out[row], k.k1, row, 1);
        append(out[row], k.k2, row, 1);
        append(out[row], k.d1, row, 3);
        append(out[row], k.d2, row, 3);
      }
    }
  }
  return out;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// How many of the rows differ from those of the same vertices among all.
std::size_t different(const Surface& s, const std::vector<std::vector<double>>& all, const std::vector<VertexId>& rows,
                      double radius, unsigned threads) {
  const auto found = results(s, rows, radius, threads);
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) count += static_cast<std::size_t>(!same_bits(found[i], all[rows[i]]));
  return count;
}

void expect_equal_bits(const Surface& s, double radius, Random& random) {
  const auto all = results(s, {}, radius, 1);
  const auto count = static_cast<VertexId>(s.mesh.size());
  std::vector<VertexId> shuffled(count);
  std::iota(shuffled.begin(), shuffled.end(), VertexId{0});
  for (std::size_t i = count; i > 1; --i) std::swap(shuffled[i - 1], shuffled[random.below(i)]);
  EXPECT_EQ(different(s, all, shuffled, radius, 1), 0U) << "shuffled";
  EXPECT_EQ(different(s, all, shuffled, radius, 4), 0U) << "threads";
  for (const std::size_t part : {std::size_t{2}, std::size_t{10}, std::size_t{50}}) {
    std::vector<VertexId> some(shuffled.begin(), shuffled.begin() + static_cast<std::ptrdiff_t>(count / part));
    if (!some.empty()) some.push_back(some.front());
    EXPECT_EQ(different(s, all, some, radius, 2), 0U) << "one of " << part << " vertices, one twice";
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(count, scaled(40, 8)); ++i) {
    EXPECT_EQ(different(s, all, {shuffled[i]}, radius, 1), 0U) << "vertex " << shuffled[i] << " alone";
  }
}

TEST(Bits, OfARowDependOnIndexVertexAndRadiusAlone) {
  Random random(9);
  const Surface bumps(bumpy_grid(40).finish(false));
  for (const double radius : {1.5, 3.0, 7.0, 20.0}) {
    SCOPED_TRACE(radius);
    expect_equal_bits(bumps, radius, random);
  }
}

TEST(Bits, OfARowDependOnIndexVertexAndRadiusAloneOnEveryFamily) {
  Random random(10);
  std::size_t meshes = 0;
  for (const Family& family : families()) {
    TestMesh mesh = make_mesh(family, 3, 300);
    if (mesh.size() < 10 || mesh.face_count() == 0) continue;
    SCOPED_TRACE(family.name);
    const Surface s(std::move(mesh));
    const Adjacency graph = adjacency(s.mesh.view());
    const double edge = mean_edge_length(GraphView{s.mesh.view().positions, graph.view()});
    const bool radii_are_valid = edge > 0 && 4 * edge < std::numeric_limits<double>::infinity();
    if (!radii_are_valid) continue;
    for (const double edges : {1.2, 4.0}) expect_equal_bits(s, edges * edge, random);
    ++meshes;
  }
  EXPECT_GT(meshes, 15U);
  std::printf("%zu meshes\n", meshes);
}

TEST(Bits, OfEqualRadiiInAListAreThoseOfOneRadius) {
  const Surface s(bumpy_grid(25).finish(true));
  const std::vector<VertexId> rows{300, 7, 311, 300};
  const std::vector<double> radii(rows.size(), 4.0);
  const auto listed = moments(s.index, {.vertices = rows, .radius = radii}, {.degree = 4});
  const auto common = moments(s.index, {.vertices = rows, .radius = 4.0}, {.degree = 4});
  EXPECT_TRUE(same_bits(listed, common));
}

}  // namespace
}  // namespace meshhood::test
