// SPDX-License-Identifier: MIT
// Traversals of a ball against a breadth-first search over vertices.
#include "exact/search/leaf_traversal.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact/search/leaf_bfs.h"
#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

/// Returns the leaves in random order, so that no test depends on one order.
class RandomFrontier {
 public:
  void push(LeafId leaf) { leaves_.push_back(leaf); }
  LeafId pop() {
    std::swap(leaves_[random_.below(leaves_.size())], leaves_.back());
    const LeafId leaf = leaves_.back();
    leaves_.pop_back();
    return leaf;
  }
  [[nodiscard]] bool empty() const { return leaves_.empty(); }
  template <class F>
  void clear(F&& f) {
    for (const LeafId leaf : leaves_) f(leaf);
    leaves_.clear();
  }

 private:
  std::vector<LeafId> leaves_;
  Random random_{11};
};

bool never(LeafId /*leaf*/, LaneMask /*added*/) { return false; }

Ids reached_ids(const LeafTraversal& traversal, const SearchCase& c) {
  Ids ids;
  for (const LeafId leaf : traversal.reached_leaves()) {
    for_each_lane(traversal.reached(leaf), [&](unsigned lane) { ids.push_back(c.id(leaf, lane)); });
  }
  return sorted(ids);
}

template <class Stop>
bool traverse_from(LeafTraversal& traversal, const SearchCase& c, std::uint32_t v, RandomFrontier& frontier,
                   Stop&& stop) {
  const std::uint32_t slot = c.index.slot[v];
  return traversal.traverse(leaf_of(slot), LaneMask{1} << lane_of(slot), frontier, stop);
}

class LeafTraversalOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(LeafTraversalOnFamilies, ReachesTheComponentInAnyOrder) {
  const std::size_t cases = for_each_search_case(GetParam(), scaled(40, 4), 4, [&](const SearchCase& c) {
    LeafTraversal traversal(c.index, c.kernels);
    RandomFrontier frontier;
    traversal.start(c.query);
    ASSERT_TRUE(traverse_from(traversal, c, c.query.vertex, frontier, never));
    ASSERT_TRUE(frontier.empty());
    ASSERT_EQ(reached_ids(traversal, c), c.neighborhood()) << c.mesh.name << ": vertex " << c.query.vertex;
  });
  std::printf("%zu queries\n", cases);
}

TEST_P(LeafTraversalOnFamilies, LaterTraversalsEndAtSettledVertices) {
  std::size_t met = 0;
  std::size_t apart = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(20, 3), 2, [&](const SearchCase& c) {
    LeafTraversal traversal(c.index, c.kernels);
    RandomFrontier frontier;
    traversal.start(c.query);
    ASSERT_TRUE(traverse_from(traversal, c, c.query.vertex, frontier, never));
    traversal.settle();
    const Ids known = c.neighborhood();
    std::size_t tried = 0;
    for (const std::uint32_t w : c.ball()) {
      if (++tried > 20) break;
      const bool is_known = std::binary_search(known.begin(), known.end(), w);
      const std::uint32_t slot = c.index.slot[w];
      ASSERT_EQ(traversal.is_settled(leaf_of(slot), LaneMask{1} << lane_of(slot)), is_known);
      ASSERT_EQ(traverse_from(traversal, c, w, frontier, never), !is_known) << c.mesh.name;
      if (!is_known) {
        ASSERT_EQ(reached_ids(traversal, c), c.component_in_ball(w));
      }
      ++(is_known ? met : apart);
      traversal.start(c.query);
      ASSERT_TRUE(traverse_from(traversal, c, c.query.vertex, frontier, never));
      traversal.settle();
    }
  });
  std::printf("%zu traversals met settled vertices, %zu reached another component\n", met, apart);
  EXPECT_TRUE(cases == 0 || met > 0);
}

TEST_P(LeafTraversalOnFamilies, StoppedTraversalsReachAPartAndLeaveNothingPending) {
  std::size_t stopped = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(20, 3), 2, [&](const SearchCase& c) {
    LeafTraversal traversal(c.index, c.kernels);
    RandomFrontier frontier;
    const Ids all = c.neighborhood();
    for (const std::size_t most : {0U, 1U, 3U}) {
      traversal.start(c.query);
      std::size_t visits = 0;
      const bool is_complete = traverse_from(traversal, c, c.query.vertex, frontier, [&](LeafId, LaneMask added) {
        EXPECT_NE(added, 0U);
        return visits++ == most;
      });
      ASSERT_TRUE(frontier.empty());
      ASSERT_EQ(is_complete, visits <= most);
      const Ids some = reached_ids(traversal, c);
      ASSERT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
      stopped += static_cast<std::size_t>(!is_complete);
      // The settled part is where a second traversal ends, wherever it begins in the rest.
      traversal.settle();
      const auto rest = std::find_if_not(
          all.begin(), all.end(), [&](std::uint32_t w) { return std::binary_search(some.begin(), some.end(), w); });
      if (rest != all.end()) {
        ASSERT_FALSE(traverse_from(traversal, c, *rest, frontier, never));
      }
    }
  });
  std::printf("%zu traversals stopped\n", stopped);
  EXPECT_TRUE(cases == 0 || stopped > 0);
}

TEST_P(LeafTraversalOnFamilies, LeafBfsAddsTheNeighborhood) {
  for_each_search_case(GetParam(), scaled(40, 4), 4, [&](const SearchCase& c) {
    LeafTraversal traversal(c.index, c.kernels);
    LeafBfs bfs(c.index);
    for (const bool is_small : {false, true}) {
      VertexSet answer(c.index);
      bfs.run(c.query, is_small, traversal, answer);
      Ids ids;
      answer.for_each([&](std::size_t v) { ids.push_back(c.index.id(v)); });
      ASSERT_EQ(sorted(ids), c.neighborhood()) << c.mesh.name << ": vertex " << c.query.vertex;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, LeafTraversalOnFamilies, testing::ValuesIn(families()), family_name);

TEST(LeafTraversal, QueryNumbersWrapAround) {
  const TestMesh mesh = make_grid(40, 40, false);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  LeafTraversal traversal(index, portable_kernels());
  LeafBfs bfs(index);
  traversal.set_query_number((1U << 31) - 4);
  for (int i = 0; i < 8; ++i) {
    for (const double radius : {3.0, 12.0}) {
      const Query query(index, 820, RadiusBounds(index.frame, radius));
      VertexSet answer(index);
      bfs.run(query, false, traversal, answer);
      EXPECT_EQ(answer.count(), Oracle(mesh).exact(820, radius).size());
    }
  }
}

}  // namespace
}  // namespace meshhood::test
