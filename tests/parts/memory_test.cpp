// SPDX-License-Identifier: MIT
// The peak memory of a partition stays within the limit of its options, for meshes of any size.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "io/mesh_io.h"
#include "parts/partition.h"
#include "shapes/shapes.h"
#include "support/scale.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

struct Peak {
  std::size_t base = 0;
  std::size_t peak = 0;
};

Peak measure(const std::filesystem::path& mesh, const std::filesystem::path& folder, std::size_t parts,
             std::uint64_t memory) {
  const std::string command = std::string(MESHHOOD_PARTITION_PEAK) + " '" + mesh.string() + "' '" + folder.string() +
                              "' " + std::to_string(parts) + " " + std::to_string(memory);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  Peak result;
  EXPECT_EQ(std::fscanf(pipe.get(), "%zu %zu", &result.base, &result.peak), 2);
  return result;
}

TEST(PartitionMemory, StaysWithinTheLimit) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const Scratch scratch;
  const auto file = scratch.path() / "mesh.ply";
  // More parts of the same size: the peak stays.
  for (const std::size_t vertices : {250'000U, 1'000'000U}) {
    io::write_ply(file, shapes::find_kind("grid")->make(vertices).view());
    const auto [base, peak] =
        measure(file, scratch.path() / std::to_string(vertices), vertices / 62'500, parts::kLeastMemory);
    std::printf("%zu vertices: %zu MB of %ju\n", vertices, (peak - base) >> 20U,
                std::uintmax_t{parts::kLeastMemory >> 20U});
    EXPECT_GT(base, 0U);
    EXPECT_LE(peak - base, parts::kLeastMemory);
  }
}

// The largest part that the estimate lets pass.
TEST(PartitionMemory, HoldsForOneLargePart) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const Scratch scratch;
  const auto file = scratch.path() / "mesh.ply";
  constexpr std::uint64_t kMemory = std::uint64_t{512} << 20;
  for (const char* const kind : {"grid", "gyroid"}) {
    io::write_ply(file, shapes::find_kind(kind)->make(900'000).view());
    const auto [base, peak] = measure(file, scratch.path() / kind, 1, kMemory);
    std::printf("%s of 900000 vertices: %zu MB of %ju\n", kind, (peak - base) >> 20U, std::uintmax_t{kMemory >> 20U});
    EXPECT_GT(base, 0U);
    EXPECT_LE(peak - base, kMemory);
  }
}

}  // namespace
}  // namespace meshhood::test
