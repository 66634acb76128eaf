// SPDX-License-Identifier: MIT
#include "shared/disjoint_sets.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

// Against a list of the smallest element of each set, which every union rewrites.
TEST(DisjointSets, AreNamedByTheirSmallestElement) {
  constexpr std::uint32_t kSize = 60;
  Random random(1);
  DisjointSets sets;
  for (int round = 0; round < 20; ++round) {
    sets.clear();
    std::vector<std::uint32_t> first;
    for (std::uint32_t i = 0; i < kSize; ++i) {
      EXPECT_EQ(sets.size(), i);
      sets.add();
      first.push_back(i);
    }
    for (int i = 0; i < 50; ++i) {
      const auto a = static_cast<std::uint32_t>(random.below(kSize));
      const auto b = static_cast<std::uint32_t>(random.below(kSize));
      sets.unite(a, b);
      const auto [least, most] = std::minmax({first[a], first[b]});
      std::replace(first.begin(), first.end(), most, least);
      for (std::uint32_t k = 0; k < kSize; ++k) EXPECT_EQ(sets.first_of(k), first[k]);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
