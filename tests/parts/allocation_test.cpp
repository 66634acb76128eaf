// SPDX-License-Identifier: MIT
// Every allocation of a partition fails once (R2 of docs/reliability.md), and of reading its files. The run throws or
// succeeds without the memory; no temporary file stays, and the next run completes the folder.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "parts/chunked_mesh.h"
#include "parts/manifest.h"
#include "parts/partition.h"
#include "support/failing_allocations.h"
#include "support/families.h"
#include "support/parts_folder.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

namespace fs = std::filesystem;

/// Two parts, of 50 vertices.
class PartitionAllocation : public testing::Test {
 protected:
  void run(const fs::path& target) const { partition(*chunked(mesh), target, {.parts = 2, .halo = 2}); }

  Scratch scratch;
  fs::path folder = scratch.path() / "parts";
  TestMesh mesh = make_grid(5, 10, true).finish(true);
  Shortages shortages;
};

TEST_F(PartitionAllocation, LeavesAFolderThatTheNextRunCompletes) {
  run(scratch.path() / "whole");
  const auto expected = contents(scratch.path() / "whole");
  struct Nothing {};
  const auto prepare = [&] {
    fs::remove_all(folder);
    return Nothing();
  };
  shortages.fail_each(
      prepare, [&](Nothing&) { run(folder); },
      [&](Nothing&, Ending ending) {
        EXPECT_FALSE(fs::exists(folder / ".partition.tmp"));
        EXPECT_EQ(fs::exists(folder / parts::kManifestFile), ending == Ending::Well);
        run(folder);
        EXPECT_EQ(contents(folder), expected);
      });
}

TEST_F(PartitionAllocation, FailsWhereAFolderIsRead) {
  run(folder);
  shortages.fail_each([] { return std::optional<parts::Manifest>(); },
                      [&](auto& manifest) { manifest = parts::read_manifest(folder); },
                      [&](const auto& manifest, Ending ending) {
                        ASSERT_EQ(manifest.has_value(), ending == Ending::Well);
                        EXPECT_TRUE(!manifest || manifest->parts.size() == 2);
                      });
  const parts::Manifest manifest = parts::read_manifest(folder);
  const auto part_folder = folder / parts::part_name(1);
  shortages.fail_each([] { return std::optional<parts::Part>(); },
                      [&](auto& part) {
                        auto found = parts::read_part(part_folder, manifest.plan, 1);
                        static_cast<void>(parts::describe_file(part_folder, parts::kIndexFile));
                        part = std::move(found);
                      },
                      [&](const auto& part, Ending ending) {
                        ASSERT_EQ(part.has_value(), ending == Ending::Well);
                        EXPECT_TRUE(!part || part->owned == manifest.parts[1].owned);
                      });
}

/// The number of corners of a mesh that is read in chunks.
std::size_t count_corners(parts::ChunkedMesh& mesh) {
  std::vector<Point> positions(static_cast<std::size_t>(mesh.vertex_count()));
  mesh.read_positions(0, positions);
  mesh.rewind_faces();
  parts::FaceChunk chunk;
  std::size_t corners = 0;
  while (mesh.read_faces(10, chunk)) corners += chunk.corners.size();
  return corners;
}

class ChunkedAllocation : public PartitionAllocation {
 protected:
  template <class Open>
  void expect_read(Open&& open) {
    shortages.fail_each([] { return std::size_t{0}; }, [&](std::size_t& corners) { corners = count_corners(*open()); },
                        [&](std::size_t corners, Ending ending) {
                          EXPECT_EQ(corners, ending == Ending::Well ? mesh.corners.size() : 0);
                        });
  }

  template <class T>
  fs::path write_array(const std::string& name, const std::vector<T>& values, std::size_t columns) {
    const std::string shape = "(" + std::to_string(values.size() / columns) + ", " + std::to_string(columns) + ")";
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    return scratch.write(name,
                         io::npy_header(io::npy_type<T>(), shape) + std::string(bytes, values.size() * sizeof(T)));
  }
};

TEST_F(ChunkedAllocation, FailsInABinaryPly) {
  const auto file = scratch.path() / "mesh.ply";
  io::write_ply(file, mesh.view());
  expect_read([&] { return parts::open_mesh(file, std::uint64_t{1} << 30); });
}

TEST_F(ChunkedAllocation, FailsInArrays) {
  const std::vector<std::int64_t> corners(mesh.corners.begin(), mesh.corners.end());
  const auto positions = write_array("V.npy", mesh.positions, 3);
  const auto faces = write_array("F.npy", corners, mesh.corners.size() / mesh.face_count());
  expect_read([&] { return parts::open_arrays(positions, faces); });
}

}  // namespace
}  // namespace meshhood::test
