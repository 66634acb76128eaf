// SPDX-License-Identifier: MIT
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "io/index_io.h"
#include "support/hostile.h"
#include "support/scratch.h"

// Files and errors of the system: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class Files : public ::testing::Test {
 protected:
  Scratch scratch;
};

// M22
TEST_F(Files, FoldersAndMissingFilesAreErrors) {
  const auto directory = file_refusal(scratch.path());
  EXPECT_EQ(directory.code, ErrorCode::IoFailure);
  EXPECT_THAT(directory.message, StartsWith(scratch.path().string() + ": is a directory"));

  const auto missing = file_refusal(scratch.path() / "missing.ply");
  EXPECT_EQ(missing.code, ErrorCode::IoFailure);
  EXPECT_THAT(missing.message, HasSubstr("missing.ply: No such file"));

  EXPECT_THAT(file_refusal(scratch.write("empty.ply", "")).message, HasSubstr("the file is empty"));
  EXPECT_EQ(vertex_count(io::read_mesh(scratch.write("empty.obj", ""))), 0U);
}

// Bindings need both, for OSError of Python.
TEST_F(Files, ErrorsOfTheSystemHavePathAndErrno) {
  const auto read = [](const auto& path) { static_cast<void>(io::read_mesh(path)); };
  const auto load = [](const auto& path) { static_cast<void>(io::load(path)); };
  const auto load_paper = [](const auto& path) { static_cast<void>(io::load_paper(path)); };
  const auto map = [](const auto& path) { static_cast<void>(io::map(path)); };
  const auto header = [](const auto& path) { static_cast<void>(io::read_header(path)); };
  const auto write = [](const auto& path) { io::write_ply(path, MeshView{}); };
  const auto save = [](const auto& path) { io::save(path, build(MeshView{})); };
  const auto missing = scratch.path() / "missing" / "file.ply";
  expect_errno(missing, ENOENT, read);
  expect_errno(missing, ENOENT, load);
  expect_errno(missing, ENOENT, load_paper);
  expect_errno(missing, ENOENT, map);
  expect_errno(missing, ENOENT, header);
  expect_errno(missing, ENOENT, write);
  expect_errno(missing, ENOENT, save);
  expect_errno(scratch.path(), EISDIR, read);
  expect_errno(scratch.path(), EISDIR, load);
  expect_errno(scratch.path(), EISDIR, map);
  try {
    static_cast<void>(io::read_mesh(scratch.write("bad.ply", "")));
  } catch (const Error& error) {
    EXPECT_EQ(error.path(), "");
    EXPECT_EQ(error.error_number(), 0);
  }
}

// M22
TEST_F(Files, TheLimitHoldsForFilesAndMemory) {
  EXPECT_EQ(file_refusal(scratch.write("a.obj", kObj), {.max_bytes = 10}).code, ErrorCode::TooLarge);
  EXPECT_EQ(refusal("a.obj", kObj, {.max_bytes = 10}).code, ErrorCode::TooLarge);
  EXPECT_FALSE(refusal("a.obj", kObj, {.max_bytes = kObj.size()}).refused);
}

// M22
TEST_F(Files, AFileThatShrinksWhileReadIsAnError) {
  const std::string vertex = "v 0.123456 0.123456 0.123456\n";
  std::string vertices;
  while (vertices.size() < (std::size_t{8} << 20)) vertices += vertex;
  std::size_t refused = 0;
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto path = scratch.write("shrinks.obj", vertices);
    const std::jthread shrinker([&path, &vertex, attempt] {
      std::this_thread::sleep_for(std::chrono::milliseconds(2 * attempt));
      std::filesystem::resize_file(path, 35 * vertex.size());  // a valid file, if it is shortened before it is opened
    });
    const auto result = file_refusal(path);
    if (!result.refused) continue;
    ++refused;
    // While a page is cut off, the system may return zeros for it.
    if (result.code == ErrorCode::MalformedFile) {
      EXPECT_THAT(result.message, HasSubstr("found a NUL byte"));
    } else {
      EXPECT_EQ(result.code, ErrorCode::IoFailure);
      EXPECT_THAT(result.message, HasSubstr("when opened"));
    }
  }
  std::printf("%zu of 20 files were caught shrinking\n", refused);
}

TEST_F(Files, ReadLikeBytesInMemory) {
  const auto mesh = io::read_mesh(scratch.write("a.obj", kObj));
  EXPECT_EQ(mesh.positions, read("a.obj", kObj).positions);
  EXPECT_EQ(mesh.corners, read("a.obj", kObj).corners);
}

}  // namespace
}  // namespace meshhood::test
