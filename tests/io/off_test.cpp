// SPDX-License-Identifier: MIT
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"

// OFF files: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;

const std::string kOffVertices = "0 0 0\n1 0 0\n0 1 0\n";

// M1
TEST(Off, HugeCountsAreRefusedBeforeTheyAllocate) {
  for (const std::string counts :
       {"2000000000 1 0", "3 2000000000 0", "1099511627776 0 0", "18446744073709551615 0 0"}) {
    expect_malformed("a.off", "OFF\n" + counts + "\n" + kOffVertices + "3 0 1 2\n", "a.off:2:", "bytes are left");
  }
  expect_malformed("a.off", "OFF\n999999999999999999999999999999999 0 0\n", "number of vertices");
  expect_malformed("a.off", "OFF\n-1 0 0\n", "'-1'");
}

// M3
TEST(Off, TruncationAtAnyByteIsRefused) {
  expect_truncations_refused("a.off", "OFF\n3 1 0\n" + kOffVertices + "3 0 1 2", 1);
  expect_malformed("a.off", "OFF\n3 1 0\n" + kOffVertices + "3  0  1", "a.off:6:8", "the file ends in face 0 of 1");
}

// M4
TEST(Off, DataAfterTheLastFaceIsAWarning) {
  const std::string file = "OFF\n3 1 0\n" + kOffVertices + "3 0 1 2\n3 2 1 0\n";
  EXPECT_EQ(warned(read("a.off", file), "after the last face"), 1U);
  EXPECT_TRUE(refusal("a.off", file, {.strict = true}).refused);
}

// M5
TEST(Off, WrongFaceCountsAreRefused) {
  expect_malformed("a.off", "OFF 3 1 0\n" + kOffVertices + "-3 0 1 2\n", "face 0 has -3 corners");
  expect_malformed("a.off", "OFF 3 1 0\n" + kOffVertices + "9223372036854775807 0 1 2\n",
                   "the file ends in face 0 of 1");
  expect_malformed("a.off", "OFF 3 1 0\n" + kOffVertices + "3.0 0 1 2\n", "'3.0'");
}

// M6
TEST(Off, IndicesOutOfRangeAreRefusedByFaceAndCorner) {
  for (const std::string index : {"3", "-1", "4294967295", "2147483648", "4294967296"}) {
    expect_malformed("a.off", "OFF 3 1 0\n" + kOffVertices + "3 0 1 " + index + "\n",
                     "a.off:5:7: face 0, corner 2 = " + index + ", but there are 3 vertices");
  }
}

// M15
TEST(Off, AllDocumentedVariantsAreRead) {
  const std::string rest = "# a comment\n3 1 3\n\n";
  const std::string face = "3 0 1 2 255 0 0\n";
  const auto expect_triangle = [](const std::string& file) {
    const auto mesh = read("a.off", file);
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2)) << file;
    EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0)) << file;
    EXPECT_TRUE(mesh.warnings.empty()) << file;
  };
  expect_triangle("OFF\n" + rest + kOffVertices + face);
  expect_triangle("# first\nOFF 3 1 0 # counts\n" + kOffVertices + face);
  expect_triangle("COFF\n" + rest + "0 0 0 1 1 1 1\n1 0 0 0 0 0 1\n0 1 0 1 0 0 1\n" + face);
  expect_triangle("NOFF\n" + rest + "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n" + face);
  expect_triangle("CNOFF\n" + rest + "0 0 0 0 0 1 1 1 1 1\n1 0 0 0 0 1 1 1 1 1\n0 1 0 0 0 1 1 1 1 1\n" + face);
  expect_triangle("STOFF\n" + rest + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n" + face);
  expect_triangle("OFF\n3\n1\n0\n0\n0 0\n1 0\n0\n0 1 0\n3 0\n1 2\n");
}

// M15
TEST(Off, PrefixesMayHaveAnyOrder) {
  for (const std::string keyword : {"NCOFF", "CNOFF", "STNCOFF", "CSTNOFF", "NSTOFF"}) {
    const auto mesh = read("a", keyword + "\n3 1 0\n0 0 0 9 9\n1 0 0 9 9\n0 1 0 9 9\n3 0 1 2\n");
    EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0)) << keyword;
    EXPECT_TRUE(mesh.warnings.empty()) << keyword;
  }
  expect_malformed("a.off", "CCOFF\n3 1 0\n", "'CCOFF'");
  expect_refused("a.off", "4NCOFF\n3 1 0\n", ErrorCode::UnsupportedFormat, "'4NCOFF'");
}

