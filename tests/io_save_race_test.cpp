// SPDX-License-Identifier: MIT
// Several who save to one file at once, and others who read it meanwhile: row F9 of the catalogue.
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

#include "meshhood/search.h"

#include "io/index_io.h"
#include "scale.h"
#include "shapes/shapes.h"
#include "support/save_trial.h"

namespace meshhood::test {
namespace {

class SaveRaces : public SaveTrial {};

TEST_P(SaveRaces, WhoReadsSeesAWholeFile) {
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
  for (; savers_left > 0; ++reads) {
    const Version found = held();
    ASSERT_TRUE(found == Version::Old || found == Version::New);
  }
  savers.clear();
  EXPECT_EQ(remove_leftovers(), 0U);
  std::printf("%zu saves by two threads, %zu reads\n", 2 * saves, reads);
}

MESHHOOD_TRY_ALL_SAVERS(SaveRaces);

// Whoever has mapped a file keeps it, though its name comes to stand for another.
TEST(SaveWhileMapped, TheOldIndexAnswersOn) {
  const Scratch scratch;
  const auto file = scratch.path() / "index";
  const Index large = build(shapes::find_kind("sphere")->make(5000).view());
  const Index small = build(shapes::find_kind("grid")->make(100).view());
  io::save(file, large);
  const Index mapped = io::map(file);
  io::save(file, small);
  ASSERT_EQ(io::load(file).vertex_count(), 100U);

  Searcher before(large);
  Searcher after(mapped);
  for (VertexId v = 0; v < large.vertex_count(); ++v) {
    ASSERT_EQ(after.count(v, 10.0), before.count(v, 10.0));
  }
}

}  // namespace
}  // namespace meshhood::test
