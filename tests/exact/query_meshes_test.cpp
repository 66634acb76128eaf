// SPDX-License-Identifier: MIT
// Regions, strokes, nested radii, connecting radii, path distances, rings, nearest vertices and cut edges on all real
// meshes, against the plain searches of the oracle.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/search.h"

#include "support/draw_start.h"
#include "support/each_shared_mesh.h"
#include "support/region_oracle.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

/// A vertex, or a point on a face with its corners as seeds; without masks, or with some.
DrawnStart draw_start_on_surface(Random& random, const TestMesh& mesh) {
  DrawnStart drawn;
  drawn.has_masks = random.below(2) == 0;
  drawn.plain.walls = draw_mask(random, mesh.size(), drawn.has_masks ? 12 : 0);
  drawn.plain.ignored = draw_mask(random, mesh.size(), drawn.has_masks ? 3 : 0);
  drawn.is_vertex = mesh.face_count() == 0 || random.below(2) == 0;
  if (drawn.is_vertex) {
    drawn.plain.seeds = {static_cast<VertexId>(random.below(mesh.size()))};
    drawn.plain.center = position(mesh, drawn.plain.seeds[0]);
    return drawn;
  }
  const auto corners = mesh.face(random.below(mesh.face_count()));
  drawn.plain.seeds.assign(corners.begin(), corners.end());
  double sum = 0;
  for (const VertexId v : corners) {
    const double weight = random.uniform(0.1, 1);
    const auto corner = position(mesh, v);
    for (std::size_t axis = 0; axis < 3; ++axis) drawn.plain.center[axis] += weight * corner[axis];
    sum += weight;
  }
  for (double& x : drawn.plain.center) x = sum == 0 ? 0 : x / sum;
  return drawn;
}

std::vector<VertexId> finite(const std::vector<double>& values, const std::vector<std::uint8_t>& without) {
  std::vector<VertexId> ids;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (values[v] < kInfinity && without[v] == 0) ids.push_back(static_cast<VertexId>(v));
  }
  return ids;
}

/// A mesh with its index, its searchers and the oracle.
class Comparison {
 public:
  explicit Comparison(const TestMesh& mesh)
      : mesh_(mesh), index_(build(mesh.view())), oracle_(mesh), mean_edge_(oracle_.graph().mean_edge()) {}

