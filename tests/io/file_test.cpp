// SPDX-License-Identifier: MIT
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "meshhood/index.h"

#include "io/index_io.h"
#include "support/hostile.h"
#include "support/scratch.h"

// Special files and system errors: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

Refusal file_refusal(const std::filesystem::path& path, const io::ReadOptions& options = {}) {
  try {
    static_cast<void>(io::read_mesh(path, options));
    return {};
  } catch (const Error& error) {
    return {true, error.code(), error.what()};
  }
}

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

/// During its lifetime, standard input is this file.
class StandardInput {
 public:
  explicit StandardInput(const std::filesystem::path& file) : before_(::dup(STDIN_FILENO)) {
    const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    ::dup2(number, STDIN_FILENO);
    ::close(number);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;
  ~StandardInput() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

TEST_F(Files, StandardInputIsReadOnceFromItsPlace) {
  const std::string before = "not a mesh\n";
  const StandardInput input(scratch.write("in.obj", before + kObj));
  ASSERT_EQ(::lseek(STDIN_FILENO, static_cast<off_t>(before.size()), SEEK_SET), static_cast<off_t>(before.size()));
  EXPECT_FALSE(io::is_index("/dev/stdin"));
  std::size_t total = 0;
  const io::Mesh mesh = io::read_mesh("/dev/stdin", {.progress = [&](std::size_t, std::size_t all) {
                                        total = all;
                                        return true;
                                      }});
  EXPECT_EQ(vertex_count(mesh), 3U);
  EXPECT_EQ(total, kObj.size());
  EXPECT_THAT(file_refusal("/dev/stdin").message, HasSubstr("/dev/stdin: the file is empty"));
}

// Bindings need both, for OSError of Python.
TEST_F(Files, ErrorsOfTheSystemHavePathAndErrno) {
  const auto expect_errno = [](const std::filesystem::path& path, int error_number, auto&& call) {
    try {
      call(path);
      ADD_FAILURE() << path << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::IoFailure) << error.what();
      EXPECT_EQ(error.path(), path.string()) << error.what();
      EXPECT_EQ(error.error_number(), error_number) << error.what();
    }
  };
  const auto read = [](const auto& path) { static_cast<void>(io::read_mesh(path)); };
  const auto load = [](const auto& path) { static_cast<void>(io::load(path)); };
  const auto load_paper = [](const auto& path) { static_cast<void>(io::load_paper(path)); };
  const auto map = [](const auto& path) { static_cast<void>(io::map(path)); };
  const auto header = [](const auto& path) { static_cast<void>(io::read_header(path)); };
  const auto write = [](const auto& path) { io::write_ply(path, MeshView{}); };
  const auto save = [](const auto& path) { io::save(path, build(MeshView{})); };
  const auto missing = scratch.path() / "missing\n" / "file.ply";
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
  expect_errno("/dev/full", ENOSPC, write);
  expect_errno("/dev/full", ENOSPC, save);
  try {
    static_cast<void>(io::read_mesh(scratch.write("bad.ply", "")));
  } catch (const Error& error) {
    EXPECT_EQ(error.path(), "");
    EXPECT_EQ(error.error_number(), 0);
  }
}

// M22
TEST_F(Files, EndlessDevicesAreRefused) {
  for (const std::string device : {"/dev/zero", "/dev/urandom"}) {
    const auto result = file_refusal(device);
    EXPECT_TRUE(result.refused) << device;
    EXPECT_THAT(result.message, StartsWith(device));
  }
  // With any extension, the limit ends the read.
  for (const std::string name : {"zero.obj", "zero.stl", "zero.ply", "zero.off"}) {
    std::filesystem::create_symlink("/dev/zero", scratch.path() / name);
    const auto result = file_refusal(scratch.path() / name, {.max_bytes = 1 << 20});
    EXPECT_TRUE(result.refused || name == "zero.stl") << name << " " << result.message;
  }
}

// M22
TEST_F(Files, APipeIsReadToItsEnd) {
  const auto pipe = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::jthread writer([&pipe] {
    std::ofstream out(pipe);
    out << kObj.substr(0, 10) << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    out << kObj.substr(10);
  });
  EXPECT_EQ(face_count(io::read_mesh(pipe)), 1U);
}

// M22
TEST_F(Files, APipeWithoutWriterIsRefused) {
  const auto pipe = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto result = file_refusal(pipe.parent_path() / "pipe.obj");
  EXPECT_EQ(result.code, ErrorCode::IoFailure);
  EXPECT_THAT(result.message, HasSubstr("no process writes to this pipe"));
}

// M22
TEST_F(Files, AnEndlessPipeIsReadUpToTheLimit) {
  const auto pipe = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::jthread writer([&pipe] {
    // If the reader closes the pipe, the writer gets an error, not a signal.
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
    std::ofstream out(pipe);
    while (out << kObj) {
    }
  });
  const auto result = file_refusal(pipe, {.max_bytes = 4 << 20});
  EXPECT_EQ(result.code, ErrorCode::TooLarge);
  EXPECT_THAT(result.message, HasSubstr("4194304 bytes"));
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
