// SPDX-License-Identifier: MIT
#include "shared/row_order.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

// Rows of several lengths by one object, against a sort of tuples. Every third distance is equal to another.
TEST(RowOrder, IsThatOfTuples) {
  Random random(1);
  std::vector<VertexId> permutation(100);
  for (std::size_t i = 0; i < permutation.size(); ++i) permutation[i] = static_cast<VertexId>(i * 37 % 100);
  std::vector<VertexId> places(100);
  for (std::size_t i = 0; i < permutation.size(); ++i) places[permutation[i]] = static_cast<VertexId>(i);
  RowOrder by_id(RowSort::Id);
  RowOrder by_place(permutation);
  RowOrder by_distance(RowSort::Distance);
  EXPECT_TRUE(by_distance.needs_distances());
  EXPECT_FALSE(by_id.needs_distances() || by_place.needs_distances());
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{40}, std::size_t{3}, std::size_t{100}}) {
    std::vector<VertexId> ids;
    std::vector<double> distances;
    for (std::size_t i = 0; i < size; ++i) {
      ids.push_back(static_cast<VertexId>((i * 7 + size) % 100));
      distances.push_back(static_cast<double>(random.below(size / 3 + 1)));
    }
    for (RowOrder* const order : {&by_id, &by_place, &by_distance}) {
      using Key = std::tuple<double, VertexId, VertexId, double>;
      std::vector<Key> expected;
      for (std::size_t i = 0; i < size; ++i) {
        const double first = order == &by_distance ? distances[i] : 0;
        expected.emplace_back(first, order == &by_place ? places[ids[i]] : ids[i], ids[i], distances[i]);
      }
      std::sort(expected.begin(), expected.end());
      for (const bool with_distances : {true, false}) {
        if (!with_distances && order->needs_distances()) continue;
        std::vector<VertexId> found = ids;
        std::vector<double> along = with_distances ? distances : std::vector<double>();
        order->sort(found, along);
        for (std::size_t i = 0; i < size; ++i) {
          EXPECT_EQ(found[i], std::get<2>(expected[i]));
          if (with_distances) {
            EXPECT_EQ(along[i], std::get<3>(expected[i]));
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace meshhood::test