  void expect_same_regions() {
    const DrawnStart drawn = draw_start_on_surface(random_, mesh_);
    const Start start = drawn.start();
    const Index searched = drawn.on(index_);
    Searcher regions(searched);
    const std::vector<double> radii = draw_radii(drawn.plain);
    std::vector<VertexId> ids;
    std::vector<VertexId> nested;
    std::vector<std::size_t> counts;
    regions.nested(start, radii, nested, counts);
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const std::vector<VertexId> expected = oracle_.region(drawn.plain, radii[i]);
      regions.neighborhood(start, radii[i], ids);
      ASSERT_EQ(sorted(ids), expected) << "radius " << radii[i];
      ASSERT_LE(counts[i], nested.size());
      ASSERT_EQ(sorted({nested.begin(), nested.begin() + static_cast<std::ptrdiff_t>(counts[i])}), expected)
          << "radius " << radii[i];
    }
  }

  void expect_same_strokes() {
    std::array<DrawnStart, 3> drawn;
    std::vector<Dab> dabs;
    std::vector<VertexId> expected;
    for (DrawnStart& one : drawn) {
      one = draw_start_on_surface(random_, mesh_);
      one.plain.walls = drawn.front().plain.walls;
      one.plain.ignored = drawn.front().plain.ignored;
      dabs.push_back({one.start(), 4 * mean_edge_});
      const std::vector<VertexId> part = oracle_.region(one.plain, dabs.back().radius);
      expected.insert(expected.end(), part.begin(), part.end());
    }
    expected = sorted(expected);
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    std::vector<VertexId> ids;
    const Index searched = masked(index_, {.walls = drawn.front().plain.walls, .ignored = drawn.front().plain.ignored});
    Searcher(searched).stroke(dabs, ids);
    ASSERT_EQ(sorted(ids), expected);
  }

  void expect_same_connections() {
    const DrawnStart drawn = draw_start_on_surface(random_, mesh_);
    const Start start = drawn.start();
    const Index searched = drawn.on(index_);
    Searcher regions(searched);
    const double limit = 9 * mean_edge_;
    const std::vector<double> radii = oracle_.connecting_radii(drawn.plain, limit);
    std::vector<VertexId> near = oracle_.in_order(drawn.plain, radii);
    for (int i = 0; i < 5 && !near.empty(); ++i) {
      const VertexId w = near[random_.below(near.size())];
      ASSERT_EQ(regions.connecting_radius(start, w), radii[w]) << "vertex " << w;
      ASSERT_TRUE(regions.contains(start, w, radii[w])) << "vertex " << w;
      if (radii[w] == 0) continue;
      ASSERT_FALSE(regions.contains(start, w, std::nextafter(radii[w], 0))) << "vertex " << w;
    }
    const auto any = static_cast<VertexId>(random_.below(mesh_.size()));
    ASSERT_EQ(regions.contains(start, any, limit), radii[any] < kInfinity) << "vertex " << any;
    near.resize(random_.below(near.size() + 1));
    std::vector<VertexId> ids;
    std::vector<double> found;
    regions.nearest_connected(start, near.size(), ids, found);
    ASSERT_EQ(ids, near);
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(found[i], radii[ids[i]]) << "vertex " << ids[i];
  }

  void expect_same_paths() {
    DrawnStart drawn = draw_start_on_surface(random_, mesh_);
    drawn.plain.seeds = {static_cast<VertexId>(random_.below(mesh_.size()))};
    const VertexId v = drawn.plain.seeds[0];
    drawn.plain.center = position(mesh_, v);
    const double limit = 14 * mean_edge_;
    const std::vector<double> least =
        oracle_.path_lengths(drawn.plain, limit, [&](auto a, auto b) { return oracle_.graph().distance(a, b); });
    std::vector<VertexId> ids;
    std::vector<double> lengths;
    const Index searched = drawn.on(index_);
    Searcher edges(searched, Metric::Path);
    edges.neighborhood(v, limit, ids, lengths);
    ASSERT_EQ(sorted(ids), finite(least, drawn.plain.ignored));
    ASSERT_TRUE(std::is_sorted(lengths.begin(), lengths.end()));
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(lengths[i], least[ids[i]]) << "vertex " << ids[i];

    constexpr std::size_t kRings = 8;
    const auto hops = oracle_.path_lengths(drawn.plain, kRings, [](auto, auto) { return 1.0; });
    Searcher(searched, Metric::Rings).neighborhood(v, kRings, ids, lengths);
    ASSERT_EQ(sorted(ids), finite(hops, drawn.plain.ignored));
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(hops[ids[i]], lengths[i]) << "vertex " << ids[i];
  }

  void expect_same_nearest() {
    PlainStart start = draw_start(random_, mesh_).plain;
    for (double& x : start.center) x += mean_edge_ * random_.uniform(-3, 3);
    VertexId expected = 0;
    for (VertexId v = 1; v < mesh_.size(); ++v) {
      if (oracle_.distance(start, v) < oracle_.distance(start, expected)) expected = v;
    }
    const NearestVertex found = nearest(index_, start.center);
    ASSERT_EQ(found.vertex, expected);
    ASSERT_EQ(found.distance, oracle_.distance(start, expected));
  }

  /// The oracle searches a mesh that has the other edges as faces of two corners.
  void expect_same_regions_after_cuts() {
    const Adjacency graph = adjacency(mesh_.view());
    TestMesh rest = mesh_;
    rest.corners.clear();
    rest.offsets = {0};
    std::vector<VertexId> cut;
    for (VertexId v = 0; v < mesh_.size(); ++v) {
      for (const VertexId w : graph.view()[v]) {
        if (v > w) continue;
        if (random_.below(4) == 0) {
          cut.insert(cut.end(), {w, v});
        } else {
          rest.add_face({v, w});
        }
      }
    }
    const Adjacency kept = cut_edges(graph.view(), cut);
    const Index index = build(GraphView{mesh_.positions_view(), kept.view()});
    const RegionOracle oracle(rest);
    std::vector<VertexId> ids;
    for (int i = 0; i < 10; ++i) {
      const DrawnStart drawn = draw_start_on_surface(random_, mesh_);
      const double radius = 8 * mean_edge_;
      const Index searched = drawn.on(index);
      Searcher(searched).neighborhood(drawn.start(), radius, ids);
      ASSERT_EQ(sorted(ids), oracle.region(drawn.plain, radius));
    }
  }

 private:
  /// Ascending: some small ones, and the distance of a vertex near the largest with the numbers next to it.
  std::vector<double> draw_radii(const PlainStart& start) {
    std::vector<double> radii{0, 0.7 * mean_edge_, 3 * mean_edge_, 9 * mean_edge_};
    const std::vector<VertexId> ids = oracle_.region(start, radii.back());
    if (!ids.empty()) {
      const double tie = oracle_.distance(start, ids[random_.below(ids.size())]);
      radii.insert(radii.end(), {std::nextafter(tie, 0), tie, std::nextafter(tie, kInfinity)});
    }
    std::sort(radii.begin(), radii.end());
    radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
    return radii;
  }

  const TestMesh& mesh_;
  Index index_;
  RegionOracle oracle_;
  double mean_edge_;
  Random random_{17};
};

class QueryMeshes : public testing::TestWithParam<const char*> {};

TEST_P(QueryMeshes, AnswersAreThoseOfPlainSearches) {
  MESHHOOD_NEED_SHARED_MESHES();
  std::size_t rounds = 0;
  const std::size_t meshes = for_each_shared_mesh(GetParam(), [&](const TestMesh& mesh) {
    Comparison comparison(mesh);
    const std::size_t most = std::clamp<std::size_t>(1'000'000 / mesh.size(), 5, 60);
    for (std::size_t i = 0; i < scaled(most, 2) && !HasFailure(); ++i, ++rounds) {
      comparison.expect_same_regions();
      comparison.expect_same_strokes();
      comparison.expect_same_connections();
      comparison.expect_same_paths();
      comparison.expect_same_nearest();
    }
    comparison.expect_same_regions_after_cuts();
  });
  std::printf("%s: %zu meshes, %zu rounds\n", GetParam(), meshes, rounds);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Folders, QueryMeshes, shared_folders(), shared_folder_case);

}  // namespace
}  // namespace meshhood::test
