// SPDX-License-Identifier: MIT
// Files that POSIX has: pipes, devices and standard input. Rows of the catalogue of mesh files.
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/index_io.h"
#include "support/hostile.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kMesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class SpecialFiles : public ::testing::Test {
 protected:
  Scratch scratch;
};

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

TEST_F(SpecialFiles, StandardInputIsReadOnceFromItsPlace) {
  const std::string before = "not a mesh\n";
  const StandardInput input(scratch.write("in.obj", before + kMesh));
  ASSERT_EQ(::lseek(STDIN_FILENO, static_cast<off_t>(before.size()), SEEK_SET), static_cast<off_t>(before.size()));
  EXPECT_FALSE(io::is_index("/dev/stdin"));
  std::size_t total = 0;
  const io::Mesh mesh = io::read_mesh("/dev/stdin", {.progress = [&](std::size_t, std::size_t all) {
                                        total = all;
                                        return true;
                                      }});
  EXPECT_EQ(vertex_count(mesh), 3U);
  EXPECT_EQ(total, kMesh.size());
  EXPECT_THAT(file_refusal("/dev/stdin").message, HasSubstr("/dev/stdin: the file is empty"));
}

// M22
TEST_F(SpecialFiles, EndlessDevicesAreRefused) {
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
TEST_F(SpecialFiles, APipeIsReadToItsEnd) {
  const auto pipe = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::jthread writer([&pipe] {
    std::ofstream out(pipe);
    out << kMesh.substr(0, 10) << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    out << kMesh.substr(10);
  });
  EXPECT_EQ(face_count(io::read_mesh(pipe)), 1U);
}

// M22
TEST_F(SpecialFiles, ABinaryStlIsReadFromAPipeWithoutAName) {
  const auto pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string stl = binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}}, "made by a scanner");
  for (const std::string& content : {stl, std::string(90, 'x')}) {
    const std::jthread writer([&] { std::ofstream(pipe, std::ios::binary) << content; });
    if (content == stl) {
      EXPECT_EQ(face_count(io::read_mesh(pipe)), 1U);
    } else {
      EXPECT_THAT(file_refusal(pipe).message, HasSubstr("is neither PLY, OBJ"));
    }
  }
}

// A link in /dev/fd to a pipe has a target that is no name of a file.
TEST_F(SpecialFiles, APipeIsWrittenByItsNumber) {
  const std::string folder = "/dev/fd/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  std::array<int, 2> ends = {};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const std::vector<float> positions = {0, 0, 0};
  io::write_ply(folder + std::to_string(ends[1]), {positions, FacesView{}});
  ::close(ends[1]);
  std::array<char, 4> start = {};
  EXPECT_EQ(::read(ends[0], start.data(), start.size()), 4);
  EXPECT_EQ(std::string(start.data(), start.size()), "ply\n");
  ::close(ends[0]);
}

// M22
TEST_F(SpecialFiles, APipeWithoutWriterIsRefused) {
  const auto pipe = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto result = file_refusal(pipe.parent_path() / "pipe.obj");
  EXPECT_EQ(result.code, ErrorCode::IoFailure);
  EXPECT_THAT(result.message, HasSubstr("no process writes to this pipe"));
}

// M22
TEST_F(SpecialFiles, AnEndlessPipeIsReadUpToTheLimit) {
  const auto pipe = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::jthread writer([&pipe] {
    // If the reader closes the pipe, the writer gets an error, not a signal.
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
    std::ofstream out(pipe);
    while (out << kMesh) {
    }
  });
  const auto result = file_refusal(pipe, {.max_bytes = 4 << 20});
  EXPECT_EQ(result.code, ErrorCode::TooLarge);
  EXPECT_THAT(result.message, HasSubstr("4194304 bytes"));
}

// The message has no line break; what a program gets does.
TEST_F(SpecialFiles, ErrorsOfTheSystemHavePathAndErrno) {
  const auto write = [](const auto& path) { io::write_ply(path, MeshView{}); };
  const auto save = [](const auto& path) { io::save(path, build(MeshView{})); };
  expect_errno(scratch.path() / "missing\n" / "file.ply", ENOENT, write);
  expect_errno("/dev/full", ENOSPC, write);
  expect_errno("/dev/full", ENOSPC, save);
}

}  // namespace
}  // namespace meshhood::test
