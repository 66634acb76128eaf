// SPDX-License-Identifier: MIT
// Paths along a surface: against the algorithm of Dijkstra on lines found by angles, and on a sphere.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "exact/index_access.h"
#include "exact/weighted_graph.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/round_meshes.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair sorted(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }

/// The lines of a mesh of triangles: edges, and those across a side, by the law of cosines.
class PlainLines {
 public:
  PlainLines(const TestMesh& mesh, const std::vector<std::uint8_t>& walls) : mesh_(mesh), walls_(walls) {
    std::map<Pair, std::set<std::uint32_t>> opposite;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = face[i];
        const std::uint32_t b = face[(i + 1) % 3];
        if (a != b) offer(a, b, distance(a, b));
        if (is_open(face)) opposite[sorted(a, b)].insert(face[(i + 2) % 3]);
      }
    }
    for (const auto& [side, corners] : opposite) {
      if (corners.size() == 2) cross(side, *corners.begin(), *corners.rbegin());
    }
  }

  /// From vertex 0, without passing walls.
  [[nodiscard]] std::vector<double> lengths() const {
    std::vector<double> result(mesh_.size(), kInfinity);
    if (walls_[0] == 0) result[0] = 0;
    for (bool changes = true; changes;) {
      changes = false;
      for (const auto& [ends, length] : lines_) {
        const auto [a, b] = ends;
        if (walls_[a] != 0 || walls_[b] != 0) continue;
        for (const auto& [from, to] : {Pair(a, b), Pair(b, a)}) {
          if (!(result[from] + length < result[to])) continue;
          result[to] = result[from] + length;
          changes = true;
        }
      }
    }
    return result;
  }

 private:
  [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b) const {
    return meshhood::distance(mesh_.positions_view(), a, b);
  }

  /// Whether it has three corners, none of which is a wall.
  [[nodiscard]] bool is_open(std::span<const std::uint32_t> face) const {
    return face[0] != face[1] && face[1] != face[2] && face[2] != face[0] &&
           std::ranges::none_of(face, [&](std::uint32_t v) { return walls_[v] != 0; });
  }

  void offer(std::uint32_t a, std::uint32_t b, double length) {
    const auto [found, is_new] = lines_.emplace(sorted(a, b), length);
    if (!is_new) found->second = std::min(found->second, length);
  }

  /// The angle at `a` between `b` and `c`. Beside a side without a length, so large that nothing crosses there.
  [[nodiscard]] double angle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const double ab = distance(a, b);
    const double ac = distance(a, c);
    const double bc = distance(b, c);
    if (ab * ac == 0) return std::numbers::pi;
    return std::acos(std::clamp((ab * ab + ac * ac - bc * bc) / (2 * ab * ac), -1.0, 1.0));
  }

  void cross(const Pair& side, std::uint32_t c, std::uint32_t d) {
    const auto [a, b] = side;
    const double at_a = angle(a, b, c) + angle(a, b, d);
    const double at_b = angle(b, a, c) + angle(b, a, d);
    if (!(at_a < std::numbers::pi && at_b < std::numbers::pi)) return;
    const double ac = distance(a, c);
    const double ad = distance(a, d);
    offer(c, d, std::sqrt(std::max(0.0, ac * ac + ad * ad - 2 * ac * ad * std::cos(at_a))));
  }

  const TestMesh& mesh_;
  const std::vector<std::uint8_t>& walls_;
  std::map<Pair, double> lines_;
};

std::vector<double> lengths_from(const Index& index, VertexId start, double radius = kInfinity) {
  std::vector<VertexId> ids;
  std::vector<double> lengths;
  Searcher(index, Metric::Path).neighborhood(start, radius, ids, lengths);
  std::vector<double> result(index.vertex_count(), kInfinity);
  for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]] = lengths[i];
  return result;
}

/// The fans of all faces, as a mesh.
TestMesh in_triangles(TestMesh mesh) {
  const TestMesh given = mesh;
  mesh.corners.clear();
  mesh.offsets.assign(1, 0);
  for (std::size_t f = 0; f < given.face_count(); ++f) {
    const auto face = given.face(f);
    for (std::size_t i = 2; i < face.size(); ++i) mesh.add_face({face[0], face[i - 1], face[i]});
  }
  return mesh;
}

MESHHOOD_SUITE_OF_FAMILIES(SurfacePathsOf);

