// SPDX-License-Identifier: MIT
// Single queries in space, compared with a scan of all vertices.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Ids = std::vector<VertexId>;

/// A mesh with masks, and the vertices in a ball by a scan.
class SpaceCase {
 public:
  SpaceCase(TestMesh mesh, Random& random)
      : mesh_(std::move(mesh)),
        walls_(draw_mask(random, mesh_.size(), 7)),
        ignored_(draw_mask(random, mesh_.size(), 5)),
        index_(masked(build(mesh_.view()), {.walls = walls_, .ignored = ignored_})),
        searcher_(index_, Metric::Space) {}

  /// From a vertex, and from a point of which the seeds do not count.
  void compare(const Start& start, double radius) {
    const Ids expected = ball(start, radius);
    Ids ids;
    std::vector<double> distances;
    searcher_.neighborhood(start, radius, ids, distances);
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(distances[i], distance_to(start, ids[i]));
    std::ranges::sort(ids);
    ASSERT_EQ(ids, expected) << mesh_.name << ", radius " << radius;
    ASSERT_EQ(searcher_.count(start, radius), expected.size());
    ASSERT_TRUE(searcher_.has_seed(start, radius));
    for (VertexId w = 0; w < mesh_.size(); w += 1 + w % 5) {
      const bool is_in = std::ranges::binary_search(expected, w);
      ASSERT_EQ(searcher_.contains(start, w, radius), is_in);
      const bool is_ever_in = std::ranges::binary_search(ball(start, kInfinity), w);
      ASSERT_EQ(searcher_.connecting_radius(start, w), is_ever_in ? distance_to(start, w) : kInfinity);
    }
    std::vector<std::size_t> counts;
    searcher_.nested(start, std::array{radius / 2, radius, radius * 3}, ids, counts);
    for (const auto& [i, of] : {std::pair{0, radius / 2}, std::pair{1, radius}, std::pair{2, radius * 3}}) {
      Ids inner(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(counts[static_cast<std::size_t>(i)]));
      std::ranges::sort(inner);
      ASSERT_EQ(inner, ball(start, of));
    }
    compare_stroke(start, radius);
  }

  [[nodiscard]] SpacePoint position(VertexId v) const {
    return {mesh_.positions[3 * std::size_t{v}], mesh_.positions[3 * std::size_t{v} + 1],
            mesh_.positions[3 * std::size_t{v} + 2]};
  }

 private:
  void compare_stroke(const Start& start, double radius) {
    Ids both = ball(start, radius);
    const Ids second = ball(0, 2 * radius);
    both.insert(both.end(), second.begin(), second.end());
    std::ranges::sort(both);
    both.erase(std::ranges::unique(both).begin(), both.end());
    Ids ids;
    searcher_.stroke(std::array{Dab{start, radius}, Dab{0, 2 * radius}}, ids);
    std::ranges::sort(ids);
    ASSERT_EQ(ids, both);
  }

  [[nodiscard]] double distance_to(const Start& start, VertexId w) const {
    const SpacePoint center = start.center() ? *start.center() : position(start.vertex());
    const SpacePoint p = position(w);
    const double x = p[0] - center[0];
    const double y = p[1] - center[1];
    const double z = p[2] - center[2];
    return std::sqrt((x * x + y * y) + z * z);
  }

  [[nodiscard]] Ids ball(const Start& start, double radius) const {
    Ids ids;
    if (!start.center() && walls_[start.vertex()] != 0) return ids;
    for (VertexId w = 0; w < mesh_.size(); ++w) {
      if (walls_[w] == 0 && ignored_[w] == 0 && distance_to(start, w) <= radius) ids.push_back(w);
    }
    return ids;
  }

  TestMesh mesh_;
  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
  Index index_;
  Searcher searcher_;
};

class SpaceIn : public testing::TestWithParam<Family> {};

TEST_P(SpaceIn, EveryCallEqualsAScan) {
  Random random(4);
  for (const std::size_t vertices : {std::size_t{30}, scaled(900, 300)}) {
    const TestMesh mesh = make_mesh(GetParam(), 6, vertices);
    if (mesh.size() == 0) continue;
    SpaceCase scene(mesh, random);
    const auto any = [&] { return static_cast<VertexId>(random.below(mesh.size())); };
    for (int i = 0; i < 12; ++i) {
      const double radius = distance(mesh.positions_view(), any(), any()) / (1 + i % 3) + 1e-3;
      scene.compare(any(), radius);
      const SpacePoint p = scene.position(any());
      const SpacePoint q = scene.position(any());
      const Ids seeds(random.below(2), any());
      scene.compare({{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 3}, seeds}, radius);
    }
  }
}

TEST(Space, AroundAPointOfAMeshWithoutVerticesIsEmpty) {
  const Index index = build(TestMesh{}.view());
  EXPECT_EQ(Searcher(index, Metric::Space).count({{0, 0, 0}, {}}, kInfinity), 0U);
}

INSTANTIATE_TEST_SUITE_P(All, SpaceIn, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
