// SPDX-License-Identifier: MIT
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"
#include "support/scale.h"

// STL files: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::array<float, 9> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::array<float, 9> kNeighbor = {1, 0, 0, 1, 1, 0, 0, 1, 0};

std::string facet(const std::string& vertices) {
  return "facet normal 0 0 1\nouter loop\n" + vertices + "endloop\nendfacet\n";
}

const std::string kStlVertices = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";

// M1
TEST(Stl, AHugeFacetCountAllocatesNothing) {
  std::string file = binary_stl({kTriangle});
  file.replace(80, 4, little(0xffffffffU));
  expect_malformed("a.stl", file, "4294967295 facets", "214748364834 bytes");
}

// M3
TEST(Stl, TruncationAtAnyByteIsRefused) {
  expect_truncations_refused("a.stl", binary_stl({kTriangle, kNeighbor}), 2);
  const std::string text = "solid\n" + facet(kStlVertices);
  expect_truncations_refused("a.stl", text, 1, 1);
  expect_malformed("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "a.stl:4:11", "facet 0, vertex 0, z");
  EXPECT_EQ(warned(read("a.stl", text), "endsolid"), 1U);
}

// M4
TEST(Stl, BytesAfterTheLastFacetAreAWarning) {
  const std::string file = binary_stl({kTriangle}) + "tail";
  const auto mesh = read("a.stl", file);
  EXPECT_EQ(face_count(mesh), 1U);
  EXPECT_EQ(warned(mesh, "after the last facet"), 1U);
  EXPECT_EQ(mesh.warnings.at(0).first_place, "byte 134");
  EXPECT_TRUE(refusal("a.stl", file, {.strict = true}).refused);
}

// Each facet is followed by as many bytes as its attribute says, but the last `cut` bytes of the file are missing.
std::string stl_with_payload(const std::vector<std::uint16_t>& payloads, std::size_t cut = 0) {
  std::string file = binary_stl(std::vector<std::array<float, 9>>(payloads.size(), kTriangle));
  for (std::size_t facet = payloads.size(); facet-- != 0;) {
    const std::size_t attribute = 84 + 50 * facet + 48;
    file.replace(attribute, 2, little(payloads[facet]) + std::string(payloads[facet], '\x3f'));
  }
  return file.substr(0, file.size() - cut);
}

// M25
TEST(Stl, BytesAfterEachFacetAreSkippedIfTheSizeSaysSo) {
  for (const std::vector<std::uint16_t>& payloads : {std::vector<std::uint16_t>{4, 4, 4}, {0, 7, 1}}) {
    const std::string file = stl_with_payload(payloads);
    const auto mesh = read("a.stl", file);
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 0, 1, 2, 0, 1, 2));
    EXPECT_EQ(vertex_count(mesh), 3U);
    EXPECT_EQ(warned(mesh, "followed by bytes of their own"), payloads[0] == 4 ? 3U : 2U);
    EXPECT_TRUE(refusal("a.stl", file, {.strict = true}).refused);
  }
  expect_malformed("a.stl", stl_with_payload({4, 4, 4}, 1), "a.stl@242",
                   "facet 2 says that 4 bytes follow, and the file is shorter");
  expect_malformed("a.stl", stl_with_payload({4, 4, 4}) + "x", "a.stl@246", "bytes after the last of 3 facets");
}

// M25
TEST(Stl, ColorsOfFacetsAreNoCounts) {
  std::string file = binary_stl({kTriangle, kNeighbor});
  file.replace(84 + 48, 2, little(std::uint16_t{0x801f}));
  const auto mesh = read("a.stl", file);
  EXPECT_EQ(face_count(mesh), 2U);
  EXPECT_TRUE(mesh.warnings.empty());
}

// M25
TEST(Stl, FacetsAfterACountOfZeroAreRefused) {
  std::string file = binary_stl({kTriangle});
  file.replace(80, 4, little(0U));
  expect_malformed("a.stl", file, "a.stl@84", "after the last of 0 facets");
  EXPECT_EQ(face_count(read("a.stl", file.substr(0, 84))), 0U);
}

// M13
TEST(Stl, ABinaryFileMayBeginWithSolid) {
  for (const std::string header : {"solid", "solid name", "SOLID facet normal 0 0 1"}) {
    const auto mesh = read("a.stl", binary_stl({kTriangle, kNeighbor}, header));
    EXPECT_EQ(face_count(mesh), 2U) << header;
    EXPECT_TRUE(mesh.warnings.empty()) << header;
    EXPECT_EQ(warned(read("a.stl", binary_stl({kTriangle}, header) + "x"), "after the last facet"), 1U) << header;
  }
  const std::string blank_header = binary_stl({kTriangle}, "solid" + std::string(75, ' '));
  EXPECT_EQ(face_count(read("no_ending", blank_header)), 1U);
}

// M13
TEST(Stl, TheErrorHasBothReasonsIfNeitherFits) {
  const std::string cut = binary_stl({kTriangle, kNeighbor}, "solid name").substr(0, 150);
  expect_malformed("a.stl", cut, "NUL byte", "not a binary STL", "184 bytes for the 2 facets of its header");
  const std::string no_solid = binary_stl({kTriangle, kNeighbor}, "name").substr(0, 150);
  expect_malformed("a.stl", no_solid, "not a binary STL", "184 bytes");
}

