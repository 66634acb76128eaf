// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"

// OBJ files: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// M3
TEST(Obj, ATruncatedVertexOrIndexIsRefused) {
  expect_malformed("a.obj", kSquare + "v 1 2", "a.obj:5:6", "vertex 5 has no z");
  expect_malformed("a.obj", kSquare + "f 1 2 /", "a.obj:5:7", "corner 3", "'/'");
  EXPECT_EQ(face_count(read("a.obj", kSquare + "f 1 2 3")), 1U);  // no newline at the end
}

// M6
TEST(Obj, IndicesOutOfRangeAreRefusedByFaceAndCorner) {
  for (const std::string index : {"5", "2147483648", "4294967295", "4294967296", "9223372036854775807"}) {
    expect_malformed("a.obj", kSquare + "f 1 2 3\nf 1 2 " + index + "\n",
                     "a.obj:6:7: face 2, corner 3 = " + index + ", but there are 4 vertices");
  }
  expect_malformed("a.obj", kSquare + "f 1 2 99999999999999999999\n", "is not a vertex index");
  // A face may precede its vertices.
  EXPECT_THAT(read("a.obj", "f 1 2 4\n" + kSquare).corners, ElementsAre(0, 1, 3));
  expect_malformed("a.obj", "f 1 2 6\nf 1 2 5\n" + kSquare, "a.obj:1:7: face 1, corner 3 = 6");
}

// M7
TEST(Obj, Index0IsRefused) {
  expect_malformed("a.obj", kSquare + "f 0 1 2\n", "a.obj:5:3: face 1, corner 1 = 0");
  expect_malformed("a.obj", kSquare + "f 1 -0 2\n", "corner 2 = 0");
}

// M8
TEST(Obj, NegativeIndicesCountFromTheVerticesSoFar) {
  const auto mesh = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -4\n");
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 3, 2, 0));
  expect_malformed("a.obj", "v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", "a.obj:3:9: face 1, corner 3 = -3");
  expect_malformed("a.obj", kSquare + "f -9223372036854775808 1 2\n", "-9223372036854775808");
}

// M9
TEST(Obj, EveryFormOfACornerIsRead) {
  const std::string attributes = "vt 0 0\nvn 0 0 1\n";
  for (const std::string corner : {"", "/1", "//1", "/1/1", "/", "//", "/-1/-1"}) {
    std::string face = "f";
    for (const char vertex : {'1', '2', '3', '4'}) face += std::string(" ") + vertex + corner;
    const auto mesh = read("a.obj", kSquare + attributes + face + "\n");
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 3)) << face;
    EXPECT_THAT(mesh.offsets, ElementsAre(0, 4)) << face;
  }
  for (const std::string corner : {"1/2/3/4", "1/x", "/1", "1.0", "1//1.5", "1,2"}) {
    expect_malformed("a.obj", kSquare + "f 1 2 " + corner + "\n", "a.obj:5:7", "'" + corner + "'");
  }
}

// M9
TEST(Obj, ThreeToSevenNumbersMakeAVertex) {
  for (const std::string rest : {"", " 1", " 0.5 0.5", " 0.5 0.5 0.5", " 1 nan nan nan"}) {
    const auto mesh = read("a.obj", "v 1 2 3" + rest + "\n");
    EXPECT_THAT(floats(mesh), ElementsAre(1, 2, 3)) << rest;
    EXPECT_TRUE(mesh.warnings.empty()) << rest;
  }
  EXPECT_EQ(warned(read("a.obj", "v 1 2 3 0.5\nv 1 2 3 2 1 1 1\n"), "weights"), 2U);
  expect_malformed("a.obj", "v 1 2\n", "vertex 1 has no z, expected x y z");
  expect_malformed("a.obj", "v 1 2 3 4 5 6 7 8\n", "more than 7 numbers");
  expect_malformed("a.obj", "v 1 2 3 red\n", "'red'");
}

// M9
TEST(Obj, ContinuationLinesAndVerticalTabs) {
  const auto mesh = read("a.obj", "v 0 0 \\\n 0\nv 1\v0\f0\nv 1 1\\\r\n0\nf 1 \\\n\\\n2 3\n# C:\\path\\\nv 7 7 7\n");
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2));
  EXPECT_EQ(vertex_count(mesh), 4U);
  EXPECT_TRUE(mesh.warnings.empty());
}

// M9
TEST(Obj, ALineOfAnyLengthUpTo64MiB) {
  std::string longest = "f";
  while (longest.size() < 3'000'000) longest += " 1 2 3 4";
  const auto mesh = read("a.obj", kSquare + longest + "\n");
  EXPECT_EQ(mesh.corners.size(), (longest.size() - 1) / 2);
  EXPECT_EQ(face_count(mesh), 1U);

  const std::string comment(std::size_t{64} << 20, '#');
  EXPECT_EQ(vertex_count(read("a.obj", "v 1 2 3\n" + comment.substr(8) + "\nv 1 2 3\n")), 2U);
  expect_malformed("a.obj", "v 1 2 3\n" + comment + "#\n", "a.obj:2:", "67108864 bytes");
}

// M9
TEST(Obj, OtherStatementsAreSkippedAndCounted) {
  const auto mesh =
      read("a.obj", "o thing\ng f 1 2 3\ns off\nusemtl f\n" + kSquare +
                        "vp 0.1\nl 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nend\nsurface \\\n f 1 2 3\nfo 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(face_count(mesh), 1U);
  EXPECT_EQ(warned(mesh, "'l'"), 2U);
  EXPECT_EQ(warned(mesh, "'p'"), 1U);
  EXPECT_EQ(warned(mesh, "'vp'"), 1U);
  EXPECT_EQ(warned(mesh, "'curv'"), 1U);
  EXPECT_EQ(warned(mesh, "unknown statements"), 2U);
  EXPECT_TRUE(refusal("a.obj", kSquare + "l 1 2\n", {.strict = true}).refused);
  expect_malformed("a.obj", "once upon a time\n", "no OBJ statement");
}

// M9
TEST(Obj, FacesOfFewCorners) {
  const auto mesh = read("a.obj", kSquare + "f\nf 1\nf 1 2\nf 1 2 3\n");
  EXPECT_THAT(mesh.offsets, ElementsAre(0, 1, 3, 6));
  EXPECT_EQ(warned(mesh, "faces without corners"), 1U);
}

// M10
TEST(Obj, NoSecondFileIsOpenedAndNothingIsRun) {
  const auto trace = std::filesystem::temp_directory_path() / "meshhood_obj_m10";
  std::filesystem::remove(trace);
  const auto mesh = read("a.obj", "mtllib ../../etc/passwd\ncall other.obj\ncsh touch " + trace.string() +
                                      "\ncsh -touch " + trace.string() + "\n" + kSquare + "f 1 2 3\n");
  EXPECT_EQ(face_count(mesh), 1U);
  EXPECT_EQ(warned(mesh, "'call'"), 1U);
  EXPECT_EQ(warned(mesh, "'csh'"), 2U);
  EXPECT_FALSE(std::filesystem::exists(trace));
}

// M21
TEST(Obj, APolygonOf100000CornersIsOneFace) {
  std::string file;
  std::string face = "f";
  for (int i = 1; i <= 100000; ++i) {
    file += "v " + std::to_string(i) + " 0 0\n";
    face += " " + std::to_string(i);
  }
  const auto mesh = read("a.obj", file + face);
  EXPECT_THAT(mesh.offsets, ElementsAre(0, 100000));
  EXPECT_EQ(mesh.corners.at(99999), 99999U);
}

}  // namespace
}  // namespace meshhood::test
