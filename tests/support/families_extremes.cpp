// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/families.h"

namespace meshhood::test {
namespace {

/// A mesh of any other family, whose coordinates are then replaced or moved.
TestMesh any_shape(Random& random, std::size_t vertices) {
  const auto surfaces = surface_families();
  const auto traps = trap_families();
  const std::size_t pick = random.below(surfaces.size() + traps.size());
  const Family& family = pick < surfaces.size() ? surfaces[pick] : traps[pick - surfaces.size()];
  return family.make(random, vertices);
}

TestMesh times(TestMesh mesh, double factor) {
  for (double& x : mesh.positions) x *= factor;
  return mesh;
}

TestMesh huge(Random& random, std::size_t vertices) { return times(any_shape(random, vertices), 1e30); }
TestMesh tiny(Random& random, std::size_t vertices) { return times(any_shape(random, vertices), 1e-30); }

/// The squares of these distances are denormal or zero.
TestMesh vanishing(Random& random, std::size_t vertices) {
  return times(any_shape(random, vertices), random.below(2) == 0 ? 1e-161 : 1e-200);
}

TestMesh denormal(Random& random, std::size_t vertices) {
  return times(any_shape(random, vertices), 20 * static_cast<double>(std::numeric_limits<float>::denorm_min()));
}

/// Near the largest coordinate that is accepted as a double.
TestMesh colossal(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  double largest = 1;
  for (const double x : mesh.positions) largest = std::max(largest, std::abs(x));
  return times(std::move(mesh), 0x1p500 / largest * (1 - 1e-15));
}

/// Every coordinate is plus or minus the largest float.
TestMesh float_limits(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  for (double& x : mesh.positions) x = std::copysign(double{std::numeric_limits<float>::max()}, random.uniform(-1));
  return mesh;
}

TestMesh mixed_scales(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  for (double& x : mesh.positions) x *= std::pow(10.0, std::floor(random.uniform(-30, 31)));
  return mesh;
}

/// A shape far from the origin, where coordinates have few bits left.
TestMesh far_away(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  for (double& x : mesh.positions) x += 1e6;
  return mesh;
}

TestMesh coincident(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  const auto places = static_cast<double>(1 + random.below(3));
  for (double& x : mesh.positions) x = std::floor(random.uniform(0, places));
  return mesh;
}

TestMesh collinear(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    const double along = random.uniform(-5, 5);
    for (std::size_t i = 0; i < 3; ++i) mesh.positions[3 * v + i] = along * static_cast<double>(i + 1);
  }
  return mesh;
}

TestMesh one_vertex(Random& random, std::size_t) {
  TestMesh mesh;
  mesh.add_vertex(random.uniform(), random.uniform(), random.uniform());
  if (random.below(2) == 0) mesh.add_face({0, 0, 0});
  return mesh;
}

TestMesh no_faces(Random& random, std::size_t vertices) {
  TestMesh mesh = any_shape(random, vertices);
  mesh.corners.clear();
  mesh.offsets = {0};
  return mesh;
}

TestMesh nothing(Random&, std::size_t) { return {}; }

constexpr auto kExtremes = std::to_array<Family>({
    {"huge", huge},
    {"tiny", tiny},
    {"vanishing", vanishing, false},
    {"denormal", denormal},
    {"colossal", colossal, false},
    {"float limits", float_limits},
    {"mixed scales", mixed_scales},
    {"far away", far_away},
    {"coincident", coincident},
    {"collinear", collinear},
    {"one vertex", one_vertex},
    {"no faces", no_faces},
    {"nothing", nothing},
});

}  // namespace

std::span<const Family> extreme_families() { return kExtremes; }

}  // namespace meshhood::test
