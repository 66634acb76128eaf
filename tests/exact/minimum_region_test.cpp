// SPDX-License-Identifier: MIT
// Regions compared with brute force. The set of points from which a vertex is a local minimum of the distance is its
// Voronoi cell among its neighbors: a polyhedron whose corners are found here from all triples of bisector planes.
#include "exact/build/minimum_region.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/vector.h"
#include "exact/layout.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

// The tree adds as much to the offset of every region, for rounding.
constexpr double kRoom = 0x1p-20;

// Farther than any two points of the frame.
constexpr double kFarthest = 4;

struct Patch {
  std::vector<Point> points;
  std::size_t first = 0;
  std::size_t size = 0;
  std::vector<LeafEdge> edges;
  Point center{};

  [[nodiscard]] const Point& vertex(std::size_t lane) const { return points[first + lane]; }

  [[nodiscard]] std::vector<Point> neighbors(std::size_t lane) const {
    std::vector<Point> result;
    for (const LeafEdge& edge : edges) {
      if (edge.lane == lane) result.push_back(points[edge.neighbor]);
    }
    return result;
  }

  [[nodiscard]] MinimumRegion region() const { return leaf_minimum_region(points, first, size, {}, edges, center); }
};

bool is_bounded(const MinimumRegion& region) { return std::isfinite(region.offset); }

bool contains(const MinimumRegion& region, const Point& x) {
  return length(x) <= region.offset + kRoom + std::abs(dot(x, region.slope_axis));
}

bool is_minimum(const Point& vertex, const std::vector<Point>& neighbors, const Point& query) {
  return std::all_of(neighbors.begin(), neighbors.end(),
                     [&](const Point& w) { return squared_distance(vertex, query) <= squared_distance(w, query); });
}

Point random_direction(Random& random) {
  for (;;) {
    const Point p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double norm = length(p);
    if (norm > 0.01 && norm < 1) return 1 / norm * p;
  }
}

/// The corners of a vertex's Voronoi cell, relative to the vertex and moved slightly inwards.
std::vector<Point> cell_corners(const std::vector<Point>& edges) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (std::size_t m = 0; m < k; ++m) {
        const Point &a = edges[i], &b = edges[k], &c = edges[m];
        const double determinant = dot(a, cross(b, c));
        if (determinant == 0) continue;
        const Point corner =
            0.5 / determinant * (dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b));
        result.push_back((1 - 1e-9) * corner);
      }
    }
  }
  return result;
}

/// Directions of the edges of a vertex's Voronoi cell, and of some more points.
std::vector<Point> cell_directions(const std::vector<Point>& edges, Random& random) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Point across = cross(edges[i], edges[k]);
      if (!(length(across) > 0)) continue;
      result.push_back(1 / length(across) * across);
      result.push_back(-1 / length(across) * across);
    }
  }
  for (int i = 0; i < 10; ++i) result.push_back(random_direction(random));
  return result;
}

/// The number of points in the cells of the vertices that were tested against the region.
std::size_t expect_cells_inside(const Patch& patch, const MinimumRegion& region, Random& random) {
  std::size_t found = 0;
  for (std::size_t lane = 0; lane < patch.size; ++lane) {
    const std::vector<Point> neighbors = patch.neighbors(lane);
    std::vector<Point> edges;
    for (const Point& w : neighbors) edges.push_back(w - patch.vertex(lane));
    const auto expect_inside = [&](const Point& offset) {
      const Point query = patch.vertex(lane) + offset;
      const Point x = query - patch.center;
      if (!(length(x) < kFarthest) || !is_minimum(patch.vertex(lane), neighbors, query)) return;
      ++found;
      EXPECT_TRUE(contains(region, x)) << "vertex " << lane << " is a local minimum seen from " << x.x << ' ' << x.y
                                       << ' ' << x.z << ", at " << length(x);
    };
    std::vector<Point> corners = cell_corners(edges);
    corners.push_back({0, 0, 0});
    for (const Point& corner : corners) expect_inside(corner);
    for (const Point& direction : cell_directions(edges, random)) {
      const Point& start = corners[random.below(corners.size())];
      for (const double far : {0.01, 0.1, 1.0, 3.0}) expect_inside(start + far * direction);
    }
  }
  return found;
}

