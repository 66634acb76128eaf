// SPDX-License-Identifier: MIT
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"

// The triangle file of FreeSurfer.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;

const std::string kHead =
    "\xff\xff\xfe"
    "created by a program on a day\n\n";
const std::string kPositions = big(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 0.1F, -1.F);

std::string surface(int vertices, int faces, const std::string& corners) {
  return kHead + big(vertices, faces) + kPositions + corners;
}

TEST(FreeSurfer, ASurfaceIsRead) {
  for (const std::string name : {"lh.white", "a.stl"}) {
    const auto mesh = read(name, surface(3, 2, big(0, 1, 2, 2, 1, 0)));
    EXPECT_EQ(mesh.format, io::Format::FreeSurfer);
    EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 0, 0.1F, -1));
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 2, 1, 0));
    EXPECT_TRUE(mesh.offsets.empty());
    EXPECT_TRUE(mesh.warnings.empty());
  }
}

TEST(FreeSurfer, ACenterThatIsNotAddedIsAWarning) {
  const std::string file = surface(3, 1, big(0, 1, 2)) + big(20) + "valid = 1\nvoxelsize = 1 1 1\ncras   = ";
  EXPECT_TRUE(read("lh.white", file + "0.0 0 0\n").warnings.empty());
  for (const bool strict : {false, true}) {
    const auto mesh = read("lh.white", file + "0.0 -17.5 20\nmore = 1\n", {.strict = strict});
    EXPECT_EQ(warned(mesh, "the center of the scan, 'cras   = 0.0 -17.5 20', is not added"), 1U);
  }
}

TEST(FreeSurfer, TruncationAtAnyByteIsRefused) {
  const std::string whole = surface(3, 1, big(0, 1, 2));
  expect_malformed("lh.white", kHead, "the file ends in the number of vertices");
  expect_malformed("lh.white", kHead + big(3), "the file ends in the number of faces");
  for (std::size_t length = 3; length < whole.size(); ++length) {
    EXPECT_TRUE(refusal("lh.white", whole.substr(0, length)).refused) << length;
  }
}

TEST(FreeSurfer, WrongNumbersAreRefusedByPlace) {
  const std::size_t corners = kHead.size() + 8 + kPositions.size();
  expect_malformed("lh.white", surface(2000000000, 1, ""), "2000000000 vertices and 1 faces", "bytes are left");
  expect_malformed("lh.white", surface(-1, 1, big(0, 1, 2)), "-1 vertices");
  for (const int wrong : {-1, 3}) {
    expect_malformed("lh.white", surface(3, 1, big(0, 1, wrong)),
                     "lh.white@" + std::to_string(corners + 8) + ": face 0, corner 2 = " + std::to_string(wrong) +
                         ", but there are 3 vertices");
  }
  expect_malformed("lh.white", kHead + big(1, 0, 0.F, std::numeric_limits<float>::infinity(), 0.F),
                   "vertex 0, y is not finite");
}

}  // namespace
}  // namespace meshhood::test
