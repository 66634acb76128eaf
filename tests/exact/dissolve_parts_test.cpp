// SPDX-License-Identifier: MIT
#include "exact/build/dissolve_parts.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/node_line.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The parts, after small ones were dissolved.
NodeParts dissolved(const NodeGraph& graph, const std::vector<std::vector<std::uint32_t>>& nodes) {
  NodeParts parts(graph);
  for (const auto& part : nodes) parts.add(part);
  dissolve_small_parts(parts);
  return parts;
}

TEST(DissolveParts, MovesTheNodesOfASmallPartToLinkedPartsWithRoom) {
  const NodeGraph graph = node_line(16, chain(0, 15));
  const NodeParts parts = dissolved(graph, {nodes_from(0, 6), {7, 8}, nodes_from(9, 15)});
  EXPECT_THAT(parts[0], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(parts[1], IsEmpty());
  EXPECT_THAT(parts[2], ElementsAre(9, 10, 11, 12, 13, 14, 15, 8));
}

TEST(DissolveParts, LeavesAPartAsItWasIfOneOfItsNodesFindsNoRoom) {
  // Node 9 finds room, and node 8 does not.
  const NodeGraph graph = node_line(17, chain(0, 16));
  const NodeParts parts = dissolved(graph, {nodes_from(0, 7), {8, 9}, nodes_from(10, 16)});
  EXPECT_THAT(parts[1], ElementsAre(8, 9));
  EXPECT_THAT(parts[2], ElementsAre(10, 11, 12, 13, 14, 15, 16));
}

TEST(DissolveParts, MovesANodeThatIsLinkedOnlyWithOneThatHasMoved) {
  const NodeGraph graph = node_line(8, chain(0, 7));
  const NodeParts parts = dissolved(graph, {nodes_from(0, 5), {7, 6}});
  EXPECT_THAT(parts[0], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(DissolveParts, MakesNoPartMuchWider) {
  auto links = chain(0, 7);
  links.emplace_back(8, 14);
  for (const auto& link : chain(14, 20)) links.push_back(link);
  const NodeGraph graph = node_line(21, links);
  const NodeParts parts = dissolved(graph, {nodes_from(0, 7), {8}, nodes_from(14, 20)});
  EXPECT_THAT(parts[1], ElementsAre(8));
}

}  // namespace
}  // namespace meshhood::test