/// The point of the region's surface in a direction, if the surface is reached before `kFarthest`.
double surface(const MinimumRegion& region, const Point& direction) {
  const double rest = 1 - std::abs(dot(direction, region.slope_axis));
  return rest > 0 ? std::min(region.offset / rest, kFarthest) : kFarthest;
}

/// The number of vertices that were tested from points just outside the region.
std::size_t expect_no_minima_outside(const Patch& patch, const MinimumRegion& region, Random& random) {
  std::size_t seen = 0;
  for (int i = 0; i < 100; ++i) {
    const Point direction = random_direction(random);
    const Point x = (surface(region, direction) * (1 + 1e-4) + 4 * kRoom) * direction;
    if (contains(region, x)) continue;
    for (std::size_t lane = 0; lane < patch.size; ++lane, ++seen) {
      EXPECT_FALSE(is_minimum(patch.vertex(lane), patch.neighbors(lane), patch.center + x)) << "vertex " << lane;
    }
  }
  return seen;
}

/// A rotation, then a scaling.
struct Pose {
  Point x{1, 0, 0};
  Point y{0, 1, 0};
  Point z{0, 0, 1};
  double scale = 1;

  [[nodiscard]] Point operator()(const Point& p) const { return scale * (p.x * x + p.y * y + p.z * z); }
};

Pose random_pose(Random& random, double scale) {
  Pose pose;
  pose.z = random_direction(random);
  const Point across = cross(pose.z, random_direction(random));
  pose.x = 1 / length(across) * across;
  pose.y = cross(pose.z, pose.x);
  pose.scale = scale;
  return pose;
}

// A triangulated grid: the 30 vertices inside are the leaf, those of the rim belong to other leaves.
constexpr std::size_t kColumns = 8;
constexpr std::size_t kRows = 7;

bool is_inside(std::size_t i, std::size_t k) { return i > 0 && k > 0 && i + 1 < kColumns && k + 1 < kRows; }

using Shape = std::function<Point(double x, double y)>;  // of a point in [-0.5, 0.5]^2

Patch make_patch(const Shape& shape, const Pose& pose, Random& random) {
  Patch patch;
  std::vector<std::uint32_t> id(kColumns * kRows);
  const auto add = [&](bool inside) {
    for (std::size_t n = 0; n < id.size(); ++n) {
      if (is_inside(n % kColumns, n / kColumns) != inside) continue;
      id[n] = static_cast<std::uint32_t>(patch.points.size());
      const Point p = shape(static_cast<double>(n % kColumns) / (kColumns - 1) - 0.5,
                            static_cast<double>(n / kColumns) / (kRows - 1) - 0.5);
      patch.points.push_back(pose(p));
    }
  };
  add(false);
  patch.first = patch.points.size();
  add(true);
  patch.size = patch.points.size() - patch.first;
  const auto join = [&](std::size_t a, std::size_t b) {
    for (const auto& [from, to] : {std::pair(id[a], id[b]), std::pair(id[b], id[a])}) {
      if (from < patch.first) continue;
      patch.edges.push_back({from - static_cast<std::uint32_t>(patch.first), to});
    }
  };
  for (std::size_t n = 0; n < id.size(); ++n) {
    const bool right = n % kColumns + 1 < kColumns;
    const bool up = n / kColumns + 1 < kRows;
    if (right) join(n, n + 1);
    if (up) join(n, n + kColumns);
    if (right && up) join(n, n + kColumns + 1);
  }
  patch.center = pose({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)});
  return patch;
}

/// A flat grid whose vertices are moved by up to `along` of a cell within the plane, and by `up` across it.
Shape jittered(Random& random, double along, double up) {
  return [&random, along, up](double x, double y) {
    return Point{x + random.uniform(-along, along) / kColumns, y + random.uniform(-along, along) / kRows,
                 random.uniform(-up, up)};
  };
}

struct Kind {
  std::string name;
  std::function<Shape(Random&)> shape;
};

