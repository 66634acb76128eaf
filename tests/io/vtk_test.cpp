// SPDX-License-Identifier: MIT
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"
#include "support/scratch.h"

// VTK's legacy format, as this library, VTK, PyVista and meshio write it.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;

const std::string kAscii = "# vtk DataFile Version 4.2\na title\nASCII\nDATASET POLYDATA\n";
const std::string kPoints = "POINTS 4 float\n0 0 0 1 0 0 1 1 0\n0 1 0\n";
const std::string kMixed = "POLYGONS 2 9\n4 0 1 2 3\n3 0 1 2\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

void expect_mixed(const io::Mesh& mesh) {
  EXPECT_EQ(mesh.format, io::Format::Vtk);
  EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0));
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 3, 0, 1, 2));
  EXPECT_THAT(mesh.offsets, ElementsAre(0, 4, 7));
  EXPECT_TRUE(mesh.warnings.empty());
}

const std::string kBinaryPoints = "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 4 float\n" +
                                  big(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F) + "\n";
const std::string kBinaryArrays = "POLYGONS 3 7\nOFFSETS vtktypeint64\n" +
                                  big(std::int64_t{0}, std::int64_t{4}, std::int64_t{7}) +
                                  "\nCONNECTIVITY vtktypeint32\n" + big(0, 1, 2, 3, 0, 1, 2) + "\n";

TEST(Vtk, TextOfAllVersionsIsRead) {
  expect_mixed(read("a.vtk", kAscii + kPoints + kMixed));
  expect_mixed(read("a", kAscii + kPoints + kMixed + "\nPOINT_DATA 4\nSCALARS a float 1\nnonsense\n"));
  expect_mixed(read("a.ply", replaced(kAscii, "4.2", "1.0") + kPoints + "METADATA\nINFORMATION 0\n\n" + kMixed));
  expect_mixed(read("a.vtk", kAscii +
                                 "FIELD FieldData 2\nTIME 1 1 double\n0.5\nMETADATA\nNAME x\n\nb 2 2 int\n1 2 3 4\n" +
                                 kPoints + "VERTICES 0 0\n" + kMixed + "LINES 0 0\n"));
  expect_mixed(read("a.vtk", kAscii + "FIELD FieldData 2\nnames 1 3 string\ntwo words\n\nPOINTS%201\nb 1 1 int\n7\n" +
                                 kPoints + kMixed));
  expect_mixed(read("a.vtk", replaced(kAscii, "4.2", "5.1") + kPoints +
                                 "LINES 1 0\nOFFSETS vtktypeint64\n0\n"
                                 "CONNECTIVITY vtktypeint64\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n0 4 7\n"
                                 "CONNECTIVITY vtktypeint64\n0 1 2 3 0 1\n2\nCELL_DATA 2\n"));
  std::string crlf;
  for (const char c : kAscii + kPoints + kMixed) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  expect_mixed(read("a.vtk", crlf));
}

TEST(Vtk, BytesOfAllVersionsAreRead) {
  expect_mixed(read("a.vtk", kBinaryPoints + kBinaryArrays));
  expect_mixed(read("a.vtk", kBinaryPoints + "METADATA\nINFORMATION 0\n\n" + kBinaryArrays + "POINT_DATA 4\n\0\0"));
  expect_mixed(
      read("a.vtk", replaced(kBinaryPoints, "5.1", "3.0") + "POLYGONS 2 9\n" + big(4, 0, 1, 2, 3, 3, 0, 1, 2) + "\n"));
}

// The first bits of a string say how many bytes its length has.
TEST(Vtk, StringsOfAFieldAreSkipped) {
  const std::string lengths = std::string("\xc3") + "a\nb" + "\x81\x2c" + std::string(300, 'x') + "\xc0" +
                              big(std::int32_t{0x40000002}) + "cd" + big(std::int64_t{1}) + "e";
  const std::string field = "FIELD FieldData 2\nnames 1 5 string\n" + lengths + "\nb 1 1 int\n" + big(7) + "\n";
  const std::string file = replaced(kBinaryPoints, "POINTS", field + "POINTS") + kBinaryArrays;
  expect_mixed(read("a.vtk", file));
  expect_malformed("a.vtk", file.substr(0, file.find("cd") + 1), "the file ends here");
  expect_malformed("a.vtk", kAscii + "FIELD FieldData 1\nnames 1 3 string\na\n", "the file ends here");
}

TEST(Vtk, WhatThisLibraryWritesIsRead) {
  const Scratch scratch;
  const io::Mesh mesh = read("a.vtk", replaced(kAscii + kPoints + kMixed, "1 1 0", "1 1 0.1"));
  const std::vector<float> values(4, 1);
  io::write_vtk(scratch.path() / "a.vtk", mesh.view(), {.properties = {{"a", values}, {"b", values}}});
  const io::Mesh again = io::read_mesh(scratch.path() / "a.vtk");
  EXPECT_EQ(again.positions, mesh.positions);
  EXPECT_EQ(again.corners, mesh.corners);
  EXPECT_EQ(again.offsets, mesh.offsets);
}

