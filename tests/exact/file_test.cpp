// SPDX-License-Identifier: MIT
// An index that is saved and then loaded or mapped is the same index.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/paper.h"
#include "meshhood/refit.h"
#include "meshhood/reorder.h"
#include "meshhood/search.h"
#include "meshhood/serialize.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/index_bytes.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/same_storage.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

/// Loaded and mapped, `index` has the same arrays, saves to the same bytes, and gives the same answers.
std::size_t expect_the_same_after_saving(const Index& index, const MeshView& mesh) {
  const std::vector<std::byte> bytes = saved(index);
  EXPECT_EQ(bytes.size() % kIndexAlignment, 0U);
  const Index loaded = load(bytes);
  Mappable mappable(bytes);
  const Index mapped = map(mappable.bytes(), nullptr);
  const Index trusted = map(mappable.bytes(), nullptr, {.trusted = true});
  for (const Index* other : {&loaded, &mapped, &trusted}) {
    EXPECT_THAT(differences(*other, index), IsEmpty());
    EXPECT_THAT(other->check(mesh), IsEmpty());
    EXPECT_EQ(other->bytes().total(), index.bytes().total());
  }
  EXPECT_EQ(saved(loaded), bytes);
  EXPECT_EQ(saved(mapped), bytes);
  EXPECT_EQ(read_header(bytes).mesh, fingerprint(mesh));
  const auto head = std::span(bytes).first(std::min(bytes.size(), kIndexHeadBytes));
  EXPECT_EQ(read_header(head, bytes.size()).mesh, fingerprint(mesh));

  Searcher before(index);
  Searcher after(mapped);
  std::vector<VertexId> expected;
  std::vector<VertexId> ids;
  Random random(2);
  std::size_t queries = 0;
  for (; queries < 20 && index.vertex_count() > 0; ++queries) {
    const auto v = static_cast<VertexId>(random.below(index.vertex_count()));
    const auto w = static_cast<VertexId>(random.below(index.vertex_count()));
    const double radius = queries == 0 ? std::numeric_limits<double>::infinity() : distance(mesh.positions, v, w);
    before.neighborhood(v, radius, expected);
    after.neighborhood(v, radius, ids);
    EXPECT_EQ(ids, expected) << "vertex " << v << ", radius " << radius;
  }
  return queries;
}

MESHHOOD_SUITE_OF_FAMILIES(Serialize);

TEST_P(Serialize, RestoresTheIndex) {
  std::size_t queries = 0;
  for (const std::size_t vertices : {1U, 2U, 33U, 400U, 3000U}) {
    const TestMesh mesh = make_mesh(GetParam(), 5, vertices);
    SCOPED_TRACE(mesh.name);
    queries += expect_the_same_after_saving(build(mesh.view()), mesh.view());
    const ReorderedMesh reordered = reorder(mesh.view());
    queries += expect_the_same_after_saving(reordered.index, reordered.view());
  }
  std::printf("%s: %zu queries\n", std::string(GetParam().name).c_str(), queries);
}

TEST_P(Serialize, RestoresTheGraphOfTheMesh) {
  const TestMesh mesh = make_mesh(GetParam(), 8, 1000);
  const Adjacency expected = adjacency(mesh.view());
  const GraphData found = extract_graph(build(mesh.view()));
  EXPECT_EQ(found.adjacency.offsets, expected.offsets);
  EXPECT_EQ(found.adjacency.neighbors, expected.neighbors);
  std::visit(
      [&]<class Real>(const std::vector<Real>& xyz) {
        const bool is_single = std::is_same_v<Real, float>;
        EXPECT_EQ(is_single, mesh.single_precision);
        EXPECT_TRUE(std::equal(xyz.begin(), xyz.end(), mesh.positions.begin(), mesh.positions.end(),
                               [](Real a, double b) { return static_cast<double>(a) == b; }));
      },
      found.positions);
}

TEST(SerializeEdges, HandlesNoVerticesOneVertexAndIsolatedVertices) {
  const std::vector<float> none;
  const std::vector<double> one{1, 2, 3};
  std::vector<float> many;
  for (int i = 0; i < 300; ++i) many.push_back(static_cast<float>(i % 7));
  for (const PositionsView& positions : {PositionsView(none), PositionsView(one), PositionsView(many)}) {
    const MeshView mesh{positions, {}};
    expect_the_same_after_saving(build(mesh), mesh);
    const ReorderedMesh reordered = reorder(mesh);
    expect_the_same_after_saving(reordered.index, reordered.view());
  }
}

/// Corner by corner, with the number of corners before those of each face.
std::vector<std::uint64_t> padded(const FacesView& faces) {
  std::vector<std::uint64_t> result;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    result.push_back(corners.size());
    result.insert(result.end(), corners.begin(), corners.end());
  });
  return result;
}