/// Leaves of a triangulated grid: smooth, rough, and degenerate in every way a mesh can be.
std::vector<Kind> kinds() {
  const auto fixed = [](Shape shape) { return [shape = std::move(shape)](Random&) { return shape; }; };
  return {{"flat", [](Random& r) { return jittered(r, 0.3, 0); }},
          {"tied", fixed([](double x, double y) { return Point{x, y, 0}; })},
          {"nearly flat", [](Random& r) { return jittered(r, 0.3, 1e-9); }},
          {"rough", [](Random& r) { return jittered(r, 0.3, 0.02); }},
          {"steep", [](Random& r) { return jittered(r, 0.1, 0.15); }},
          {"crumpled", [](Random& r) { return jittered(r, 2, 0.5); }},
          {"bowl", fixed([](double x, double y) { return Point{x, y, x * x + y * y}; })},
          {"saddle", fixed([](double x, double y) { return Point{x, y, x * x - y * y}; })},
          {"ridge", fixed([](double x, double y) { return Point{x, y, std::abs(x)}; })},
          {"slivers", fixed([](double x, double y) { return Point{x, 1e-3 * y, 0}; })},
          {"rough slivers",
           [](Random& r) {
             const Shape shape = jittered(r, 0.3, 0.01);
             return [shape](double x, double y) {
               const Point p = shape(x, y);
               return Point{p.x, 0.02 * p.y, p.z};
             };
           }},
          {"collinear", fixed([](double x, double y) { return Point{x + 0.1 * y, 0, 0}; })},
          {"coincident", fixed([](double, double) { return Point{0.1, 0.2, 0.3}; })},
          {"coincident columns", fixed([](double x, double y) { return Point{std::max(x, 0.0), y, 0}; })},
          {"lattice in space", [](Random& r) {
             return [&r](double, double) {
               const auto coordinate = [&r] { return static_cast<double>(r.below(4)) / 4; };
               return Point{coordinate(), coordinate(), coordinate()};
             };
           }}};
}

class EveryKind : public testing::TestWithParam<Kind> {};

TEST_P(EveryKind, HoldsAllPointsThatSeeALocalMinimum) {
  Random random(1);
  std::size_t minima = 0;
  std::size_t outside = 0;
  std::size_t bounded = 0;
  const std::size_t patches = scaled(60, 12);
  for (std::size_t i = 0; i < patches && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const double scales[] = {1, 1, 0.1, 1e-3};
    const Patch patch = make_patch(GetParam().shape(random), random_pose(random, scales[i % 4]), random);
    const MinimumRegion region = patch.region();
    minima += expect_cells_inside(patch, region, random);
    if (!is_bounded(region)) continue;
    ++bounded;
    outside += expect_no_minima_outside(patch, region, random);
  }
  std::printf("%zu leaves, %zu with a bounded region; %zu minima, %zu vertices seen from outside\n", patches, bounded,
              minima, outside);
  EXPECT_GT(minima, 0U);
}

