// SPDX-License-Identifier: MIT
#include "shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "shapes/geometry.h"

namespace meshhood {
namespace {

using shapes::Kind;
using shapes::Shape;

/// Sizes from the smallest on, most of them not round.
std::vector<std::size_t> sizes_of(const Kind& kind) {
  std::vector<std::size_t> sizes;
  for (std::size_t n = kind.minimum; n < kind.minimum + 100; ++n) sizes.push_back(n);
  for (const std::size_t n : {499U, 1000U, 1237U, 10000U}) sizes.push_back(n);
  return sizes;
}

std::size_t unused_vertices(const Shape& shape) {
  const std::set<std::uint32_t> used(shape.corners.begin(), shape.corners.end());
  return shape.positions.size() / 3 - used.size();
}

/// The number of faces of each edge.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edge_faces(const Shape& shape) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
  for (std::size_t i = 0; i < shape.corners.size(); ++i) {
    const std::uint32_t a = shape.corners[i];
    const std::uint32_t b = shape.corners[i % 3 == 2 ? i - 2 : i + 1];
    ++faces[std::minmax(a, b)];
  }
  return faces;
}

bool is_closed(const Shape& shape) {
  const auto faces = edge_faces(shape);
  return std::all_of(faces.begin(), faces.end(), [](const auto& edge) { return edge.second == 2; });
}

TEST(Shapes, AreMeshesOfTheRequestedSize) {
  std::size_t checked = 0;
  for (const Kind& kind : shapes::kinds()) {
    for (const std::size_t n : sizes_of(kind)) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(n));
      const Shape shape = kind.make(n);
      EXPECT_NO_THROW(validate(shape.view()));
      EXPECT_EQ(unused_vertices(shape), kind.name == "isolated" ? n : 0);
      const auto made = static_cast<double>(shape.view().positions.size());
      const bool of_parts = kind.name == "gyroid" || kind.name == "knot" || kind.name == "ngons";
      if (!of_parts || n >= 1000) {
        EXPECT_NEAR(made, static_cast<double>(n), of_parts ? 0.05 * static_cast<double>(n) : 0.0);
      }
      ++checked;
    }
  }
  std::printf("%zu kinds, %zu shapes\n", shapes::kinds().size(), checked);
}

TEST(Shapes, AreSortedByNameAndFoundByIt) {
  const auto& kinds = shapes::kinds();
  EXPECT_TRUE(std::is_sorted(kinds.begin(), kinds.end(), [](auto& a, auto& b) { return a.name < b.name; }));
  for (const Kind& kind : kinds) EXPECT_EQ(shapes::find_kind(kind.name), &kind);
  EXPECT_EQ(shapes::find_kind("teapot"), nullptr);
}

TEST(Shapes, RefuseTooFewAndTooManyVertices) {
  const auto code_for = [](const Kind& kind, std::size_t n) {
    try {
      static_cast<void>(kind.make(n));
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(std::string(kind.name)));
      return error.code();
    }
    ADD_FAILURE() << kind.name << " made " << n << " vertices";
    return ErrorCode::IoFailure;
  };
  for (const Kind& kind : shapes::kinds()) {
    EXPECT_EQ(code_for(kind, kind.minimum - 1), ErrorCode::InvalidOption);
    EXPECT_EQ(code_for(kind, kMaxVertices + 1), ErrorCode::TooLarge);
  }
}

TEST(Shapes, ClosedOnesHaveNoBoundary) {
  std::size_t checked = 0;
  for (const std::string_view name : {"knot", "soup", "sphere"}) {
    const Kind& kind = *shapes::find_kind(name);
    for (const std::size_t n : sizes_of(kind)) {
      EXPECT_TRUE(is_closed(kind.make(n))) << name << ' ' << n;
      ++checked;
    }
  }
  std::printf("%zu closed shapes\n", checked);
}

