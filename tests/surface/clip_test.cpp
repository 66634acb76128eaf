// SPDX-License-Identifier: MIT
// The part of a surface inside a ball, against passes over all faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/surface.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"
#include "surface/submesh.h"

namespace meshhood::test {
namespace {

using CornerEdge = std::array<VertexId, 2>;

/// The corners of the parts of a face: walks once around it from a corner that is not in the region.
std::multiset<std::vector<CornerEdge>> parts_of(std::span<const std::uint32_t> face, const std::set<VertexId>& region) {
  std::multiset<std::vector<CornerEdge>> parts;
  const std::size_t size = face.size();
  std::size_t outside = 0;
  while (outside < size && region.contains(face[outside])) ++outside;
  std::vector<CornerEdge> part;
  if (outside == size) {
    for (const VertexId v : face) part.push_back({v, v});
    return {part};
  }
  for (std::size_t i = 1; i <= size; ++i) {
    const VertexId before = face[(outside + i - 1) % size];
    const VertexId v = face[(outside + i) % size];
    if (region.contains(v)) {
      if (part.empty()) part.push_back({v, before});
      part.push_back({v, v});
    } else if (!part.empty()) {
      part.push_back({before, v});
      parts.insert(part);
      part.clear();
    }
  }
  return parts;
}

double distance_from(const SpacePoint& p, const std::array<double, 3>& center) {
  return std::sqrt(squared_distance({p[0], p[1], p[2]}, {center[0], center[1], center[2]}));
}

class Clipped : public testing::TestWithParam<Family> {};

TEST_P(Clipped, HasThePartsOfAllFaces) {
  std::size_t polygons = 0;
  for (const std::size_t vertices : {2U, 9U, 60U, 300U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices + 1, vertices);
    if (mesh.size() == 0) continue;
    const RegionOracle oracle(mesh);
    const Surface surface(build(mesh.view()), mesh.view());
    Random random(vertices);
    for (std::size_t i = 0; i < scaled(10, 3); ++i) {
      PlainStart start = draw_start(random, mesh).plain;
      start.ignored.assign(mesh.size(), 0);
      const double radius = oracle.distance(start, random.below(mesh.size()));
      const std::vector<VertexId> ids = oracle.region(start, radius);
      const std::set<VertexId> region(ids.begin(), ids.end());
      const ClippedMesh clipped = surface.clip(ids, start.center, radius);
      ASSERT_EQ(clipped.points.size(), clipped.edges.size());
      ASSERT_TRUE(std::is_sorted(clipped.faces.begin(), clipped.faces.end()));
      std::map<std::size_t, std::multiset<std::vector<CornerEdge>>> found;
      for (std::size_t p = 0; p < clipped.faces.size(); ++p, ++polygons) {
        std::vector<CornerEdge> part;
        for (std::size_t c = clipped.offsets[p]; c < clipped.offsets[p + 1]; ++c) {
          part.push_back(clipped.edges[clipped.corners[c]]);
        }
        found[clipped.faces[p]].insert(part);
      }
      for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        const auto expected = face.size() < 3 ? std::multiset<std::vector<CornerEdge>>{} : parts_of(face, region);
        ASSERT_EQ(found[f], expected) << mesh.name << ", face " << f;
      }
      for (std::size_t p = 0; p < clipped.points.size(); ++p) {
        const auto [inner, outer] = clipped.edges[p];
        const SpacePoint at{mesh.positions[3 * inner], mesh.positions[3 * inner + 1], mesh.positions[3 * inner + 2]};
        if (inner == outer) {
          ASSERT_EQ(clipped.points[p], at);
        } else if (radius > 1e-150) {  // below, squares underflow
          const double scale = std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2]), radius});
          ASSERT_LE(distance_from(clipped.points[p], start.center), radius + 1e-6 * scale);
        }
      }
    }
  }
  std::printf("%s: %zu polygons\n", std::string(GetParam().name).c_str(), polygons);
}

INSTANTIATE_TEST_SUITE_P(All, Clipped, testing::ValuesIn(families()), family_name);

TEST(Clip, OfABallOnAPlaneHasTheAreaInsideItsRim) {
  for (const bool quads : {false, true}) {
    const TestMesh mesh = make_grid(41, 41, quads);
    const RegionOracle oracle(mesh);
    const std::vector<std::uint8_t> none(mesh.size());
    const PlainStart start{{20.2, 19.7, 0}, {20 * 41 + 20}, none, none};
    const Surface surface(build(mesh.view()), mesh.view());
    const std::vector<VertexId> ids = oracle.region(start, 13.3);
    const ClippedMesh clipped = surface.clip(ids, start.center, 13.3);
    const Rim rim = surface.rim(ids, start.center, 13.3);
    ASSERT_THAT(rim.closed, testing::ElementsAre(1));
    double inside_rim = 0;
    for (std::size_t i = 0; i < rim.points.size(); ++i) {
      const SpacePoint& p = rim.points[i];
      const SpacePoint& q = rim.points[(i + 1) % rim.points.size()];
      inside_rim += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
    EXPECT_NEAR(clipped.area, std::abs(inside_rim), 1e-9);
    const double disc = 3.14159265358979 * 13.3 * 13.3;
    EXPECT_NEAR(clipped.area, disc, 0.01 * disc);
    EXPECT_LT(clipped.area, disc);
    // Faces with all corners inside have much less.
    const std::vector<double> areas = vertex_areas(mesh.view());
    const std::size_t whole = surface.faces(ids).size();
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    EXPECT_LT(static_cast<double>(whole) * total / static_cast<double>(mesh.face_count()), 0.95 * disc);
  }
}

TEST(Clip, EndsAtAWallInsideTheBall) {
  TestMesh strip;
  strip.add_vertex(0, 0, 0);
  strip.add_vertex(1, 0, 0);
  strip.add_vertex(0, 1, 0);
  strip.add_face({0, 1, 2});
  const TestMesh whole = strip.finish(true);
  const Surface surface(build(whole.view()), whole.view());
  const ClippedMesh clipped = surface.clip(std::array<VertexId, 2>{0, 2}, {0, 0, 0}, 5);
  EXPECT_EQ(clipped.area, 0.5);
  EXPECT_EQ(clipped.points.back(), (SpacePoint{1, 0, 0}));
}

TEST(Clip, RefusesWhatIsNotARegionOfTheBall) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Surface surface(build(mesh.view()), mesh.view());
  const std::array<VertexId, 1> far{8};
  expect_refused(ErrorCode::InvalidOption, "vertex 8 is not within the radius 1",
                 [&] { static_cast<void>(surface.clip(far, {0, 0, 0}, 1)); });
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { static_cast<void>(surface.clip(far, {0, 0, 0}, -1)); });
  expect_refused(ErrorCode::InvalidOption, "center: coordinate 0 is inf",
                 [&] { static_cast<void>(surface.clip(far, {kInfinity, 0, 0}, 1)); });
  expect_refused(ErrorCode::VertexOutOfRange, "ids: position 0: vertex 9",
                 [&] { static_cast<void>(surface.clip(std::array<VertexId, 1>{9}, {0, 0, 0}, 1)); });
}

}  // namespace
}  // namespace meshhood::test