TEST_P(SurfacePathsOf, AreThoseOfAPlainSearch) {
  if (GetParam().name == "mixed scales") GTEST_SKIP() << "angles of its needles have no digits";
  if (GetParam().name == "vanishing") GTEST_SKIP() << "squares of its lengths have no digits";
  for (const std::size_t vertices : {std::size_t{5}, std::size_t{40}, scaled(400, 100)}) {
    const TestMesh mesh = in_triangles(make_mesh(GetParam(), vertices, vertices));
    if (mesh.face_count() == 0) GTEST_SKIP() << "a mesh without triangles";
    Random random(vertices);
    for (const std::uint64_t share : {std::uint64_t{0}, std::uint64_t{12}}) {
      std::vector<std::uint8_t> walls(mesh.size(), 0);
      for (auto& wall : walls) wall = share != 0 && random.below(share) == 0 ? 1 : 0;
      const Index whole = build(mesh.view());
      const Surface surface = Surface(whole, mesh.view()).on(masked(whole, {.walls = walls}));
      const std::vector<double> found = lengths_from(surface_paths(surface), 0);
      const std::vector<double> expected = PlainLines(mesh, walls).lengths();
      for (std::size_t v = 0; v < mesh.size(); ++v) {
        if (expected[v] == kInfinity) {
          EXPECT_EQ(found[v], kInfinity) << "vertex " << v;
        } else {
          EXPECT_NEAR(found[v], expected[v], 1e-7 * (expected[v] + 1e-300)) << "vertex " << v;
        }
      }
    }
  }
}

/// A square of two triangles in a plane, its second corner raised by the angle.
TestMesh folded_square(double angle) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(1, 0, 0);
  mesh.add_vertex(0.5, 1, 0);
  mesh.add_vertex(0.5, -std::cos(angle), std::sin(angle));
  mesh.add_face({0, 1, 2});
  mesh.add_face({1, 0, 3});
  return mesh.finish(false);
}

TEST(SurfacePaths, CrossASideAsIfItWereFlat) {
  for (const double angle : {0.0, 0.5, 1.5, 3.0}) {
    const TestMesh mesh = folded_square(angle);
    const Surface surface(build(mesh.view()), mesh.view());
    EXPECT_NEAR(lengths_from(surface_paths(surface), 2)[3], 2, 1e-15);
  }
}

TEST(SurfacePaths, CrossASideOfFacesThatAreListedTwice) {
  TestMesh mesh = folded_square(0);
  for (const auto& [a, b, c] : {std::array{0U, 1U, 2U}, {3U, 0U, 1U}, {1U, 0U, 2U}}) {
    mesh.add_face({a, b, c});
    mesh.finish(false);
    const Surface surface(build(mesh.view()), mesh.view());
    EXPECT_NEAR(lengths_from(surface_paths(surface), 2)[3], 2, 1e-15) << mesh.face_count() << " faces";
  }
}

TEST(SurfacePaths, CrossThePolygonsOfAPlane) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(1, 0, 0);
  mesh.add_vertex(1, 1, 0);
  mesh.add_vertex(0, 1, 0);
  mesh.add_face({0, 1, 2, 3});
  mesh.finish(false);
  const Index index = surface_paths(Surface(build(mesh.view()), mesh.view()));
  EXPECT_DOUBLE_EQ(lengths_from(index, 0)[2], std::sqrt(2));
  EXPECT_DOUBLE_EQ(lengths_from(index, 1)[3], std::sqrt(2));
}

TEST(SurfacePaths, CrossNoCutEdgeAndNoSideOfThreeTriangles) {
  TestMesh mesh = folded_square(0);
  const GraphData whole = extract_graph(build(mesh.view()));
  const std::array<VertexId, 2> side{0, 1};
  const Adjacency cut = cut_edges(whole.adjacency.view(), side);
  const Index index = build(GraphView{mesh.positions_view(), cut.view()});
  EXPECT_GT(lengths_from(surface_paths(Surface(index, mesh.view().faces)), 2)[3], 2.1);
  mesh.add_vertex(0.5, 0, 1);
  mesh.add_face({0, 1, 4});
  mesh.finish(false);
  EXPECT_GT(lengths_from(surface_paths(Surface(build(mesh.view()), mesh.view())), 2)[3], 2.1);
}

TEST(SurfacePaths, KeepNoMemoryThatTheyDoNotUse) {
  const TestMesh mesh = ball(9, 13);
  const Index index = surface_paths(Surface(build(mesh.view()), mesh.view()));
  const WeightedGraph& graph = IndexAccess::share_graph(index)->paths_of(IndexAccess::view(index));
  EXPECT_EQ(graph.lengths.capacity(), graph.lengths.size());
  EXPECT_EQ(graph.edges->neighbors.capacity(), graph.edges->neighbors.size());
  EXPECT_EQ(graph.edges->offsets.capacity(), graph.edges->offsets.size());
}

