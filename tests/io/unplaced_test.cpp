// SPDX-License-Identifier: MIT
// Vertices without a position, as scanners and depth cameras mark holes: walls if no face has them, otherwise an error.
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"
#include "support/refusal.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string ply(const std::string& encoding, int vertices, const std::string& type, const std::string& rows) {
  std::string text = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", encoding, vertices);
  for (const char axis : {'x', 'y', 'z'}) text += fmt::format("property {} {}\n", type, axis);
  return text + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + rows;
}

struct Scan {
  std::string name;
  std::string content;
  std::string place;   // of vertex 2
  std::string first;   // its number in messages
  std::string corner;  // where the refused file has it
};

/// Vertices 0, 2 and 5 have no position, and the face is 1 3 4; or, of a `wrong` one, 1 2 4.
std::vector<Scan> scans(bool wrong) {
  const std::string rows = "nan nan nan\n1 2 3\n0 NaN 0\n4 2 3\n1 5 3\nnan nan -nan\n";
  const std::string face = wrong ? "3 1 2 4\n" : "3 1 3 4\n";
  const std::string obj_rows = "v nan nan nan\nv 1 2 3\nv 0 NaN 0\nv 4 2 3\nv 1 5 3\nv nan nan -nan\n";
  const std::string little_rows =
      little(kNan, kNan, kNan, 1.F, 2.F, 3.F, 0.F, kNan, 0.F, 4.F, 2.F, 3.F, 1.F, 5.F, 3.F, kNan, kNan, -kNan) +
      std::string(1, '\3') + little(1, wrong ? 2 : 3, 4);
  const std::string big_rows =
      big(kNan, kNan, kNan, 1.F, 2.F, 3.F, 0.F, kNan, 0.F, 4.F, 2.F, 3.F, 1.F, 5.F, 3.F, kNan, kNan, -kNan);
  const std::string vtk = "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n" + rows;
  const std::string freesurfer =
      "\xff\xff\xfe"
      "a\n\n";
  return {
      {"text.ply", ply("ascii", 6, "float", rows + face), "text.ply:12:", "0", "face 0 has it as corner 1"},
      {"double.ply", ply("ascii", 6, "double", rows + face), "double.ply:12:", "0", "face 0 has it as corner 1"},
      {"little.ply", ply("binary_little_endian", 6, "float", little_rows), "little.ply@", "0", "corner 1"},
      {"big.ply", ply("binary_big_endian", 6, "float", big_rows + std::string(1, '\3') + big(1, wrong ? 2 : 3, 4)),
       "big.ply@", "0", "corner 1"},
      {"a.off", "OFF\n6 1 0\n" + rows + face, "a.off:5:", "0", "face 0 has it as corner 1"},
      {"a.obj", obj_rows + (wrong ? "f 2 3 5\n" : "f 2 4 5\n"), "a.obj:3:", "1", "face 1 has it as corner 2"},
      {"a.vtk", vtk + "POLYGONS 1 4\n" + face, "a.vtk:8:", "0", "face 0 has it as corner 1"},
      {"lh.white", freesurfer + big(6, 1) + big_rows + big(1, wrong ? 2 : 3, 4), "lh.white@", "0", "corner 1"},
  };
}

TEST(VertexWithoutPosition, IsAWallAtAnotherVertexWithOneWarning) {
  for (const Scan& scan : scans(false)) {
    SCOPED_TRACE(scan.name);
    const io::Mesh mesh = read(scan.name, scan.content);
    EXPECT_THAT(mesh.walls, ElementsAre(1, 0, 1, 0, 0, 1));
    EXPECT_THAT(mesh.corners, ElementsAre(1, 3, 4));
    std::visit(
        [](const auto& xyz) { EXPECT_THAT(xyz, ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 2, 3, 1, 5, 3, 1, 2, 3)); },
        mesh.positions);
    ASSERT_EQ(mesh.warnings.size(), 1U);
    EXPECT_EQ(mesh.warnings[0].count, 3U);
    EXPECT_THAT(mesh.warnings[0].what, ::testing::HasSubstr("the first of which is " + scan.first));
    EXPECT_THAT(mesh.warnings[0].first_place, ::testing::Not(IsEmpty()));
    EXPECT_EQ(refusal(scan.name, scan.content, {.strict = true}).code, ErrorCode::MalformedFile);
  }
}