TEST_P(Serialize, RestoresTheFaces) {
  for (const std::size_t vertices : {1U, 33U, 400U}) {
    const TestMesh mesh = make_mesh(GetParam(), 7, vertices);
    SCOPED_TRACE(mesh.name);
    const FacesView faces = mesh.view().faces;
    const Index index = build(mesh.view());
    EXPECT_FALSE(index.faces());
    const std::vector<std::byte> bytes = saved(index, {.faces = faces});
    Mappable mappable(bytes);
    const Index loaded = load(bytes);
    const Index mapped = map(mappable.bytes(), nullptr);
    const Index trusted = map(mappable.bytes(), nullptr, {.trusted = true});
    const Index moved = refit(loaded, mesh.view().positions);
    for (const Index* other : {&loaded, &mapped, &trusted, &moved}) {
      ASSERT_TRUE(other->faces());
      EXPECT_EQ(padded(*other->faces()), padded(faces));
      EXPECT_EQ(saved(*other, {.faces = other->faces()}), bytes);
      EXPECT_EQ(saved(*other), saved(index)) << "saved without faces";
    }
    EXPECT_THAT(differences(loaded, index), IsEmpty());
    const Index without_faces = load(saved(index));
    EXPECT_FALSE(without_faces.faces());
  }
}

TEST(SerializeEdges, GivesTheSameBytesHoweverTheFacesAreRepresented) {
  const auto [mesh, index] = indexed(make_grid(5, 4, false).finish(true));
  const std::vector<std::byte> expected = saved(index, {.faces = mesh.view().faces});
  const Index loaded = load(expected);
  EXPECT_TRUE(loaded.faces()->are_triangles());
  EXPECT_EQ(saved(index, {.faces = FacesView::triangles(mesh.corners)}), expected);
  const std::vector<std::int64_t> wide(mesh.corners.begin(), mesh.corners.end());
  EXPECT_EQ(saved(index, {.faces = FacesView::triangles(wide)}), expected);
  std::vector<std::uint32_t> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) columns.push_back(mesh.corners[3 * f + i]);
  }
  EXPECT_EQ(saved(index, {.faces = FacesView::column_major_triangles(columns)}), expected);
}

TEST(SerializeEdges, RestoresPolygonsWithAsManyCornersAsTriangles) {
  TestMesh mesh = make_grid(5, 4, false).finish(true);
  mesh.offsets = {0};
  mesh.corners.clear();
  mesh.add_face({0, 1});
  mesh.add_face({0, 1, 5, 4});
  const Index loaded = load(saved(build(mesh.view()), {.faces = mesh.view().faces}));
  EXPECT_EQ(padded(*loaded.faces()), padded(mesh.view().faces));
}

TEST(SerializeEdges, KeepsNoFacesApartFromFacesThatAreNone) {
  const auto [mesh, index] = indexed(make_grid(5, 4, false).finish(true));
  const Index loaded = load(saved(index, {.faces = FacesView{}}));
  ASSERT_TRUE(loaded.faces());
  EXPECT_EQ(loaded.faces()->size(), 0U);
}

TEST(SerializeEdges, RefusesFacesThatAreNotOfTheIndex) {
  const TestMesh small = make_grid(5, 4, false).finish(true);
  const TestMesh large = make_grid(5, 5, false).finish(true);
  const Index index = build(small.view());
  expect_refused(ErrorCode::InvalidMesh, "but the mesh has 20 vertices",
                 [&] { return saved(index, {.faces = large.view().faces}); });
}

TEST(SerializeEdges, AMappedIndexKeepsItsOwner) {
  const TestMesh mesh = make_grid(20, 20, false).finish(true);
  auto owner = std::make_shared<Mappable>(saved(build(mesh.view())));
  const std::weak_ptr<Mappable> watch = owner;
  const auto bytes = owner->bytes();
  {
    const Index index = map(bytes, std::move(owner));
    EXPECT_FALSE(watch.expired());
    EXPECT_THAT(index.check(mesh.view()), IsEmpty());
  }
  EXPECT_TRUE(watch.expired());
}

TEST(SerializeEdges, MapRejectsBytesThatAreNotAligned) {
  Mappable bytes(std::vector<std::byte>(256));
  expect_refused(ErrorCode::InvalidOption, "begin 8 bytes after a multiple of 64",
                 [&] { return map(bytes.bytes().subspan(8), nullptr); });
}

TEST(SerializeEdges, PassesOnExceptionsOfTheSink) {
  const auto [mesh, index] = indexed(make_grid(20, 20, false).finish(true));
  EXPECT_THROW(save(index, [](std::span<const std::byte>) { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THAT(index.check(mesh.view()), IsEmpty());
}

TEST(Fingerprint, DependsOnPositionsAndGraphOnly) {
  const TestMesh mesh = make_grid(4, 5, false).finish(true);
  const Fingerprint expected = fingerprint(mesh.view());
  EXPECT_EQ(to_text(expected).size(), 32U);
  EXPECT_EQ(fingerprint(build(mesh.view())), expected);

  TestMesh turned = mesh;  // with its faces, and the corners of each face, in another order
  std::reverse(turned.corners.begin(), turned.corners.end());
  EXPECT_EQ(fingerprint(turned.view()), expected);

  TestMesh moved = mesh;
  moved.single_positions[7] = -0.0F;
  EXPECT_NE(fingerprint(moved.view()), expected);
  TestMesh cut = mesh;
  cut.offsets.pop_back();
  cut.corners.resize(cut.offsets.back());
  EXPECT_NE(fingerprint(cut.view()), expected);
  TestMesh in_double = mesh;
  in_double.single_precision = false;
  EXPECT_NE(fingerprint(in_double.view()), expected);
}

}  // namespace
}  // namespace meshhood::test