// M15
TEST(Off, TheNumberOfEdgesMayBeMissing) {
  const std::string rest = "1 0 0\n2 0 0\n0 3 0\n3 0 1 2\n";
  for (const std::string& file :
       {"OFF\n3 1\n" + rest, "OFF 3 1 # counts\n\n# vertices\n" + rest, "COFF\n3 1\n" + rest}) {
    const auto mesh = read("a.off", file);
    EXPECT_THAT(floats(mesh), ElementsAre(1, 0, 0, 2, 0, 0, 0, 3, 0)) << file;
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2)) << file;
    EXPECT_EQ(warned(mesh, "no number of edges"), 1U) << file;
    EXPECT_TRUE(refusal("a.off", file, {.strict = true}).refused) << file;
  }
  EXPECT_EQ(read("a.off", "OFF\n3 1\n" + rest).warnings.at(0).first_place, "line 2");
  EXPECT_EQ(vertex_count(read("a.off", "OFF\n0 0")), 0U);
  for (const std::string counts : {"3 1\n0\n", "3\n1 0\n", "3\n1\n0\n", "3 1 0\n"}) {
    const auto mesh = read("a.off", "OFF\n" + counts + rest);
    EXPECT_EQ(floats(mesh).at(0), 1) << counts;
    EXPECT_TRUE(mesh.warnings.empty()) << counts;
  }
}

TEST(Off, TheLineOfCountsHasNoVertex) {
  const std::string rest = "1 0 0\n2 0 0\n0 3 0\n3 0 1 2\n";
  for (const std::string start : {"OFF\n3 1 0 7\n", "OFF 3 1 0 7\n", "OFF\n3 1 0 7 # counts\n"}) {
    expect_malformed("a.off", start + rest, "expected the end of the line of counts, found '7'");
  }
}

TEST(Off, CountsWithoutABlankAfterTheKeywordAreAWarning) {
  const auto mesh = read("a.off", "OFF3 1 0\n" + kOffVertices + "3 0 1 2\n");
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2));
  EXPECT_EQ(vertex_count(mesh), 3U);
  EXPECT_EQ(warned(mesh, "no blank between 'OFF' and the counts"), 1U);
  EXPECT_TRUE(refusal("a.off", "OFF3 1 0\n" + kOffVertices + "3 0 1 2\n", {.strict = true}).refused);
  EXPECT_EQ(vertex_count(read("a", "COFF1 0 0\n0 0 0 1 1 1 1\n")), 1U);
  expect_malformed("a.off", "OFF3x 1 0\n", "expected 'OFF', found 'OFF3x'");
  expect_malformed("a.off", "OFF-3 1 0\n", "expected 'OFF', found 'OFF-3'");
}

// M15
TEST(Off, UnsupportedVariantsAreRefusedByName) {
  for (const std::string keyword : {"4OFF", "nOFF", "C4OFF", "STCN4nOFF"}) {
    expect_refused("a.off", keyword + "\n3 1 0\n", ErrorCode::UnsupportedFormat, "'" + keyword + "'");
  }
  expect_refused("a.off", std::string("OFF BINARY\n\0\0\0\3", 15), ErrorCode::UnsupportedFormat, "'OFF BINARY'");
  expect_malformed("a.off", "3 1 0\n" + kOffVertices + "3 0 1 2\n", "expected 'OFF'");
  expect_malformed("a.off", "FOFF\n3 1 0\n", "'FOFF'");
}

// M15
TEST(Off, ColumnsAfterPlainVerticesAreAWarning) {
  const auto mesh = read("a.off", "OFF 3 1 0\n0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n");
  EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_EQ(warned(mesh, "more than three numbers"), 3U);
}

TEST(Off, SeveralVerticesInALineAreRefused) {
  const std::string reason = "; only one vertex was read from each line with more than three numbers";
  expect_malformed("a.off", "OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n", "the file ends in vertex 2 of 3" + reason);
  expect_malformed("a.off", "OFF\n2 2 0\n0 0 0 1 0 0\n2 0 1\n2 1 0\n", "the file ends in face 1 of 2" + reason);
}

}  // namespace
}  // namespace meshhood::test