/// The approximate distance of a point from the gyroid.
double gyroid_miss(const float* p) {
  constexpr double kPeriod = 10.4;
  const auto angle = [&](int axis) { return 2 * shapes::kPi * static_cast<double>(p[axis]) / kPeriod; };
  const double field = std::sin(angle(0)) * std::cos(angle(1)) + std::sin(angle(1)) * std::cos(angle(2)) +
                       std::sin(angle(2)) * std::cos(angle(0));
  return std::abs(field) * kPeriod / (2 * shapes::kPi);
}

TEST(Shapes, GyroidIsASheetWithTwoSidesWhereItsFormulaIsZero) {
  const Shape shape = shapes::find_kind("gyroid")->make(20000);
  for (std::size_t i = 0; i < shape.positions.size(); i += 3) EXPECT_LT(gyroid_miss(&shape.positions[i]), 0.2);
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t i = 0; i < shape.corners.size(); ++i) {
    const std::uint32_t next = shape.corners[i % 3 == 2 ? i - 2 : i + 1];
    EXPECT_TRUE(sides.emplace(shape.corners[i], next).second) << "two faces on one side of an edge";
  }
  std::printf("%zu vertices, %zu faces\n", shape.positions.size() / 3, shape.corners.size() / 3);
}

TEST(Shapes, EdgesAreAboutOneLong) {
  for (const Kind& kind : shapes::kinds()) {
    if (kind.name == "isolated") continue;
    const Shape shape = kind.make(5000);
    const Adjacency graph = adjacency(shape.view());
    EXPECT_NEAR(mean_edge_length({shape.view().positions, graph.view()}), 1.2, 0.55) << kind.name;
  }
}

/// The number of vertices that balls have in excess of exact answers, over queries of the whole shape.
std::size_t extras_of_ball(const Shape& shape, double radius) {
  ReferenceSearcher searcher(shape.view());
  std::vector<VertexId> exact;
  std::vector<VertexId> in_ball;
  std::size_t extras = 0;
  const std::size_t vertices = shape.positions.size() / 3;
  for (std::size_t v = 0; v < vertices; v += 1 + vertices / 50) {
    searcher.neighborhood(static_cast<VertexId>(v), radius, exact);
    BallSearcher(shape.view().positions).neighborhood(static_cast<VertexId>(v), radius, in_ball);
    extras += in_ball.size() - exact.size();
  }
  return extras;
}

TEST(Shapes, HaveVerticesThatAreNearButNotConnectedInTheBall) {
  const auto harmless = {"grid", "gyroid", "ngons", "noise", "quads", "sphere"};
  for (const Kind& kind : shapes::kinds()) {
    const std::size_t extras = extras_of_ball(kind.make(5000), kind.name == "star" ? 0.5 : 4.0);
    std::printf("%-9s %zu extra vertices in 50 balls\n", std::string(kind.name).c_str(), extras);
    if (std::count(harmless.begin(), harmless.end(), kind.name) > 0) {
      EXPECT_EQ(extras, 0U) << kind.name;
    } else {
      EXPECT_GT(extras, 100U) << kind.name;
    }
  }
}

// A change here changes every benchmark and picture of the shapes; on a new platform it is a bug.
TEST(Shapes, HaveTheSameBytesEverywhere) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 0x100000001b3U; };
  for (const Kind& kind : shapes::kinds()) {
    const Shape shape = kind.make(3000);
    for (const float coordinate : shape.positions) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof bits);
      add(bits);
    }
    for (const std::uint32_t corner : shape.corners) add(corner);
  }
  EXPECT_EQ(hash, 15589639091413617374U);
}

TEST(Geometry, DirectionsHaveTheGivenAngle) {
  for (int i = -1000; i <= 1000; ++i) {
    const double turns = 0.00731 * i;
    const shapes::Direction d = shapes::direction(turns);
    EXPECT_NEAR(d.cos, std::cos(2 * shapes::kPi * turns), 4e-14);
    EXPECT_NEAR(d.sin, std::sin(2 * shapes::kPi * turns), 4e-14);
    EXPECT_NEAR(d.cos * d.cos + d.sin * d.sin, 1.0, 1e-15);
  }
}

}  // namespace
}  // namespace meshhood
