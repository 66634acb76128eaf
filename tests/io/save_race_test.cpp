// SPDX-License-Identifier: MIT
// Several threads save to one file while others read it: row F9 of the catalogue.
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

#include "support/save_trial.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class SaveRaces : public SaveTrial {};

TEST_P(SaveRaces, ReadersSeeACompleteFile) {
  const std::size_t saves = scaled(100, 20);
  restore(Version::Old);
  std::atomic<unsigned> savers_left = 2;
  std::vector<std::jthread> savers;
  for (const Version version : {Version::Old, Version::New}) {
    savers.emplace_back([&, version] {
      for (std::size_t i = 0; i < saves; ++i) save(version);
      --savers_left;
    });
  }
  std::size_t reads = 0;
  do {
    const Version found = held();
    ASSERT_TRUE(found == Version::Old || found == Version::New);
    ++reads;
  } while (savers_left > 0);
  savers.clear();
  EXPECT_EQ(remove_leftovers(), 0U);
  std::printf("%zu saves by two threads, %zu reads\n", 2 * saves, reads);
}

MESHHOOD_TRY_ALL_SAVERS(SaveRaces);

}  // namespace
}  // namespace meshhood::test
