// SPDX-License-Identifier: MIT
// Index files: atomic replacement, mapping, detection, truncation. Rows F3, F7 and F9 of the catalogue.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "meshhood/search.h"

#include "io/index_io.h"
#include "io/mesh_io.h"
#include "support/families.h"
#include "support/refusal.h"
#include "support/same_storage.h"
#include "support/scale.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

Index index_of(std::size_t side) {
  TestMesh mesh = make_grid(side, side, false);
  return build(mesh.finish(true).view());
}

class IndexFile : public testing::Test {
 protected:
  Scratch scratch;
  const std::filesystem::path file = scratch.path() / "grid.mhi";
};

TEST_F(IndexFile, RoundTripsTheIndex) {
  const Index index = index_of(50);
  io::save(file, index);
  EXPECT_EQ(files_in(scratch.path()), 1U);
  EXPECT_THAT(differences(io::load(file), index), IsEmpty());
  EXPECT_THAT(differences(io::map(file), index), IsEmpty());
  EXPECT_THAT(differences(io::map(file, {.trusted = true}), index), IsEmpty());
  EXPECT_EQ(io::read_header(file).vertices, 2500U);
  EXPECT_EQ(io::read_header(file).bytes, std::filesystem::file_size(file));
}

TEST_F(IndexFile, RoundTripsTheFaces) {
  const TestMesh mesh = make_grid(20, 20, true).finish(true);
  io::save(file, build(mesh.view()), {.faces = mesh.view().faces});
  const std::array loaded{io::load(file), io::map(file), io::map(file, {.trusted = true})};
  for (const Index& index : loaded) {
    ASSERT_TRUE(index.faces());
    index.faces()->for_each([&](std::size_t face, std::span<const VertexId> corners) {
      EXPECT_TRUE(std::ranges::equal(corners, mesh.face(face))) << "face " << face;
    });
    EXPECT_EQ(index.faces()->size(), mesh.face_count());
  }
  io::save(file, build(mesh.view()));
  const Index without_faces = io::load(file);
  EXPECT_FALSE(without_faces.faces());
}

TEST_F(IndexFile, IsDetectedByContent) {
  const auto misnamed = scratch.path() / "index.ply";
  io::save(misnamed, index_of(5));
  EXPECT_TRUE(io::is_index(misnamed));
  for (const char* content : {"", "p", "ply\nformat ascii 1.0\n", "OFF\n0 0 0\n", "\x8bMHI\n\n\x1a\n"}) {
    EXPECT_FALSE(io::is_index(scratch.write("mesh.mhi", content))) << content;
  }
  EXPECT_FALSE(io::is_index(scratch.path()));
  EXPECT_FALSE(io::is_index("/dev/zero"));
  EXPECT_FALSE(io::is_index(scratch.path() / "no such file"));
  EXPECT_THAT([&] { static_cast<void>(io::read_mesh(misnamed)); }, testing::Throws<Error>());
}

TEST_F(IndexFile, ErrorsBeginWithTheFile) {
  io::save(file, index_of(20));
  std::filesystem::resize_file(file, 1000);
  const std::string name = file.string() + ": header, byte 16: expected ";
  expect_refused(ErrorCode::MalformedIndex, name, [&] { return io::load(file); });
  expect_refused(ErrorCode::MalformedIndex, name, [&] { return io::map(file); });
  expect_refused(ErrorCode::MalformedIndex, name, [&] { return io::read_header(file); });
  const auto empty = scratch.write("empty.mhi", "");
  expect_refused(ErrorCode::MalformedIndex, "empty.mhi: header, byte 0: the end, expected 64 bytes",
                 [&] { return io::load(empty); });
  const auto missing = scratch.path() / "missing.mhi";
  expect_refused(ErrorCode::IoFailure, "missing.mhi: No such file", [&] { return io::load(missing); });
  expect_refused(ErrorCode::IoFailure, "missing.mhi: No such file", [&] { return io::map(missing); });
  expect_refused(ErrorCode::IoFailure, "is a directory", [&] { return io::load(scratch.path()); });
  expect_refused(ErrorCode::IoFailure, "is a directory, expected a file", [&] { return io::map(scratch.path()); });
}

// F3
TEST_F(IndexFile, AGigabyteAppendedIsRefusedBeforeItIsRead) {
  io::save(file, index_of(20));
  // A sparse file, which needs no disk; reading it would need a gigabyte of memory.
  std::filesystem::resize_file(file, std::filesystem::file_size(file) + (std::uintmax_t{1} << 30U));
  expect_refused(ErrorCode::MalformedIndex, "but there are 107", [&] { return io::load(file); });
  expect_refused(ErrorCode::MalformedIndex, "but there are 107", [&] { return io::map(file); });
}

TEST_F(IndexFile, IsLoadedFromAPipe) {
  const Index index = index_of(300);  // larger than the first buffer for a pipe
  io::save(file, index);
  const auto pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] {
    const std::ifstream from(file, std::ios::binary);
    std::ofstream(pipe, std::ios::binary) << from.rdbuf();
  });
  const Index loaded = io::load(pipe);
  writer.join();
  EXPECT_THAT(differences(loaded, index), IsEmpty());
}

// F7
TEST_F(IndexFile, ALoadedIndexDoesNotNeedTheFile) {
  const Index index = index_of(50);
  io::save(file, index);
  const Index loaded = io::load(file);
  std::filesystem::resize_file(file, 0);
  EXPECT_THAT(differences(loaded, index), IsEmpty());
}

// F7
TEST_F(IndexFile, AFileTruncatedDuringLoadingIsRefused) {
  const Index index = index_of(50);
  io::save(file, index);
  const std::uintmax_t bytes = std::filesystem::file_size(file);
  std::atomic<bool> done = false;
  std::thread vandal([&] {
    while (!done) {
      std::filesystem::resize_file(file, 0);
      std::filesystem::resize_file(file, bytes);
    }
  });
  std::size_t refused = 0;
  const auto expect_to_survive = [&](auto&& read, std::size_t times) {
    for (std::size_t i = 0; i < times; ++i) {
      try {
        static_cast<void>(read(file));
      } catch (const Error&) {
        ++refused;
      }
    }
  };
  expect_to_survive([](const auto& path) { return io::read_header(path); }, scaled(15000, 3000));
  expect_to_survive([](const auto& path) { return io::load(path); }, scaled(1000, 200));
  done = true;
  vandal.join();
  std::printf("%zu times refused\n", refused);
  EXPECT_GT(refused, 0U);
}

// F9
TEST_F(IndexFile, AMappingKeepsTheOldFile) {
  const Index old = index_of(50);
  io::save(file, old);
  const Index mapped = io::map(file, {.trusted = true});
  io::save(file, index_of(60));
  EXPECT_THAT(differences(mapped, old), IsEmpty());
  std::filesystem::remove(file);
  EXPECT_THAT(differences(mapped, old), IsEmpty());
}

}  // namespace
}  // namespace meshhood::test