INSTANTIATE_TEST_SUITE_P(MinimumRegion, EveryKind, testing::ValuesIn(kinds()), [](const auto& kind) {
  std::string name = kind.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

/// A leaf of up to 32 random vertices, each joined to those next to it.
Patch random_cloud(Random& random, std::size_t size, std::size_t valence) {
  Patch patch;
  const double flat = std::ldexp(1.0, -static_cast<int>(random.below(8)));
  for (std::size_t i = 0; i < 4 * size + valence; ++i) {
    patch.points.push_back({random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), flat * random.uniform(-0.5, 0.5)});
  }
  patch.first = size;
  patch.size = size;
  for (std::uint32_t lane = 0; lane < size; ++lane) {
    std::vector<std::uint32_t> others;
    for (std::uint32_t w = 0; w < patch.points.size(); ++w) {
      if (w != patch.first + lane) others.push_back(w);
    }
    std::sort(others.begin(), others.end(), [&](std::uint32_t a, std::uint32_t b) {
      return squared_distance(patch.points[a], patch.vertex(lane)) <
             squared_distance(patch.points[b], patch.vertex(lane));
    });
    for (std::size_t i = 0; i < valence; ++i) patch.edges.push_back({lane, others[i]});
  }
  patch.center = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
  return patch;
}

TEST(MinimumRegion, HoldsAllPointsThatSeeALocalMinimumOfARandomGraph) {
  Random random(2);
  std::size_t minima = 0;
  std::size_t bounded = 0;
  const std::size_t clouds = scaled(200, 40);
  for (std::size_t i = 0; i < clouds && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Patch patch = random_cloud(random, 1 + random.below(kLeafCapacity), 6 + random.below(16));
    const MinimumRegion region = patch.region();
    bounded += is_bounded(region) ? 1 : 0;
    minima += expect_cells_inside(patch, region, random);
    if (is_bounded(region)) expect_no_minima_outside(patch, region, random);
  }
  std::printf("%zu leaves, %zu with a bounded region; %zu minima\n", clouds, bounded, minima);
  EXPECT_GT(bounded, 0U);
}

TEST(MinimumRegion, IsUnboundedForAVertexOfTheRim) {
  Random random(3);
  Patch patch = make_patch(jittered(random, 0.2, 0.001), Pose{}, random);
  ASSERT_TRUE(is_bounded(patch.region()));
  // The first vertex of the leaf loses all neighbors with a smaller x.
  const double x = patch.vertex(0).x;
  std::erase_if(patch.edges, [&](const LeafEdge& e) { return e.lane == 0 && patch.points[e.neighbor].x < x; });
  EXPECT_FALSE(is_bounded(patch.region()));
}

TEST(MinimumRegion, IsUnboundedForAnIsolatedVertex) {
  const std::vector<Point> points{{0.1, 0.2, 0.3}};
  EXPECT_FALSE(is_bounded(leaf_minimum_region(points, 0, 1, {}, {}, points[0])));
}

/// For a leaf in the plane z = 0: how far the corners of a vertex's cell lie from it.
double farthest_corner(const Patch& patch, std::size_t lane) {
  const std::vector<Point> neighbors = patch.neighbors(lane);
  std::vector<Point> edges;
  for (const Point& w : neighbors) edges.push_back(w - patch.vertex(lane));
  edges.push_back({0, 0, 1});
  double result = 0;
  for (const Point& corner : cell_corners(edges)) {
    const Point in_plane{corner.x, corner.y, 0};
    if (is_minimum(patch.vertex(lane), neighbors, patch.vertex(lane) + in_plane)) {
      result = std::max(result, length(in_plane));
    }
  }
  return result;
}

TEST(MinimumRegion, OfAFlatLeafReachesToTheVoronoiCellsAndNoFarther) {
  Random random(4);
  const std::size_t patches = scaled(300, 30);
  for (std::size_t i = 0; i < patches; ++i) {
    SCOPED_TRACE(i);
    Patch patch = make_patch(jittered(random, 0.3, 0), Pose{}, random);
    const MinimumRegion region = patch.region();
    double offset = 0;
    for (std::size_t lane = 0; lane < patch.size; ++lane) {
      const Point o = patch.vertex(lane) - patch.center;
      offset = std::max(offset, length({o.x, o.y, 0}) + farthest_corner(patch, lane));
    }
    ASSERT_NEAR(region.offset, offset, 1e-6);
    // A cylinder along the normal, which does not open.
    ASSERT_NEAR(std::abs(region.slope_axis.z), 1, 1e-12);
  }
  std::printf("%zu leaves\n", patches);
}

TEST(MinimumRegion, OfASmoothLeafIsLittleWiderThanTheLeaf) {
  Random random(5);
  double widest = 0;
  for (std::size_t i = 0; i < scaled(300, 30); ++i) {
    const Shape shape = jittered(random, 0.2, 0);
    const Patch patch = make_patch(
        [&](double x, double y) {
          const Point p = shape(x, y);
          return Point{p.x, p.y, 0.2 * (p.x * p.x - p.y * p.y)};
        },
        random_pose(random, 1), random);
    const MinimumRegion region = patch.region();
    ASSERT_TRUE(is_bounded(region));
    EXPECT_LT(length(region.slope_axis), 1.1);
    double radius = 0;
    for (std::size_t lane = 0; lane < patch.size; ++lane) {
      radius = std::max(radius, length(patch.vertex(lane) - patch.center));
    }
    widest = std::max(widest, region.offset / radius);
  }
  std::printf("at most %.2f times as wide as the leaf\n", widest);
  EXPECT_LT(widest, 1.5);
}

MinimumRegion random_region(Random& random, const Point& normal) {
  const Point direction = normal + random.uniform(0, 0.3) * random_direction(random);
  const double stretch = (random.below(2) == 0 ? 1 : -1) * random.uniform(1, 1.2);
  return {stretch / length(direction) * direction, random.uniform(0.01, 0.3)};
}

TEST(EnclosingMinimumRegion, HoldsTheRegionsOfAllChildren) {
  Random random(6);
  std::size_t bounded = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < scaled(3000, 200) && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Point normal = random_direction(random);
    std::vector<MinimumRegion> children;
    std::vector<Point> centers;
    for (std::size_t k = 0; k <= i % 8; ++k) {
      children.push_back(random_region(random, normal));
      centers.push_back(random.uniform(0, 0.5) * random_direction(random));
    }
    const Point center = random.uniform(0, 0.5) * random_direction(random);
    const MinimumRegion parent = enclosing_minimum_region(children, centers, center);
    bounded += is_bounded(parent) ? 1 : 0;
    for (std::size_t k = 0; k < children.size(); ++k) {
      for (int n = 0; n < 40; ++n, ++points) {
        const Point direction = random_direction(random);
        const Point x = centers[k] + surface(children[k], direction) * direction - center;
        EXPECT_TRUE(contains(parent, x)) << "child " << k;
      }
    }
  }
  std::printf("%zu points of regions, %zu parents bounded\n", points, bounded);
  EXPECT_GT(bounded, 0U);
}

