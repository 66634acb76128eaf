// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "support/hostile.h"

// More vertices than ids, in a build with 16-bit ids: row M20 of the catalogue.

namespace meshhood::test {
namespace {

static_assert(kMaxVertices == 65534, "this test is for the build with narrow ids");

std::string ply(std::size_t vertices) {
  std::string file = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
                     "\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n";
  return file.append(3 * vertices, '\1');
}

std::string off(std::size_t vertices) {
  std::string file = "OFF\n" + std::to_string(vertices) + " 0 0\n";
  for (std::size_t i = 0; i < vertices; ++i) file += "0 0 0\n";
  return file;
}

std::string obj(std::size_t vertices) {
  std::string file;
  for (std::size_t i = 0; i < vertices; ++i) file += "v 0 0 0\n";
  return file;
}

// Triangles with `vertices` different corners; the last corner is repeated to complete a triangle.
std::string stl(std::size_t vertices) {
  std::vector<std::array<float, 9>> triangles;
  const auto x = [vertices](std::size_t i) { return static_cast<float>(std::min(i, vertices - 1)); };
  for (std::size_t i = 0; i < vertices; i += 3) triangles.push_back({x(i), 0, 0, x(i + 1), 0, 0, x(i + 2), 0, 0});
  return binary_stl(triangles);
}

std::string stl_text(std::size_t vertices) {
  std::string file = "solid\nfacet normal 0 0 1\nouter loop\n";
  for (std::size_t i = 0; i < vertices; ++i) file += "vertex " + std::to_string(i) + " 0 0\n";
  return file + "endloop\nendfacet\nendsolid\n";
}

// M20
TEST(Limits, TheLastVertexThatHasAnIdIsReadAndTheNextIsRefused) {
  const std::vector<std::pair<std::string, std::string (*)(std::size_t)>> formats = {
      {"a.ply", ply}, {"a.off", off}, {"a.obj", obj}, {"a.stl", stl}, {"text.stl", stl_text}};
  for (const auto& [name, file] : formats) {
    SCOPED_TRACE(name);
    EXPECT_EQ(vertex_count(read(name, file(kMaxVertices))), kMaxVertices);
    expect_refused(name, file(kMaxVertices + 1), ErrorCode::TooLarge, "65534");
  }
  std::printf("%zu formats reach the limit and stop after it\n", formats.size());
}

// M20
TEST(Limits, AcceptsMoreCornersThanIds) {
  std::string file = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int face = 0; face < 50000; ++face) file += "f 1 2 3\n";
  const auto mesh = read("a.obj", file + "f 1 2\n");
  EXPECT_EQ(mesh.corners.size(), 150002U);
  EXPECT_EQ(mesh.offsets.back(), 150002U);
}

// M20
TEST(Limits, IndicesAreComparedBeforeTheyAreNarrowed) {
  // 65536 would be narrowed to 0, a valid vertex.
  expect_malformed("a.obj", "v 0 0 0\nf 65537\n", "corner 1 = 65537");
  expect_malformed("a.off", "OFF 1 1 0\n0 0 0\n1 65536\n", "corner 0 = 65536");
}

}  // namespace
}  // namespace meshhood::test
