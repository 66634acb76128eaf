// SPDX-License-Identifier: MIT
// A folder of parts after runs that were killed or forked, or ran out of disk.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meshhood/error.h"

#include "support/parts_folder.h"
#include "support/scale.h"
#include "support/small_disk.h"

namespace meshhood::test {
namespace {

namespace fs = std::filesystem;

class StoppedFolder : public PartsFolder {};

TEST_F(StoppedFolder, IsCompletedAfterAKill) {
  const auto expected = whole();
  std::size_t with_leftovers = 0;
  for (std::size_t trial = 0; trial < scaled(40, 10); ++trial) {
    fs::remove_all(folder);
    const pid_t child = ::fork();
    if (child == 0) {
      run(folder);
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(1500 * trial));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (fs::exists(folder / ".partition.tmp")) ++with_leftovers;
    run(folder);
    EXPECT_EQ(contents(folder), expected);
  }
  std::printf("%zu kills left temporary files, which the next run has removed\n", with_leftovers);
}

TEST_F(StoppedFolder, IsWrittenAgainAfterAKillThatLeftAPartWithoutARecord) {
  const auto expected = whole();
  parts::PartitionOptions options = kOptions;
  options.resume = false;
  for (std::size_t trial = 0; trial < scaled(40, 10); ++trial) {
    run(folder);
    fs::remove(folder / parts::part_name(trial % 4) / parts::kPartFile);
    const pid_t child = ::fork();
    if (child == 0) {
      partition(*chunked(mesh), folder, options);
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(150 * trial));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    partition(*chunked(mesh), folder, options);
    EXPECT_EQ(contents(folder), expected);
  }
}

TEST_F(StoppedFolder, IsFreeAfterARunDuringWhichTheProcessWasForked) {
  pid_t child = -1;
  run(folder, [&](std::size_t done, std::size_t) {
    if (done > 0 && child < 0) child = ::fork();
    if (child == 0) {
      ::pause();
      ::_exit(0);
    }
    return true;
  });
  EXPECT_NO_THROW(run(folder));
  ::kill(child, SIGKILL);
  EXPECT_EQ(::waitpid(child, nullptr, 0), child);
}

TEST_F(StoppedFolder, IsCompletedAfterTheDiskWasFull) {
  const auto expected = whole();
  fs::create_directory(folder);
  const auto disk = SmallDisk::mount(folder);
  if (disk == nullptr) GTEST_SKIP() << "no tmpfs may be mounted here";
  const fs::path inside = folder / "parts";
  std::size_t failures = 0;
  for (std::uint64_t pages = 1;; pages += 2) {
    disk->leave_free(pages);
    try {
      run(inside);
      break;
    } catch (const Error& error) {
      EXPECT_EQ(error.error_number(), ENOSPC) << error.what();
      EXPECT_FALSE(fs::exists(inside / ".partition.tmp"));
      EXPECT_FALSE(fs::exists(inside / parts::kManifestFile));
      ++failures;
    }
  }
  EXPECT_EQ(contents(inside), expected);
  std::printf("the disk was full %zu times\n", failures);
  EXPECT_GT(failures, 10U);
}

}  // namespace
}  // namespace meshhood::test
