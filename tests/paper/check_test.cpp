// SPDX-License-Identifier: MIT
// For each statement of sec. 3.1: `check` finds an index in which it does not hold. I1 to I8: see docs/paper.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "paper/hierarchy.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

using paper::ClusterId;
using paper::Hierarchy;
using paper::Level;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

using Damage = std::function<void(Hierarchy<float>&)>;

TestMesh two_sheets() {
  TestMesh mesh = make_grid(20, 20, false);
  append(mesh, make_grid(10, 10, true));
  return mesh;
}

/// The faults that `check` finds in an index of four levels after `damage`.
std::vector<std::string> faults_after(const Damage& damage) {
  const TestMesh mesh = two_sheets();
  const paper::Index index = paper::build(mesh.view(), {.levels = 4, .discard = 0});
  paper::AnyHierarchy hierarchy = paper::IndexAccess::hierarchy(index);
  damage(std::get<Hierarchy<float>>(hierarchy));
  return paper::IndexAccess::make(std::move(hierarchy)).check(mesh.view());
}

void expect_found(const char* fault, const Damage& damage) {
  const auto faults = faults_after(damage);
  ASSERT_THAT(faults, Not(IsEmpty())) << "not found: " << fault;
  EXPECT_THAT(faults.front(), HasSubstr(fault));
  EXPECT_LE(faults.size(), 16U);
}

void expect_found_on_every_level(const char* fault, const std::function<void(Level<float>&)>& damage) {
  for (std::size_t l = 0; l < 4; ++l) {
    const std::string name = "level " + std::to_string(l);
    expect_found(fault, [&](Hierarchy<float>& h) { damage(h.levels[l]); });
    expect_found(name.c_str(), [&](Hierarchy<float>& h) { damage(h.levels[l]); });
  }
}

TEST(Check, FindsNoFaultInASoundIndex) {
  EXPECT_THAT(faults_after([](Hierarchy<float>&) {}), IsEmpty());
}

TEST(Check, FindsWrongVerticesAndPositions) {
  expect_found("occurs twice", [](Hierarchy<float>& h) {
    h.vertices[3] = h.vertices[4];
    std::copy_n(h.positions.begin() + 12, 3, h.positions.begin() + 9);
  });
  expect_found("vertex 500 is out of range",
               [](Hierarchy<float>& h) { h.vertices[3] = static_cast<VertexId>(h.vertices.size()); });
  expect_found("its position differs from that of the mesh",
               [](Hierarchy<float>& h) { std::swap(h.vertices[0], h.vertices[200]); });
  expect_found("its position differs from that of the mesh", [](Hierarchy<float>& h) { h.positions[7] += 1; });
}

TEST(Check, FindsAnotherMesh) {
  const paper::Index index = paper::build(two_sheets().view());
  const TestMesh other = make_grid(5, 5, false);
  EXPECT_THAT(index.check(other.view()).front(), HasSubstr("500 vertices in the index, but the mesh has 25"));
}

// I1.
TEST(Check, FindsAGapBetweenClustersAndAnEmptyOne) {
  expect_found_on_every_level("do not cover all vertices", [](Level<float>& level) { ++level.first_vertex.front(); });
  expect_found_on_every_level("do not cover all vertices", [](Level<float>& level) { --level.first_vertex.back(); });
  expect_found("no vertices", [](Hierarchy<float>& h) { h.levels[1].first_vertex[2] = h.levels[1].first_vertex[1]; });
}

// I2.
TEST(Check, FindsWrongParentsAndChildren) {
  expect_found("refers to another cluster", [](Hierarchy<float>& h) { h.lowest_cluster.set(h.vertices[0], 3); });
  for (std::size_t l = 0; l < 3; ++l) {
    expect_found("refers to another parent", [&](Hierarchy<float>& h) { h.levels[l].parent[1] ^= 1U; });
  }
  expect_found("its vertices are not those of its children", [](Hierarchy<float>& h) { --h.levels[1].first_child[1]; });
  expect_found("its children are not the clusters of the level below",
               [](Hierarchy<float>& h) { h.levels.erase(h.levels.begin() + 1); });
}

/// The path 0 to 5 with the clusters {0}, {1, 4} and {5, 2, 3}; all else is correct.
/// I3.
TEST(Check, FindsADisconnectedCluster) {
  TestMesh mesh;
  for (std::uint32_t i = 0; i < 6; ++i) {
    mesh.add_vertex(i, 0, 0);
    if (i > 0) mesh.add_face({i - 1, i});
  }
  mesh.finish(true);
  Hierarchy<float> h;
  h.vertices = {0, 1, 4, 5, 2, 3};
  for (const VertexId v : h.vertices) h.positions.insert(h.positions.end(), {static_cast<float>(v), 0, 0});
  h.levels.resize(1);
  Level<float>& level = h.levels.front();
  level.first_vertex = {0, 1, 3, 6};
  level.siblings = {{0, 1, 3, 4}, {1, 0, 2, 1}};
  level.spheres = {{0, 0, 0, 0}, {2.5, 0, 0, 1.5}, {3.5, 0, 0, 1.5}};
  level.mean_radius = 1;
  h.lowest_cluster = paper::PackedIds(6, 3);
  for (const VertexId v : {1U, 4U}) h.lowest_cluster.set(v, 1);
  for (const VertexId v : {2U, 3U, 5U}) h.lowest_cluster.set(v, 2);
  const auto faults = paper::IndexAccess::make(h).check(mesh.view());
  EXPECT_THAT(faults, testing::ElementsAre(HasSubstr("cluster 1: it is not connected"),
                                           HasSubstr("cluster 2: it is not connected")));
}