TEST(EnclosingMinimumRegion, OfOneChildAtTheSameCenterIsThatRegion) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const MinimumRegion child = random_region(random, random_direction(random));
    const std::vector<MinimumRegion> children(static_cast<std::size_t>(1 + i % 8), child);
    const std::vector<Point> centers(children.size(), random_direction(random));
    const MinimumRegion parent = enclosing_minimum_region(children, centers, centers[0]);
    EXPECT_NEAR(parent.offset, child.offset, 1e-12);
    EXPECT_NEAR(length(parent.slope_axis - child.slope_axis), 0, 1e-12);
  }
}

TEST(EnclosingMinimumRegion, DoesNotDependOnTheSignsOfAxes) {
  Random random(8);
  const Point normal = random_direction(random);
  std::vector<MinimumRegion> children;
  std::vector<Point> centers;
  for (int i = 0; i < 8; ++i) {
    children.push_back(random_region(random, normal));
    centers.push_back(0.1 * random_direction(random));
  }
  const MinimumRegion expected = enclosing_minimum_region(children, centers, {0, 0, 0});
  for (std::size_t i = 0; i < children.size(); ++i) {
    children[i].slope_axis = -1.0 * children[i].slope_axis;
    const MinimumRegion parent = enclosing_minimum_region(children, centers, {0, 0, 0});
    EXPECT_NEAR(parent.offset, expected.offset, 1e-12);
    EXPECT_NEAR(length(parent.slope_axis), length(expected.slope_axis), 1e-12);
  }
}

TEST(EnclosingMinimumRegion, IsNoWiderThanNeededForChildrenSideBySide) {
  // Parallel axes, and centers across them: the farthest point of the plane is known.
  const std::vector<MinimumRegion> children{{{0, 0, 1}, 0.1}, {{0, 0, -1.5}, 0.2}, {{0, 0, 1.2}, 0.3}};
  const std::vector<Point> centers{{1, 0, 0}, {0, 0.5, 0}, {-0.5, 0, 0}};
  const MinimumRegion parent = enclosing_minimum_region(children, centers, {0, 0, 0});
  EXPECT_DOUBLE_EQ(parent.offset, 1.1);
  EXPECT_DOUBLE_EQ(std::abs(parent.slope_axis.z), 1.5);
}

TEST(EnclosingMinimumRegion, IsUnboundedIfAChildIsOrTheAxesSpreadTooWide) {
  const MinimumRegion along_z{{0, 0, 1}, 0.1};
  const MinimumRegion along_x{{1, 0, 0}, 0.1};
  const std::vector<Point> centers(2);
  const auto enclose = [&](const MinimumRegion& a, const MinimumRegion& b) {
    return enclosing_minimum_region(std::vector{a, b}, centers, {0, 0, 0});
  };
  EXPECT_TRUE(is_bounded(enclose(along_z, along_z)));
  EXPECT_FALSE(is_bounded(enclose(along_z, kUnboundedRegion)));
  EXPECT_FALSE(is_bounded(enclose(along_z, {{0, 0, 4.5}, 0.1})));
  EXPECT_TRUE(is_bounded(enclose(along_z, along_x)));
  EXPECT_FALSE(is_bounded(enclose({{0, 0, 2}, 0.1}, {{2, 0, 0}, 0.1})));
}

}  // namespace
}  // namespace meshhood::test