TEST(VertexWithoutPosition, OfAFaceIsRefusedWithFaceCornerVertexAndPlace) {
  for (const Scan& scan : scans(true)) {
    const std::string vertex = scan.first == "0" ? "vertex 2 has no position" : "vertex 3 has no position";
    expect_malformed(scan.name, scan.content, scan.place, vertex, scan.corner);
  }
}

TEST(VertexWithoutPosition, IsWrittenAsOneAndReadAgain) {
  const io::Mesh mesh = read("a.off", "OFF\n4 1 0\nnan 1 2\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n");
  const Scratch scratch;
  const auto expect_same = [&](const char* name) {
    const io::Mesh again = io::read_mesh(scratch.path() / name);
    EXPECT_EQ(again.walls, mesh.walls) << name;
    EXPECT_EQ(again.positions, mesh.positions) << name;
    EXPECT_EQ(again.corners, mesh.corners) << name;
  };
  io::write_ply(scratch.path() / "binary.ply", mesh.view(), {.walls = mesh.walls});
  io::write_ply(scratch.path() / "text.ply", mesh.view(), {.walls = mesh.walls, .ascii = true});
  io::write_vtk(scratch.path() / "a.vtk", mesh.view(), {.walls = mesh.walls});
  for (const char* name : {"binary.ply", "text.ply", "a.vtk"}) expect_same(name);
}

TEST(VertexWithoutPosition, OfAFaceIsNotWritten) {
  const Scratch scratch;
  const io::Mesh mesh = read("a.off", "OFF\n4 1 0\n1 1 2\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n");
  const std::vector<std::uint8_t> used{0, 0, 1, 0};
  const std::vector<std::uint8_t> few{0, 0, 1};
  expect_refused(ErrorCode::InvalidMesh, "vertex 2 has no position (NaN), but face 0 has it as corner 1",
                 [&] { io::write_vtk(scratch.path() / "a.vtk", mesh.view(), {.walls = used}); });
  expect_refused(ErrorCode::InvalidOption, "3 walls, expected one for each of 4 vertices",
                 [&] { io::write_ply(scratch.path() / "a.ply", mesh.view(), {.walls = few}); });
}

TEST(VertexWithoutPosition, MayBeEveryVertex) {
  const io::Mesh mesh = read("a.off", "OFF\n2 0 0\nnan nan nan\nnan 0 0\n");
  EXPECT_THAT(mesh.walls, ElementsAre(1, 1));
  EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST(VertexWithoutPosition, LeavesThePrecisionToTheOthers) {
  EXPECT_TRUE(std::holds_alternative<std::vector<float>>(read("a.off", "OFF\n2 0 0\n0.1 0 0\nnan 0 0\n").positions));
  EXPECT_TRUE(
      std::holds_alternative<std::vector<double>>(read("a.off", "OFF\n2 0 0\n0.12345678901 0 0\nnan 0 0\n").positions));
}

TEST(VertexWithoutPosition, IsNoneThatIsInfinite) {
  expect_malformed("a.off", "OFF\n2 0 0\n0 0 0\nnan inf 0\n", "a.off:4:5", "is not finite");
}

TEST(VertexWithoutPosition, HasNoLocationIfThereAreTooMany) {
  constexpr int kMost = 1 << 18;
  std::string rows;
  for (int i = 0; i <= kMost; ++i) rows += little(kNan, kNan, kNan);
  const std::string content = ply("binary_little_endian", kMost + 1, "float", rows + std::string(1, '\1'));
  EXPECT_EQ(refusal("a.ply", content + little(kMost)).message,
            "a.ply: vertex 262144 has no position (NaN), but face 0 has it as corner 0");
  expect_malformed("a.ply", content + little(kMost - 1), "a.ply@", "vertex 262143 has");
}

TEST(VertexWithoutPosition, IsRefusedByWhatStoresNoWalls) {
  const io::Mesh mesh = read("a.off", "OFF\n3 0 0\n0 0 0\nnan 0 0\nnan 0 0\n");
  try {
    io::refuse_walls(mesh, "a.off");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidMesh);
    EXPECT_THAT(error.what(), ::testing::HasSubstr("a.off: vertex 1 has no position"));
  }
  io::refuse_walls(read("a.off", "OFF\n1 0 0\n0 0 0\n"), "a.off");
}

}  // namespace
}  // namespace meshhood::test
