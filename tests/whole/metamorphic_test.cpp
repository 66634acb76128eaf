// SPDX-License-Identifier: MIT
// Equivalent representations of a mesh have the same exact answers, and the paper's answer contains the exact one of
// the original mesh.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

/// An equivalent mesh: the new id of each vertex, and the scale of distances.
struct Equivalent {
  TestMesh mesh;
  std::vector<std::uint32_t> place;  // new id of each old vertex
  double scale = 1;
};

using Transformation = std::function<Equivalent(const TestMesh&, Random&)>;

Equivalent in_place(TestMesh mesh) {
  std::vector<std::uint32_t> same(mesh.size());
  std::iota(same.begin(), same.end(), 0U);
  mesh.finish(mesh.single_precision);
  return {std::move(mesh), std::move(same)};
}

/// `mesh` with its faces changed by `change(corners)` and in the order `faces`.
template <class Change>
TestMesh with_faces(const TestMesh& mesh, const std::vector<std::uint32_t>& faces, Change&& change) {
  TestMesh result = mesh;
  result.offsets = {0};
  result.corners.clear();
  for (const std::uint32_t f : faces) {
    std::vector<std::uint32_t> corners(mesh.face(f).begin(), mesh.face(f).end());
    change(corners);
    result.add_face(corners);
  }
  return result;
}

std::vector<std::uint32_t> in_order(const TestMesh& mesh) {
  std::vector<std::uint32_t> faces(mesh.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  return faces;
}

Equivalent vertices_shuffled(const TestMesh& mesh, Random& random) {
  const auto place = random.permutation(mesh.size());
  return {renumbered(mesh, place), place};
}

Equivalent faces_shuffled(const TestMesh& mesh, Random& random) {
  return in_place(with_faces(mesh, random.permutation(mesh.face_count()), [](auto&) {}));
}

Equivalent corners_rotated(const TestMesh& mesh, Random& random) {
  return in_place(with_faces(mesh, in_order(mesh), [&](auto& corners) {
    if (corners.empty()) return;
    std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(random.below(corners.size())));
  }));
}

Equivalent faces_flipped(const TestMesh& mesh, Random&) {
  return in_place(with_faces(mesh, in_order(mesh), [](auto& corners) { std::ranges::reverse(corners); }));
}

Equivalent faces_doubled(const TestMesh& mesh, Random&) {
  auto faces = in_order(mesh);
  faces.insert(faces.end(), faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(mesh.face_count()));
  return in_place(with_faces(mesh, faces, [](auto&) {}));
}

Equivalent isolated_added(const TestMesh& mesh, Random& random) {
  Equivalent result = in_place(mesh);
  for (int i = 0; i < 20; ++i) {
    const std::size_t at = random.below(mesh.size());
    result.mesh.add_vertex(mesh.positions[3 * at], mesh.positions[3 * at + 1], mesh.positions[3 * at + 2]);
  }
  result.mesh.finish(mesh.single_precision);
  return result;
}

Equivalent united_with_a_copy(const TestMesh& mesh, Random&) {
  Equivalent result = in_place(mesh);
  append(result.mesh, mesh);
  return result;
}

Equivalent mirrored(const TestMesh& mesh, Random& random) {
  TestMesh result = mesh;
  const std::size_t axis = random.below(3);
  for (std::size_t v = 0; v < mesh.size(); ++v) result.positions[3 * v + axis] *= -1;
  return in_place(std::move(result));
}

Equivalent scaled_by_a_power(const TestMesh& mesh, Random& random) {
  TestMesh result = mesh;
  const double scale = std::ldexp(1.0, static_cast<int>(random.below(41)) - 20);
  for (double& x : result.positions) x *= scale;
  Equivalent changed = in_place(std::move(result));
  changed.scale = scale;
  return changed;
}

struct NamedTransformation {
  const char* name;
  Transformation apply;

  friend void PrintTo(const NamedTransformation& transformation, std::ostream* out) { *out << transformation.name; }
};

class Metamorphic : public testing::TestWithParam<NamedTransformation> {};

void compare(const TestMesh& mesh, const Equivalent& changed, Random& random) {
  ReferenceSearcher before(mesh.view());
  ReferenceSearcher after(changed.mesh.view());
  const paper::Index index = paper::build(changed.mesh.view());
  ASSERT_THAT(index.check(changed.mesh.view()), testing::IsEmpty()) << mesh.name;
  paper::Searcher searcher(index);
  const Index exact_index = build(changed.mesh.view());
  Searcher exact_searcher(exact_index);
  std::vector<VertexId> out;
  for (int i = 0; i < 40; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const auto w = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = i == 0 ? std::numeric_limits<double>::infinity() : distance(mesh.positions_view(), v, w);
    before.neighborhood(v, radius, out);
    for (VertexId& id : out) id = static_cast<VertexId>(changed.place[id]);
    const auto expected = sorted(out);
    const auto place = static_cast<VertexId>(changed.place[v]);
    after.neighborhood(place, radius * changed.scale, out);
    ASSERT_EQ(sorted(out), expected) << mesh.name << ", vertex " << v << ", radius " << radius;
    exact_searcher.neighborhood(place, radius * changed.scale, out);
    ASSERT_EQ(sorted(out), expected) << mesh.name << ", vertex " << v << ", radius " << radius;
    searcher.neighborhood(place, radius * changed.scale, out);
    ASSERT_TRUE(std::ranges::includes(sorted(out), expected)) << mesh.name << ", vertex " << v << ", radius " << radius;
  }
}

TEST_P(Metamorphic, ExactAnswersDoNotChange) {
  std::size_t meshes = 0;
  for (const auto some : {surface_families(), trap_families()}) {
    for (const Family& family : some) {
      for (std::uint64_t seed = 1; seed <= scaled(20, 1); ++seed, ++meshes) {
        const TestMesh mesh = make_mesh(family, seed, 10 + 20 * seed);
        Random random(seed);
        compare(mesh, GetParam().apply(mesh, random), random);
      }
    }
  }
  std::printf("%s: %zu meshes, %zu queries, 0 mismatches\n", GetParam().name, meshes, 80 * meshes);
}

INSTANTIATE_TEST_SUITE_P(Retellings, Metamorphic,
                         testing::Values(NamedTransformation{"vertices_shuffled", vertices_shuffled},
                                         NamedTransformation{"faces_shuffled", faces_shuffled},
                                         NamedTransformation{"corners_rotated", corners_rotated},
                                         NamedTransformation{"faces_flipped", faces_flipped},
                                         NamedTransformation{"faces_doubled", faces_doubled},
                                         NamedTransformation{"isolated_added", isolated_added},
                                         NamedTransformation{"united_with_a_copy", united_with_a_copy},
                                         NamedTransformation{"mirrored", mirrored},
                                         NamedTransformation{"scaled_by_a_power", scaled_by_a_power}),
                         [](const auto& transformation) { return std::string(transformation.param.name); });

TEST(MetamorphicLattice, ExactAnswersDoNotChangeUnderAShift) {
  const Family& lattice = *std::ranges::find(surface_families(), "lattice", &Family::name);
  for (std::uint64_t seed = 1; seed <= scaled(100, 3); ++seed) {
    const TestMesh mesh = make_mesh(lattice, seed, 200);
    TestMesh shifted = mesh;
    for (double& x : shifted.positions) x += static_cast<double>(seed * 1000);
    Random random(seed);
    compare(mesh, in_place(std::move(shifted)), random);
  }
}

}  // namespace
}  // namespace meshhood::test