// M13
TEST(Stl, TextOfAnyCaseAndAnyNumberOfSolids) {
  const std::string upper =
      "SOLID A b c\nFacet Normal 0 0 1 OUTER LOOP VERTEX 0 0 0 Vertex 1 0 0 vertex 0 1 0 EndLoop\n"
      "ENDFACET EndSolid A b c\n";
  const auto mesh = read("a.stl", upper + "solid empty\nendsolid\nsolid\n" + facet(kStlVertices) + "endsolid\n");
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 0, 1, 2));
  EXPECT_TRUE(mesh.warnings.empty());
  expect_malformed("a.stl", "solid\nface\n", "a.stl:2:1", "found 'face'");
}

// M13
TEST(Stl, EndAsAWordOfItsOwnIsAWarning) {
  const std::string file = "solid a\nfacet normal 0 0 1\nouter loop\n" + kStlVertices +
                           "end loop\nEnd Facet\nend solid a\nsolid b\nend solid\n";
  const auto mesh = read("a.stl", file);
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2));
  EXPECT_EQ(warned(mesh, "'end' is a word of its own"), 4U);
  EXPECT_EQ(mesh.warnings.size(), 1U);
  EXPECT_TRUE(refusal("a.stl", file, {.strict = true}).refused);
  expect_malformed("a.stl", "solid\nend of it\n", "a.stl:2:5", "'facet'", "found 'of'");
  expect_malformed("a.stl", "solid\nend facet\n", "expected 'facet', 'endsolid' or 'solid'");
}

TEST(Stl, TextWithoutFacetsIsAnEmptyMesh) {
  for (const std::string text :
       {"solid\nendsolid\n", "solid name\nendsolid name\n", "solid a\nendsolid a\nsolid b\nendsolid b\n"}) {
    const auto mesh = read("a.stl", text);
    EXPECT_EQ(vertex_count(mesh), 0U) << text;
    EXPECT_EQ(face_count(mesh), 0U) << text;
    EXPECT_TRUE(mesh.warnings.empty()) << text;
  }
  for (const std::string text : {"solid\n", "solid advice for meshes\n"}) {
    expect_malformed("a.stl", text, "expected 'facet' or 'endsolid', but the file ends");
  }
}

// M13
TEST(Stl, FacetsOfOtherThanThreeVertices) {
  const std::string quad = "vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n";
  const auto mesh = read(
      "a.stl", "solid\n" + facet(kStlVertices) + facet("vertex 9 9 9\nvertex 8 8 8\n") + facet(quad) + "endsolid\n");
  EXPECT_THAT(mesh.offsets, ElementsAre(0, 3, 7));
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 0, 1, 3, 2));
  EXPECT_EQ(vertex_count(mesh), 4U) << "the facet that is left out leaves no vertex";
  EXPECT_EQ(warned(mesh, "fewer than three"), 1U);
  EXPECT_EQ(warned(mesh, "more than three"), 1U);
}

// M14
TEST(Stl, CornersAreWeldedByExactEquality) {
  const float next = std::nextafter(1.F, 2.F);
  const auto mesh = read("a.stl", binary_stl({{-0.F, 0, 0, 1, 0, 0, 0, 1, 0},
                                              {0.F, -0.F, 0, 0, 1, -0.F, next, 0, 0},
                                              {1, 0, 0, 1, 0, 0, 0, 0, 0}}));
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 0, 2, 3, 1, 1, 0));
  EXPECT_EQ(vertex_count(mesh), 4U);
  EXPECT_TRUE(std::signbit(floats(mesh)[0])) << "the bits of the first appearance stay";
  EXPECT_EQ(warned(mesh, "two corners coincide"), 1U);
}

// The reference: an ordered map from positions to ids.
std::vector<std::uint32_t> welded_by_map(const std::vector<std::array<float, 9>>& triangles) {
  std::map<std::array<float, 3>, std::uint32_t> ids;
  std::vector<std::uint32_t> corners;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 9; i += 3) {
      corners.push_back(
          ids.try_emplace({t[i], t[i + 1], t[i + 2]}, static_cast<std::uint32_t>(ids.size())).first->second);
    }
  }
  return corners;
}

// M14
TEST(Stl, WeldingOfManyCornersEqualsAnOrderedMap) {
  std::mt19937 random(14);
  std::size_t corners = 0;
  for (const int range : {1, 20, 90, 100000}) {
    std::vector<std::array<float, 9>> triangles(scaled(150'000, 70'000));
    const int middle = range / 2;
    for (auto& triangle : triangles) {
      for (float& number : triangle)
        number = static_cast<float>(static_cast<int>(random() % static_cast<unsigned>(range)) - middle);
    }
    const auto mesh = read("a.stl", binary_stl(triangles));
    EXPECT_EQ(mesh.corners, welded_by_map(triangles)) << range;
    const auto exact = read("a.stl", binary_stl(triangles), {.precision = io::Precision::Double});
    EXPECT_EQ(exact.corners, mesh.corners) << range;
    corners += mesh.corners.size();
  }
  std::printf("%zu corners welded in each precision as a map does it\n", corners);
}

// M17
TEST(Stl, CoordinatesMustBeFinite) {
  auto triangle = kTriangle;
  triangle[4] = std::numeric_limits<float>::infinity();
  expect_malformed("a.stl", binary_stl({kNeighbor, triangle}), "a.stl@162", "facet 1, vertex 1, y is not finite");
  for (const std::string word : {"nan", "-inf", "1e151", "1,5", "0x1p3", "1.#QNAN"}) {
    expect_malformed("a.stl", "solid\n" + facet("vertex 0 0 " + word + "\n"), "a.stl:4:12",
                     "facet 0, vertex 0, z = '" + word + "' is ");
  }
  EXPECT_EQ(face_count(read("a.stl", "solid\nfacet normal nan nan nan\nouter loop\n" + kStlVertices +
                                         "endloop\nendfacet\nendsolid")),
            1U);
}

}  // namespace
}  // namespace meshhood::test