/// How much longer than a great circle, in the mean.
double mean_excess(const TestMesh& mesh, const Index& index) {
  double sum = 0;
  std::size_t count = 0;
  for (VertexId v = 0; v < mesh.size(); v += 97) {
    const std::vector<double> lengths = lengths_from(index, v, 1);
    for (VertexId w = 0; w < mesh.size(); ++w) {
      const double chord = distance(mesh.positions_view(), v, w);
      if (lengths[w] == kInfinity || chord < 0.3) continue;
      sum += lengths[w] / (2 * std::asin(chord / 2)) - 1;
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

TEST(SurfacePaths, AreNearerToGeodesicsThanPathsAlongEdges) {
  const auto [mesh, index] = indexed(ball(48, 63));
  const double by_edges = mean_excess(mesh, index);
  const double by_lines = mean_excess(mesh, surface_paths(Surface(index, mesh.view())));
  std::printf("longer than great circles: %.2f %% by edges, %.2f %% by lines\n", 100 * by_edges, 100 * by_lines);
  EXPECT_LT(by_lines, 0.5 * by_edges);
}

TEST(SurfacePaths, HaveRowsOfTheirOwnInEveryBatch) {
  const auto [mesh, whole] = indexed(ball(20, 31));
  const Surface surface(whole, mesh.view());
  const Index index = surface_paths(surface);
  const BatchQuery query{.radius = 0.6, .metric = Metric::Path};
  const Neighborhoods rows = neighborhoods(index, query, {.distances = true});
  EXPECT_GT(rows.ids.size(), neighborhoods(whole, query).ids.size());
  EXPECT_EQ(counts(index, {.radius = 0.6}), counts(whole, {.radius = 0.6}));
  for (VertexId v = 0; v < mesh.size(); ++v) {
    std::vector<double> row(mesh.size(), kInfinity);
    for (std::size_t i = rows.offsets[v]; i < rows.offsets[v + 1]; ++i) row[rows.ids[i]] = rows.distances[i];
    EXPECT_EQ(row, lengths_from(index, v, 0.6));
  }
  const Curvatures fitted = curvatures(surface.on(index), query);
  EXPECT_NE(fitted.count, curvatures(surface, query).count);
}

/// Pairs of triangles between any vertices, and one between two: a graph unlike a surface, which has other searches.
TEST(SurfacePaths, LeaveOtherMetricsAsTheyAre) {
  Random random(3);
  TestMesh mesh;
  const auto any = [&] { return static_cast<std::uint32_t>(random.below(2000)); };
  const auto along = [&] { return random.uniform(0, 10); };
  for (std::size_t v = 0; v < 2000; ++v) mesh.add_vertex(along(), along(), along());
  for (std::size_t i = 0; i < 1300; ++i) {
    const std::uint32_t a = any();
    const std::uint32_t b = any();
    mesh.add_face({a, b, any()});
    mesh.add_face({b, a, any()});
  }
  mesh.add_face({7, 7, 8});
  const auto [given, whole] = indexed(mesh.finish(false));
  const Index index = surface_paths(Surface(whole, given.view()));
  for (const auto& [metric, radius] : {std::pair(Metric::Straight, 3.0), {Metric::Rings, 2.0}, {Metric::Space, 1.0}}) {
    const BatchQuery query{.radius = radius, .metric = metric};
    EXPECT_EQ(neighborhoods(index, query).ids, neighborhoods(whole, query).ids);
    EXPECT_EQ(Searcher(index, metric).neighborhood(7, radius), Searcher(whole, metric).neighborhood(7, radius));
  }
  const BatchQuery query{.radius = 3, .metric = Metric::Path};
  EXPECT_GT(neighborhoods(index, query).ids.size(), neighborhoods(whole, query).ids.size());
}

TEST(SurfacePaths, RefuseWhatAMaskedIndexRefuses) {
  const TestMesh mesh = ball(6, 9);
  Index whole = build(mesh.view());
  const Surface surface(whole, mesh.view());
  Index index = surface_paths(surface);
  expect_refused(ErrorCode::InvalidOption, "surface paths is not masked again", [&] { return masked(index, {}); });
  expect_refused(ErrorCode::InvalidOption, "surface paths is not refitted",
                 [&] { index.refit_in_place(mesh.positions_view()); });
  whole.refit_in_place(mesh.positions_view());
  expect_refused(ErrorCode::InvalidOption, "refitted in place", [&] { return counts(index, {.radius = 1}); });
  expect_refused(ErrorCode::InvalidOption, "refitted in place", [&] { return surface_paths(surface); });
}

TEST(SurfacePaths, NeedFaces) {
  const TestMesh mesh = ball(6, 9);
  const Surface none = Surface(build(mesh.view()), FacesView());
  expect_refused(ErrorCode::InvalidMesh, "no face", [&] { return surface_paths(none); });
}

}  // namespace
}  // namespace meshhood::test
