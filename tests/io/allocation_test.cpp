// SPDX-License-Identifier: MIT
// Each allocation fails once while a file is read or written (R2). The old file is kept, and no temporary file remains.
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"
#include "meshhood/index.h"
#include "meshhood/paper.h"

#include "io/index_io.h"
#include "io/mesh_io.h"
#include "io/weld.h"
#include "shapes/shapes.h"
#include "support/failing_allocations.h"
#include "support/hostile.h"
#include "support/index_bytes.h"
#include "support/save_trial.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

/// Large enough for every array to grow several times.
const shapes::Shape& grid() {
  static const shapes::Shape shape = shapes::find_kind("grid")->make(2500);
  return shape;
}

std::string triangles_of_grid(std::string_view before, std::size_t first_id) {
  std::string text;
  const auto& corners = grid().corners;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    text += fmt::format("{}{} {} {}\n", before, corners[i] + first_id, corners[i + 1] + first_id,
                        corners[i + 2] + first_id);
  }
  return text;
}

std::string vertices_of_grid(std::string_view before) {
  std::string text;
  const auto& xyz = grid().positions;
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    text += fmt::format("{}{} {} {}\n", before, xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return text;
}

std::string obj_of_grid() { return vertices_of_grid("v ") + triangles_of_grid("f ", 1); }

std::string off_of_grid() {
  return fmt::format("OFF\n{} {} 0\n", grid().positions.size() / 3, grid().corners.size() / 3) + vertices_of_grid("") +
         triangles_of_grid("3 ", 0);
}

std::string stl_of_grid() {
  std::vector<std::array<float, 9>> triangles(grid().corners.size() / 3);
  for (std::size_t i = 0; i < grid().corners.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      triangles[i / 3][i % 3 * 3 + axis] = grid().positions[3 * std::size_t{grid().corners[i]} + axis];
    }
  }
  return binary_stl(triangles);
}

std::string vtk_of_grid() {
  const std::size_t triangles = grid().corners.size() / 3;
  return fmt::format("# vtk DataFile Version 3.0\ngrid\nASCII\nDATASET POLYDATA\nPOINTS {} float\n",
                     grid().positions.size() / 3) +
         vertices_of_grid("") + fmt::format("POLYGONS {} {}\n", triangles, 4 * triangles) + triangles_of_grid("3 ", 0);
}

std::string freesurfer_of_grid() {
  std::string bytes = "\xff\xff\xfe\n\n" +
                      big(static_cast<int>(grid().positions.size() / 3), static_cast<int>(grid().corners.size() / 3));
  for (const float x : grid().positions) bytes += big(x);
  for (const std::uint32_t corner : grid().corners) bytes += big(corner);
  return bytes;
}

/// The result of reading a file: a mesh, or an error that is not about memory.
struct Reading {
  std::optional<io::Mesh> mesh;
  std::optional<ErrorCode> refused;

  void read(const std::filesystem::path& path) {
    try {
      mesh = io::read_mesh(path);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::TooLarge) throw;
      refused = error.code();
    }
  }
};

bool same(const Reading& a, const Reading& b) {
  if (a.refused != b.refused || a.mesh.has_value() != b.mesh.has_value()) return false;
  return !a.mesh || (a.mesh->positions == b.mesh->positions && a.mesh->offsets == b.mesh->offsets &&
                     a.mesh->corners == b.mesh->corners && a.mesh->warnings.size() == b.mesh->warnings.size());
}

class ReadAllocation : public testing::Test {
 protected:
  /// Reads each file of the fuzzing corpus of a format, which covers all variants and faults.
  void read_corpus(const std::string& format) {
    for (const auto& file : std::filesystem::directory_iterator(MESHHOOD_CORPUS "/" + format)) read(file.path());
  }

  void read(const std::filesystem::path& path) {
    SCOPED_TRACE(path.filename());
    Reading expected;
    expected.read(path);
    shortages.fail_each([] { return Reading(); }, [&](Reading& reading) { reading.read(path); },
                        [&](const Reading& reading, Ending ending) {
                          EXPECT_TRUE(same(reading, ending == Ending::Well ? expected : Reading()));
                        });
  }

  Scratch scratch;
  Shortages shortages;
};

TEST_F(ReadAllocation, FailsInPly) {
  read_corpus("ply");
  for (const bool ascii : {false, true}) {
    const auto path = scratch.path() / "grid.ply";
    io::write_ply(path, grid().view(), {.ascii = ascii});
    read(path);
  }
}

TEST_F(ReadAllocation, FailsInOtherFormats) {
  const std::map<std::string, std::string> files{{"obj", obj_of_grid()},
                                                 {"off", off_of_grid()},
                                                 {"stl", stl_of_grid()},
                                                 {"vtk", vtk_of_grid()},
                                                 {"freesurfer", freesurfer_of_grid()}};
  for (const auto& [format, content] : files) {
    read_corpus(format);
    read(scratch.write("grid." + format, content));
  }
  const auto binary = scratch.path() / "binary.vtk";
  io::write_vtk(binary, grid().view());
  read(binary);
}

TEST_F(ReadAllocation, FailsInWelding) {
  for (const double eps : {0.0, 1e-3}) {
    const auto weld = [eps] { return io::weld(grid().view(), eps).ids; };
    const std::vector<std::uint32_t> expected = weld();
    shortages.fail_each([] { return std::optional<std::vector<std::uint32_t>>(); }, [&](auto& ids) { ids = weld(); },
                        [&](const auto& ids, Ending ending) {
                          EXPECT_EQ(ids.has_value(), ending == Ending::Well);
                          EXPECT_TRUE(!ids || *ids == expected);
                        });
  }
}

TEST_F(ReadAllocation, FailsInTheFileOfAnIndex) {
  const auto path = scratch.path() / "grid.mhi";
  const auto expect_made = [&](const auto& index, auto&& load) {
    using AnyIndex = std::decay_t<decltype(index)>;
    const std::vector<std::byte> bytes = saved(index);
    io::save(path, index);
    shortages.fail_each([] { return std::optional<AnyIndex>(); },
                        [&](std::optional<AnyIndex>& made) { made = load(path); },
                        [&](const std::optional<AnyIndex>& made, Ending ending) {
                          ASSERT_EQ(made.has_value(), ending == Ending::Well);
                          EXPECT_TRUE(!made || saved(*made) == bytes);
                        });
  };
  const Index index = build(grid().view());
  expect_made(index, [](const auto& file) { return io::load(file); });
  expect_made(index, [](const auto& file) { return io::map(file); });
  expect_made(paper::build(grid().view()), [](const auto& file) { return io::load_paper(file); });
}

/// Replaces the old version by the new one, for every function that writes a file.
class SaveAllocation : public SaveTrial {};

TEST_P(SaveAllocation, LeavesTheOldFile) {
  struct Nothing {};
  Shortages shortages;
  for (const Version before : {Version::Old, Version::None}) {
    const auto prepare = [&] {
      restore(before);
      return Nothing();
    };
    shortages.fail_each(
        prepare, [&](Nothing&) { save(Version::New); },
        [&](Nothing&, Ending ending) {
          EXPECT_EQ(held(), ending == Ending::Well ? Version::New : before);
          EXPECT_EQ(remove_leftovers(), 0U);
        });
  }
}

MESHHOOD_TRY_ALL_SAVERS(SaveAllocation);

}  // namespace
}  // namespace meshhood::test