TEST(Vtk, DoublesStayDoubles) {
  const auto text = read("a.vtk", kAscii + "POINTS 1 double\n0.1 1e100 -7\n");
  EXPECT_THAT(std::get<std::vector<double>>(text.positions), ElementsAre(0.1, 1e100, -7));
  const auto bytes = read(
      "a.vtk", "# vtk DataFile Version 4.2\n\nBINARY\nDATASET POLYDATA\nPOINTS 1 double\n" + big(0.1, 1e100, -7.0));
  EXPECT_EQ(bytes.positions, text.positions);
}

TEST(Vtk, AGridOfFacesIsRead) {
  const std::string grid =
      replaced(kAscii, "POLYDATA", "UNSTRUCTURED_GRID") + kPoints + "CELLS 2 9\n4 0 1 2 3\n3 0 1 2\n";
  expect_mixed(read("a.vtk", grid + "CELL_TYPES 2\n9\n5\n"));
  expect_refused("a.vtk", grid + "CELL_TYPES 2\n10\n5\n", ErrorCode::UnsupportedFormat,
                 "a.vtk:12:1: cell 0 has type 10", "expected a surface");
  expect_malformed("a.vtk", grid, "the cells have no types, expected CELL_TYPES");
  expect_malformed("a.vtk", grid + "CELL_TYPES 1\n9\n", "1 types of 2 cells");
}

TEST(Vtk, OtherThanPolygonsIsRefusedByName) {
  expect_refused("a.vtk", replaced(kAscii, "POLYDATA", "STRUCTURED_GRID"), ErrorCode::UnsupportedFormat,
                 "a.vtk:4:9: 'structured_grid' is not supported");
  expect_refused("a.vtk", kAscii + kPoints + "TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n", ErrorCode::UnsupportedFormat,
                 "triangle_strips are not supported");
  expect_refused("a.vtk", kAscii + kPoints + "LINES 1 3\n2 0 1\n", ErrorCode::UnsupportedFormat, "lines are not");
  expect_refused("a.vtk", kAscii + "POINTS 1 int\n0 0 0\n", ErrorCode::UnsupportedFormat, "points of type 'int'");
}

TEST(Vtk, TruncationAtAnyByteIsRefused) {
  for (const std::string& file : {kAscii + kPoints + kMixed, kBinaryPoints + kBinaryArrays}) {
    const std::size_t points = file.find("POLYGONS");
    for (std::size_t length = 0; length + 2 < file.size(); ++length) {
      const bool has_points_alone = length == points || length + 1 == points;
      EXPECT_EQ(refusal("a.vtk", file.substr(0, length)).refused, !has_points_alone) << length;
    }
  }
}

TEST(Vtk, HugeCountsAreRefusedBeforeTheyAllocate) {
  for (const std::string count : {"1000000000", "4000000000", "18446744073709551615", "-1", "x"}) {
    EXPECT_TRUE(refusal("a.vtk", kAscii + "POINTS " + count + " float\n0 0 0\n").refused) << count;
    EXPECT_TRUE(refusal("a.vtk", kAscii + kPoints + "POLYGONS 1 " + count + "\n3 0 1 2\n").refused) << count;
    EXPECT_TRUE(refusal("a.vtk", kAscii + kPoints + "POLYGONS " + count + " 4\n3 0 1 2\n").refused) << count;
    EXPECT_TRUE(refusal("a.vtk", kAscii + "FIELD a 1\nb " + count + " " + count + " int\n0\n" + kPoints).refused)
        << count;
  }
  expect_malformed("a.vtk", kAscii + "POINTS 1000 float\n0 0 0\n", "a.vtk:5:13: 3000 coordinates", "bytes are left");
}

TEST(Vtk, WrongNumbersAreRefusedByPlace) {
  expect_malformed("a.vtk", kAscii + "POINTS 2 float\n0 0 0 1 inf 0\n", "a.vtk:6:9: point 1, y = 'inf' is not finite");
  expect_malformed("a.vtk", kAscii + kPoints + "POLYGONS 1 4\n3 0 1 4\n",
                   "a.vtk:9:7: face 0 names vertex 4, but there are 4 vertices");
  expect_malformed("a.vtk", kAscii + kPoints + "POLYGONS 1 4\n4 0 1 2\n", "face 0 has 4 corners");
  expect_malformed("a.vtk", kAscii + kPoints + "POLYGONS 1 5\n3 0 1 2 3\n", "1 more numbers");
  expect_malformed("a.vtk", kAscii + kPoints + "POLYGONS 2 4\n3 0 1 2\n", "1 of 2 cells");
  const std::string offsets = "OFFSETS vtktypeint64\n" + big(std::int64_t{0}, std::int64_t{4}, std::int64_t{7});
  const std::string file = kBinaryPoints + kBinaryArrays;
  const auto with = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    return replaced(file, offsets, "OFFSETS vtktypeint64\n" + big(a, b, c));
  };
  expect_malformed("a.vtk", with(0, 8, 7), "offset 1 = 8, expected");
  expect_malformed("a.vtk", with(0, 4, 3), "offset 2 = 3, expected");
  expect_malformed("a.vtk", with(1, 4, 7), "offset 0 = 1, expected");
  expect_malformed("a.vtk", with(0, 4, 6), "the last offset is 6, expected 7");
  expect_malformed("a.vtk", file.substr(0, file.size() - 5) + big(9),
                   "a.vtk@" + std::to_string(file.size() - 5) + ": corner 6 names vertex 9");
}

}  // namespace
}  // namespace meshhood::test