// I4.
TEST(Check, FindsWrongSpheres) {
  for (std::size_t l = 1; l < 4; ++l) {
    expect_found("lies outside its sphere", [&](Hierarchy<float>& h) {
      float& radius = h.levels[l].spheres.front().radius;
      radius = std::nextafter(radius, 0.0F);
    });
  }
  expect_found("1 vertices, but radius", [](Hierarchy<float>& h) { h.levels[0].spheres[5].radius = 1e-30F; });
  expect_found_on_every_level(
      "radius nan", [](Level<float>& level) { level.spheres[0].radius = std::numeric_limits<float>::quiet_NaN(); });
  expect_found_on_every_level(
      "radius inf", [](Level<float>& level) { level.spheres[0].radius = std::numeric_limits<float>::infinity(); });
  expect_found_on_every_level("radius -1", [](Level<float>& level) { level.spheres[0].radius = -1; });
  expect_found_on_every_level("the number of spheres differs", [](Level<float>& level) { level.spheres.pop_back(); });
}

/// Replaces the siblings of cluster 0 by `row`.
void replace_first_row(Adjacency& siblings, const std::vector<ClusterId>& row) {
  const EdgeOffset old_size = siblings.offsets[1];
  siblings.neighbors.erase(siblings.neighbors.begin(), siblings.neighbors.begin() + old_size);
  siblings.neighbors.insert(siblings.neighbors.begin(), row.begin(), row.end());
  for (std::size_t c = 1; c < siblings.offsets.size(); ++c) {
    siblings.offsets[c] = static_cast<EdgeOffset>(siblings.offsets[c] + row.size() - old_size);
  }
}

std::vector<ClusterId> first_row(const Adjacency& siblings) {
  return {siblings.neighbors.begin(), siblings.neighbors.begin() + siblings.offsets[1]};
}

constexpr const char* kWrongSiblings = "its siblings are not the clusters that an edge of the mesh joins to it";

// I5.
TEST(Check, FindsASiblingInOneDirectionOnlyAnExtraOneAndTheClusterItself) {
  const std::vector<std::function<void(std::vector<ClusterId>&, ClusterId)>> changes = {
      [](std::vector<ClusterId>& row, ClusterId) { row.empty() ? row.push_back(1) : row.pop_back(); },
      [](std::vector<ClusterId>& row, ClusterId last) { row.push_back(last); },
      [](std::vector<ClusterId>& row, ClusterId) { row.insert(row.begin(), 0); },
  };
  for (const auto& change : changes) {
    expect_found_on_every_level(kWrongSiblings, [&](Level<float>& level) {
      std::vector<ClusterId> row = first_row(level.siblings);
      change(row, static_cast<ClusterId>(level.size() - 1));
      replace_first_row(level.siblings, row);
    });
  }
}

// I5.
TEST(Check, FindsSiblingRowsThatAreMissingOrOutOfOrder) {
  expect_found_on_every_level("the number of sibling rows differs", [](Level<float>& level) { level.siblings = {}; });
  expect_found("the sibling rows are not in order", [](Hierarchy<float>& h) {
    std::swap(h.levels[1].siblings.offsets[3], h.levels[1].siblings.offsets[5]);
  });
  expect_found("the sibling rows are not in order",
               [](Hierarchy<float>& h) { h.levels[1].siblings.neighbors.push_back(0); });
}

/// Two components of two vertices each, in one cluster.
/// I6.
TEST(Check, FindsAClusterOfTwoComponents) {
  TestMesh mesh;
  for (std::uint32_t i = 0; i < 4; ++i) mesh.add_vertex(i, 0, 0);
  mesh.add_face({0, 1});
  mesh.add_face({2, 3});
  mesh.finish(true);
  Hierarchy<float> h;
  h.vertices = {0, 1, 2, 3};
  h.positions = mesh.single_positions;
  h.levels.resize(1);
  h.levels[0].first_vertex = {0, 4};
  h.levels[0].siblings = {{0, 0}, {}};
  h.levels[0].spheres = {{1.5, 0, 0, 1.5}};
  h.levels[0].mean_radius = 1.5;
  h.lowest_cluster = paper::PackedIds(4, 1);
  EXPECT_THAT(paper::IndexAccess::make(h).check(mesh.view()), testing::ElementsAre(HasSubstr("not connected")));
}

/// The highest level repeats the one below it.
/// I7.
TEST(Check, FindsALevelThatDoesNotShrink) {
  expect_found("it has a single child although it has siblings", [](Hierarchy<float>& h) {
    h.levels.erase(h.levels.begin() + 2, h.levels.end());
    Level<float> copy = h.levels.back();
    copy.number = 2;
    copy.first_child.clear();
    h.levels.back().parent.clear();
    for (ClusterId c = 0; c <= copy.size(); ++c) {
      copy.first_child.push_back(c);
      if (c < copy.size()) h.levels.back().parent.push_back(c);
    }
    h.levels.push_back(copy);
  });
}

// I8.
TEST(Check, FindsAWrongMeanRadius) {
  expect_found_on_every_level("but the spheres give", [](Level<float>& level) { level.mean_radius += 1e-6; });
  expect_found_on_every_level("but the spheres give", [](Level<float>& level) {
    level.mean_radius = std::numeric_limits<double>::quiet_NaN();
  });
}

TEST(Check, ReportsAtMostSixteenFaults) {
  const auto faults = faults_after([](Hierarchy<float>& h) {
    for (auto& sphere : h.levels[0].spheres) sphere.radius = 1;
  });
  EXPECT_EQ(faults.size(), 16U);
}

}  // namespace
}  // namespace meshhood::test
