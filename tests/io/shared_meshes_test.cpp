// SPDX-License-Identifier: MIT
#include "support/shared_meshes.h"

#include <cstddef>
#include <cstdio>
#include <map>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

#include "io/mesh_io.h"

namespace meshhood::test {
namespace {

struct Expectation {
  std::optional<std::size_t> vertices;
  std::optional<std::size_t> faces;
  std::string reason;
};

// Files for which our rules differ from the reader of the manifest.
const std::map<std::string, Expectation>& rulings() {
  static const std::map<std::string, Expectation> list = {
      {"broken/box_UTF16BE.obj", {{}, {}, "M18: UTF-16 is refused by name"}},
      {"broken/invalid-relative-texture-index.obj", {{}, {}, "M6: indices of vertices that do not exist"}},
      {"broken/float_inf_point_cloud.ply", {{}, {}, "M17: infinite coordinates"}},
      {"broken/delim_test.ply", {24, 8, "M18: a header whose lines end in CR alone"}},
      {"broken/multiWordName.bin.stl",
       {{}, {}, "M4: damaged, so that facets seem to be followed by bytes of their own"}},
      {"broken/no_facet_ascii.stl", {0, 0, "an STL text without facets is an empty mesh"}},
      {"scan/brain_tristrips.ply", {18844, 36752, "M12: triangle strips are faces"}},
  };
  return list;
}

// "3: 32, 4: 468"; "3" if all faces are triangles, "-" if there are none.
std::string sides_of(const io::Mesh& mesh) {
  std::map<std::size_t, std::size_t> count;
  mesh.view().faces.for_each([&count](std::size_t, std::span<const VertexId> corners) { ++count[corners.size()]; });
  if (count.empty()) return "-";
  if (count.size() == 1 && count.contains(3)) return "3";
  std::string text;
  for (const auto& [sides, faces] : count) {
    text += (text.empty() ? "" : ", ") + std::to_string(sides) + ": " + std::to_string(faces);
  }
  return text;
}

struct Tally {
  std::size_t read = 0;
  std::size_t refused = 0;
  std::size_t ruled = 0;
  std::size_t sides = 0;
};

void judge(const ManifestRow& row, const Expectation& expected, Tally& tally) {
  try {
    const auto mesh = shared_mesh(row.file);
    ++tally.read;
    ASSERT_TRUE(expected.vertices) << "read, but should be refused: " << mesh.view().positions.size() << " vertices, "
                                   << mesh.view().faces.size() << " faces";
    EXPECT_EQ(mesh.view().positions.size(), *expected.vertices);
    EXPECT_EQ(mesh.view().faces.size(), *expected.faces);
    validate(mesh.view());
    const bool lists_sides = row.sides == "3" || row.sides.find(':') != std::string::npos;
    // We keep a facet of four vertices as a polygon; the reader of the manifest made a triangle of it.
    const bool cut = row.file == "broken/quad.ascii.stl" || row.file == "broken/toomanyvertices.stl";
    if (lists_sides && !cut) {
      EXPECT_EQ(sides_of(mesh), row.sides);
      ++tally.sides;
    }
  } catch (const Error& error) {
    ++tally.refused;
    EXPECT_FALSE(expected.vertices) << error.what();
    std::printf("  refused: %s\n", error.what());
  }
}

TEST(SharedMeshes, AgreeWithTheManifest) {
  MESHHOOD_NEED_SHARED_MESHES();
  Tally tally;
  const auto rows = read_manifest();
  for (const auto& row : rows) {
    SCOPED_TRACE(row.file);
    const auto ruling = rulings().find(row.file);
    if (ruling != rulings().end()) ++tally.ruled;
    judge(row, ruling != rulings().end() ? ruling->second : Expectation{row.vertices, row.faces, ""}, tally);
  }
  std::printf("%zu files: %zu read, %zu refused, 0 skipped; %zu by a rule of ours; sides of faces compared on %zu\n",
              rows.size(), tally.read, tally.refused, tally.ruled, tally.sides);
  EXPECT_GE(rows.size(), 146U);
  EXPECT_EQ(tally.read + tally.refused, rows.size());
}

}  // namespace
}  // namespace meshhood::test
