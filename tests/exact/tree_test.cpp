// SPDX-License-Identifier: MIT
#include "exact/build/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/sphere.h"
#include "base/vector.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

Point random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Leaves of three random vertices each.
struct RandomLeaves {
  RandomLeaves(Random& random, std::size_t leaves) : spheres(leaves), leaf_begin(leaves + 1) {
    for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
      leaf_begin[leaf] = static_cast<VertexId>(points.size());
      const Point at = random_point(random, 0.9);
      for (int i = 0; i < 3; ++i) points.push_back(at + random_point(random, 0.05));
      spheres[leaf] = enclosing_sphere(std::span(points).last(3));
    }
    leaf_begin[leaves] = static_cast<VertexId>(points.size());
    group_leaves(leaves);
  }

  /// Full groups of eight on all levels. The places that no leaf takes have no vertices.
  void group_leaves(std::size_t leaves) {
    levels = {0};
    for (std::size_t count = leaves; count > 0; count = count > kFanOut ? (count + kFanOut - 1) / kFanOut : 0) {
      const auto first_below = levels.size() > 1 ? levels[levels.size() - 2] : 0;
      const auto first = static_cast<std::uint32_t>(records.size());
      for (std::size_t node = 0; node < count; node += kFanOut) {
        GroupRecord record;
        record.first_child = levels.size() == 1 ? 0 : first_below + static_cast<std::uint32_t>(node);
        record.nodes = static_cast<std::uint32_t>(std::min<std::size_t>(kFanOut, count - node));
        records.push_back(record);
      }
      parents.resize(records.size(), kNoNode);
      for (std::size_t node = 0; levels.size() > 1 && node < count; ++node) {
        parents[first_below + node] = static_cast<NodeId>(first * kFanOut + node);
      }
      levels.push_back(static_cast<std::uint32_t>(records.size()));
    }
    const std::size_t places = leaves == 0 ? 0 : levels[1] * kFanOut;
    leaf_begin.resize(places + 1, leaf_begin.back());
    spheres.resize(places);
    set_vertices(leaf_begin, levels, records);
  }

  [[nodiscard]] TreeArrays tree(unsigned threads = 1) const {
    const Progress silent;
    TaskContext task(threads, silent, 0);
    return make_tree(spheres, view(), task);
  }

  [[nodiscard]] IndexView view() const {
    IndexView index;
    index.leaf_begin = leaf_begin;
    index.levels = levels;
    index.records = records;
    index.parents = parents;
    if (!points.empty()) index.positions = std::span(&points.data()->x, 3 * points.size());
    return index;
  }

  Spheres spheres;
  std::vector<VertexId> leaf_begin;
  std::vector<Point> points;
  std::vector<std::uint32_t> levels;
  std::vector<GroupRecord> records;
  std::vector<NodeId> parents;
};

Point center(const Group& group, std::size_t i) {
  return {static_cast<double>(group.x[i]), static_cast<double>(group.y[i]), static_cast<double>(group.z[i])};
}

/// Calls `f(level, group, i)` for the node above a leaf on every level, the leaf itself first.
template <class F>
void for_each_node_above(const RandomLeaves& leaves, const TreeArrays& tree, std::size_t leaf, F&& f) {
  std::size_t level = 0;
  for (auto node = static_cast<NodeId>(leaf); node != kNoNode; node = leaves.parents[node / kFanOut], ++level) {
    f(level, tree.groups[node / kFanOut], node % kFanOut);
  }
}

constexpr std::array<std::size_t, 8> kSizes = {1, 2, 7, 8, 9, 64, 65, 600};

