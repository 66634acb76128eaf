// SPDX-License-Identifier: MIT
// Patches, their areas, volumes and gaps, against a search in breadth with closed forms in long double.
#include "meshhood/patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/refit.h"

#include "base/triangulate.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/patch_reference.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Reference = PatchReference<long double>;

constexpr double kPi = std::numbers::pi;

Point corner_of(const TestMesh& mesh, std::uint32_t v) {
  return {mesh.positions[3 * std::size_t{v}], mesh.positions[3 * std::size_t{v} + 1],
          mesh.positions[3 * std::size_t{v} + 2]};
}

/// The triangles of the faces, and the face of each.
struct TestTriangles {
  explicit TestTriangles(const TestMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<Point> points;
      for (const std::uint32_t v : mesh.face(f)) points.push_back(corner_of(mesh, v));
      Triangulation parts;
      triangulate(points, parts);
      const auto owner = [&](std::size_t a, std::size_t b) {
        const bool is_side = (a + 1) % points.size() == b || (b + 1) % points.size() == a;
        return static_cast<std::uint32_t>(is_side ? 0 : f + 1);
      };
      for (const auto& [a, b, c] : parts) {
        corners.push_back({mesh.face(f)[a], mesh.face(f)[b], mesh.face(f)[c]});
        owners.push_back({owner(a, b), owner(b, c), owner(c, a)});
        faces.push_back(f);
      }
    }
  }

  std::vector<Reference::Triangle> corners;
  std::vector<Reference::Triangle> owners;
  std::vector<std::size_t> faces;

  [[nodiscard]] std::vector<std::size_t> faces_of(const std::vector<std::size_t>& triangles) const {
    std::vector<std::size_t> result;
    for (const std::size_t t : triangles) result.push_back(faces[t]);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }
};

/// A mesh with everything that is asked of it.
struct Case {
  explicit Case(const TestMesh& given)
      : mesh(given),
        triangles(mesh),
        reference(mesh.positions, triangles.corners, triangles.owners),
        index(build(mesh.view())),
        surface(PatchIndex::build(index, mesh.view().faces)),
        searcher(surface) {}

  /// Compares what the library says with the reference.
  void expect_same(const PatchStart& start, const Reference::Answer& expected, double radius) {
    EXPECT_EQ(searcher.patch(start, radius), triangles.faces_of(expected.faces));
    const PatchMeasure measure = searcher.measure(start, radius);
    const double disc = kPi * radius * radius;
    EXPECT_NEAR(measure.area / disc, expected.area / disc, 1e-12 * std::max(1.0, expected.area / disc));
    EXPECT_EQ(std::isnan(measure.volume), std::isnan(expected.volume));
    if (!std::isnan(expected.volume)) {
      const double ball = 4 * kPi / 3 * radius * radius * radius;
      const double scale = std::max(1.0, std::abs(expected.volume) / ball);
      EXPECT_NEAR(measure.volume / ball, expected.volume / ball, 1e-12 * scale);
    }
    const PatchGap gap = searcher.gap(start, radius);
    EXPECT_EQ(gap.face == kNoFace, std::isinf(expected.gap));
    if (gap.face != kNoFace) {
      EXPECT_NEAR(gap.distance, expected.gap, 1e-12 * radius);
    }
  }

  TestMesh mesh;
  TestTriangles triangles;
  Reference reference;
  Index index;
  PatchIndex surface;
  PatchSearcher searcher;
};

class PatchFamilies : public testing::TestWithParam<Family> {};

TEST_P(PatchFamilies, AreThoseOfTheReference) {
  for (std::uint64_t seed = 0; seed < scaled(20, 2); ++seed) {
    SCOPED_TRACE(seed);
    const TestMesh mesh = make_mesh(GetParam(), seed, 150);
    if (TestTriangles(mesh).corners.empty()) continue;
    Case test(mesh);
    Random random(seed);
    const double edge = mean_edge_length(test.index);
    for (std::size_t i = 0; i < 20; ++i) {
      const auto v = static_cast<std::uint32_t>(random.below(test.mesh.size()));
      const double radius = edge * std::exp2(random.uniform(-3, 4));
      SCOPED_TRACE("vertex " + std::to_string(v) + ", radius " + std::to_string(radius));
      const Reference::Answer expected = test.reference.around_vertex(v, radius);
      if (expected.faces.empty()) continue;
      test.expect_same(v, expected, radius);
      if (HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, PatchFamilies, testing::ValuesIn(surface_families().begin(), surface_families().end()),
                         family_name);
INSTANTIATE_TEST_SUITE_P(Traps, PatchFamilies, testing::ValuesIn(trap_families().begin(), trap_families().end()), family_name);

}  // namespace
}  // namespace meshhood::test
