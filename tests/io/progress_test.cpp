// SPDX-License-Identifier: MIT
// Progress and cancellation of reading a mesh.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/hostile.h"
#include "support/reports.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using ::testing::HasSubstr;

/// Three megabytes: the window of the reader moves several times.
std::string large_obj() {
  std::string file;
  while (file.size() < 3U << 20) file += "v 1.25 2.5 3.75\n";
  return file;
}

io::ReadOptions watching(Reports& reports) {
  return {.progress = [&reports](std::size_t done, std::size_t total) {
    reports.emplace_back(done, total);
    return true;
  }};
}

void expect_ascending(const Reports& reports, std::size_t bytes, std::size_t total) {
  ASSERT_FALSE(reports.empty());
  EXPECT_EQ(reports.front(), std::pair(std::size_t{0}, total));
  EXPECT_EQ(reports.back(), std::pair(bytes, total));
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_GE(reports.size(), bytes >> 20);
  std::printf("%zu reports for %zu bytes\n", reports.size(), bytes);
}

TEST(Progress, CountsTheBytesOfAFileAndOfMemory) {
  const Scratch scratch;
  const std::string file = large_obj();
  Reports of_file;
  static_cast<void>(io::read_mesh(scratch.write("large.obj", file), watching(of_file)));
  expect_ascending(of_file, file.size(), file.size());
  Reports of_memory;
  static_cast<void>(read("large.obj", file, watching(of_memory)));
  expect_ascending(of_memory, file.size(), file.size());
}

TEST(Progress, IsHeardInTextThatIsNotPlain) {
  std::string elements = "ply\nformat ascii 1.0\n";
  while (elements.size() < 3U << 20) elements += "element e" + std::to_string(elements.size()) + " 0\n";
  std::string carriage_returns = large_obj();
  std::replace(carriage_returns.begin(), carriage_returns.end(), '\n', '\r');
  std::string long_rows;
  std::size_t rows = 0;
  for (; long_rows.size() < 3U << 20; ++rows) long_rows += "1.25 2.5 3.75 1\n";
  const std::string axes = "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (const std::string& file :
       {elements + "element vertex 0\n" + axes, carriage_returns,
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string(rows) + "\n" + axes + long_rows}) {
    Reports reports;
    static_cast<void>(read("a.obj", file, watching(reports)));
    expect_ascending(reports, file.size(), file.size());
    std::size_t left = reports.size() / 2;
    const io::ReadOptions stopping{.progress = [&left](std::size_t, std::size_t) { return left-- != 0; }};
    EXPECT_EQ(refusal("a.obj", file, stopping).code, ErrorCode::Cancelled);
  }
}

TEST(Progress, EndsWithTheTotalIfTheLastBytesAreNotRead) {
  const Scratch scratch;
  const std::string file = "OFF\n1 0 0\n0 0 0\n" + std::string(3U << 20, '\n');
  Reports reports;
  static_cast<void>(io::read_mesh(scratch.write("long.off", file), watching(reports)));
  expect_ascending(reports, file.size(), file.size());
}

TEST(Progress, CancelsReadingAtAnyReport) {
  const Scratch scratch;
  const auto path = scratch.write("large.obj", large_obj());
  Reports all;
  static_cast<void>(io::read_mesh(path, watching(all)));
  for (std::size_t last = 0; last < all.size(); ++last) {
    std::size_t reports = 0;
    const io::ReadOptions stopping{.progress = [&](std::size_t, std::size_t) { return reports++ < last; }};
    try {
      static_cast<void>(io::read_mesh(path, stopping));
      ADD_FAILURE() << "read in spite of report " << last;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::Cancelled);
      EXPECT_THAT(error.what(), HasSubstr("large.obj: cancelled"));
    }
    EXPECT_EQ(reports, last + 1);
  }
}

TEST(Progress, PropagatesExceptions) {
  const io::ReadOptions options{
      .progress = [](std::size_t, std::size_t) -> bool { throw std::domain_error("enough"); }};
  EXPECT_THROW(static_cast<void>(read("large.obj", "v 0 0 0\n", options)), std::domain_error);
}

TEST(Progress, CancelsWaitingForAPipe) {
  const Scratch scratch;
  const auto path = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  // Also open for writing: a writer that never writes.
  const std::fstream writer(path, std::ios::in | std::ios::out);
  int left = 3;
  Reports reports;
  const io::ReadOptions options{.progress = [&](std::size_t done, std::size_t total) {
    reports.emplace_back(done, total);
    return --left > 0;
  }};
  EXPECT_THROW(static_cast<void>(io::read_mesh(path, options)), Error);
  EXPECT_EQ(reports, Reports(3, {0, 0}));
}

TEST(Progress, HasNoTotalForAPipe) {
  const Scratch scratch;
  const auto path = scratch.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const std::string file = large_obj();
  const std::jthread writer([&] { std::ofstream(path) << file; });
  Reports reports;
  static_cast<void>(io::read_mesh(path, watching(reports)));
  expect_ascending(reports, file.size(), 0);
}

}  // namespace
}  // namespace meshhood::test