TEST(Tree, SpheresEncloseTheVerticesBelowWithRoomForSinglePrecision) {
  Random random(1);
  std::size_t tests = 0;
  for (const std::size_t size : kSizes) {
    const RandomLeaves leaves(random, size);
    const TreeArrays arrays = leaves.tree();
    for (std::size_t leaf = 0; leaf < size; ++leaf) {
      for (std::size_t v = leaves.leaf_begin[leaf]; v < leaves.leaf_begin[leaf + 1]; ++v) {
        for_each_node_above(leaves, arrays, leaf, [&](std::size_t level, const Group& group, std::size_t i) {
          const double distance = length(leaves.points[v] - center(group, i));
          ASSERT_GT(static_cast<double>(group.radius[i]), distance * (1 + 0x1p-20) + 0x1p-22 - 1e-15) << level;
          ++tests;
        });
      }
    }
  }
  std::printf("%zu vertices in spheres\n", tests);
}

TEST(Tree, SpheresReachNoFartherThanTheirFarthestVertexNeeds) {
  Random random(8);
  for (const std::size_t size : kSizes) {
    const RandomLeaves leaves(random, size);
    const TreeArrays arrays = leaves.tree();
    std::vector<double> farthest(arrays.groups.size() * kFanOut, 0);
    const auto place = [&](const Group& group, std::size_t i) {
      return static_cast<std::size_t>(&group - arrays.groups.data()) * kFanOut + i;
    };
    for (std::size_t leaf = 0; leaf < size; ++leaf) {
      for (std::size_t v = leaves.leaf_begin[leaf]; v < leaves.leaf_begin[leaf + 1]; ++v) {
        for_each_node_above(leaves, arrays, leaf, [&](std::size_t, const Group& group, std::size_t i) {
          double& largest = farthest[place(group, i)];
          largest = std::max(largest, length(leaves.points[v] - center(group, i)));
        });
      }
    }
    for (std::size_t leaf = 0; leaf < size; ++leaf) {
      for_each_node_above(leaves, arrays, leaf, [&](std::size_t level, const Group& group, std::size_t i) {
        EXPECT_LT(static_cast<double>(group.radius[i]), farthest[place(group, i)] * (1 + 0x1p-19) + 0x1p-21) << level;
      });
    }
  }
}

TEST(Tree, AfterAnUpdateOfSomeLeavesIsTheTreeOfAllLeaves) {
  Random random(9);
  for (const std::size_t size : kSizes) {
    RandomLeaves leaves(random, size);
    TreeArrays updated = leaves.tree();
    std::vector<LeafId> moved;
    for (std::size_t leaf = random.below(3); leaf < size; leaf += 1 + random.below(20)) {
      moved.push_back(static_cast<LeafId>(leaf));
      for (std::size_t v = leaves.leaf_begin[leaf]; v < leaves.leaf_begin[leaf + 1]; ++v) {
        leaves.points[v] = 0.9 * leaves.points[v] + random_point(random, 0.05);
      }
      const auto own = std::span(leaves.points).subspan(leaves.leaf_begin[leaf], 3);
      leaves.spheres[leaf] = enclosing_sphere(own);
    }
    Spheres spheres;
    for (const LeafId leaf : moved) spheres.push_back(leaves.spheres[leaf]);
    update_tree(moved, spheres, leaves.view(), updated.groups, updated.mean_radii);

    const TreeArrays expected = leaves.tree();
    EXPECT_EQ(updated.mean_radii, expected.mean_radii);
    for (std::size_t i = 0; i < expected.groups.size(); ++i) {
      EXPECT_EQ(updated.groups[i].x, expected.groups[i].x);
      EXPECT_EQ(updated.groups[i].radius, expected.groups[i].radius);
    }
  }
}

TEST(Tree, GroupsAboveSomeLeavesAreThoseThatAnUpdateChanges) {
  Random random(10);
  const RandomLeaves leaves(random, 600);
  const std::vector<LeafId> moved{3, 5, 8, 599};
  EXPECT_THAT(groups_above(moved, leaves.view()), testing::ElementsAre(0, 1, 74, 75, 84, 85, 86, 87));
}

TEST(Tree, NodesThatDoNotExistAreAbsentAndNoOthers) {
  Random random(3);
  for (const std::size_t size : kSizes) {
    const RandomLeaves leaves(random, size);
    const TreeArrays arrays = leaves.tree();
    for (std::size_t group = 0; group < arrays.groups.size(); ++group) {
      for (std::size_t i = 0; i < kFanOut; ++i) {
        EXPECT_EQ(is_absent(arrays.groups[group], i), i >= leaves.records[group].nodes);
      }
    }
  }
}

