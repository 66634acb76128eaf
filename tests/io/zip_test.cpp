// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "io/zip_writer.h"
#include "support/scale.h"
#include "support/scratch.h"

// Zip files are read by `unzip`, which verifies sizes and checksums.

namespace meshhood::inline v0_1::io {
namespace {

class Zip : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v unzip > /dev/null") != 0) GTEST_SKIP() << "unzip is not installed";
  }

  /// What `unzip` prints.
  [[nodiscard]] std::string unzip(const std::string& arguments) const {
    const std::string command = "unzip " + arguments + " 2>&1";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::string text(1 << 16, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), pipe.get()));
    return text;
  }

  test::Scratch scratch;
  std::filesystem::path file = scratch.path() / "file.zip";
};

TEST_F(Zip, RunsAndStoredMembersAreUnpacked) {
  for (const std::uint64_t count : {0U, 1U, 2U, 258U, 259U, 260U, 516U, 517U, 10'000U}) {
    ZipWriter zip(file);
    zip.begin("stored", 13);
    zip.write("12345");
    zip.write("67890abc");
    zip.add_run("run", "head", 'x', count);
    zip.begin("empty", 0);
    zip.commit();
    EXPECT_EQ(unzip("-tqq " + file.string()), "") << count;
    EXPECT_EQ(unzip("-p " + file.string() + " stored"), "1234567890abc");
    EXPECT_EQ(unzip("-p " + file.string() + " run"), "head" + std::string(count, 'x')) << count;
  }
}

constexpr std::uint64_t kLarge = (std::uint64_t{1} << 32U) + 5;

TEST_F(Zip, SizesBeyond32Bits) {
  ZipWriter zip(file);
  zip.add_run("run", "", 'x', kLarge);
  zip.commit();
  const std::string listed = unzip("-lqq " + file.string());
  EXPECT_NE(listed.find(std::to_string(kLarge)), std::string::npos) << listed;
}

TEST_F(Zip, FilesBeyond32Bits) {
  if (test::scaled(10) < 10 || test::kSanitized) GTEST_SKIP() << "takes a minute and 4 GiB of disk";
  const std::string chunk(std::size_t{1} << 20U, 'a');
  ZipWriter zip(file);
  zip.add_run("run", "", 'x', kLarge);
  zip.begin("large", kLarge);
  for (int i = 0; i < 1 << 12; ++i) zip.write(chunk);
  zip.write("aaaaa");
  zip.begin("last", 4);
  zip.write("last");
  zip.commit();
  EXPECT_GT(std::filesystem::file_size(file), kLarge);
  EXPECT_EQ(unzip("-tqq " + file.string()), "");
  EXPECT_EQ(unzip("-p " + file.string() + " last"), "last");
}

}  // namespace
}  // namespace meshhood::inline v0_1::io