TEST(Tree, MeanRadiiAreThoseOfTheNodesOfTheirLevel) {
  Random random(4);
  const RandomLeaves leaves(random, 600);
  const TreeArrays arrays = leaves.tree();
  const Tree tree = make_levels(leaves.levels, leaves.records, arrays.mean_radii);
  ASSERT_EQ(tree.size(), 4U);
  for (const TreeLevel& level : tree) {
    double sum = 0;
    for (std::size_t node = 0; node < level.nodes; ++node) {
      sum += static_cast<double>(arrays.groups[level.first_group + node / kFanOut].radius[node % kFanOut]);
    }
    EXPECT_DOUBLE_EQ(level.mean_radius, sum / static_cast<double>(level.nodes));
    EXPECT_EQ(mean_radius(std::span(arrays.groups).subspan(level.first_group, level.groups),
                          std::span(leaves.records).subspan(level.first_group, level.groups)),
              level.mean_radius);
  }
}

TEST(Tree, RunsOfANodeAreThoseOfItsLeaves) {
  Random random(11);
  const RandomLeaves leaves(random, 600);
  for (std::size_t leaf = 0; leaf < 600; ++leaf) {
    for (auto node = static_cast<NodeId>(leaf); node != kNoNode; node = leaves.parents[node / kFanOut]) {
      const GroupRecord& record = leaves.records[node / kFanOut];
      EXPECT_LE(record.begin[node % kFanOut], leaves.leaf_begin[leaf]);
      EXPECT_GE(record.begin[node % kFanOut + 1], leaves.leaf_begin[leaf + 1]);
    }
  }
  EXPECT_EQ(leaves.records.back().begin.back(), leaves.points.size());
}

TEST(Tree, OfNoLeafHasNoLevel) {
  Random random(5);
  const TreeArrays arrays = RandomLeaves(random, 0).tree();
  EXPECT_TRUE(arrays.groups.empty());
  EXPECT_TRUE(arrays.mean_radii.empty());
}

TEST(Tree, IsTheSameForAnyNumberOfThreads) {
  Random random(6);
  const RandomLeaves leaves(random, 3000);
  const TreeArrays expected = leaves.tree();
  const TreeArrays tree = leaves.tree(4);
  EXPECT_EQ(tree.mean_radii, expected.mean_radii);
  ASSERT_EQ(tree.groups.size(), expected.groups.size());
  for (std::size_t i = 0; i < tree.groups.size(); ++i) {
    EXPECT_EQ(tree.groups[i].radius, expected.groups[i].radius);
  }
}

TEST(EnclosingSphere, IsHardlyLargerThanTheSmallest) {
  Random random(7);
  for (std::size_t i = 0; i < scaled(2000, 100); ++i) {
    std::vector<Point> points;
    std::vector<double> xyz;
    for (std::size_t k = 0; k <= i % 32; ++k) {
      points.push_back(random_point(random, 0.5));
      xyz.insert(xyz.end(), {points.back().x, points.back().y, points.back().z});
    }
    const double smallest = bounding_sphere(std::span<const double>(xyz)).radius;
    const auto radius = static_cast<double>(enclosing_sphere(points).radius);
    // The smallest sphere is itself found to within a thousandth.
    ASSERT_LE(radius, smallest * 1.002 + 1e-6);
    ASSERT_GE(radius, smallest * 0.999);
  }
}

TEST(EnclosingSphere, HasTheGivenCenter) {
  const std::vector<Point> points{{0.5, 0, 0}, {0, 0.25, 0}};
  const FrameSphere sphere = enclosing_sphere(points, {0, 0, 0});
  EXPECT_EQ(sphere.x, 0);
  EXPECT_GT(sphere.radius, 0.5F);
  EXPECT_LT(sphere.radius, 0.500002F);
}

}  // namespace
}  // namespace meshhood::test
