// SPDX-License-Identifier: MIT
// Sums of many channels over listed rows, against those of each channel by itself over nodes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/meshhood.h"

#include "aggregate/reducers.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

constexpr std::size_t kChannels = 37;  // more than a block, and not a multiple of one

struct Values {
  std::vector<double> values;
  std::vector<double> weights;

  [[nodiscard]] SignalView view() const { return {values, kChannels, weights}; }
  [[nodiscard]] std::vector<double> channel(std::size_t c) const {
    std::vector<double> result;
    for (std::size_t i = c; i < values.size(); i += kChannels) result.push_back(values[i]);
    return result;
  }
};

Values draw(std::size_t vertices, bool gaps) {
  Random random(vertices);
  Values result;
  for (std::size_t i = 0; i < vertices * kChannels; ++i) {
    result.values.push_back(gaps && i % 11 == 0 ? std::nan("") : random.uniform(-1, 1));
  }
  for (std::size_t v = 0; v < vertices; ++v) result.weights.push_back(v % 7 == 0 ? 0 : random.uniform(0.1, 2));
  return result;
}

MESHHOOD_SUITE_OF_FAMILIES(ListedSumsOf);

TEST_P(ListedSumsOf, ManyChannelsAreThoseOfEachByItself) {
  const TestMesh mesh = make_mesh(GetParam(), 5, scaled(400, 120));
  if (mesh.size() == 0) return;
  const Index index = build(mesh.view());
  const GraphData graph = extract_graph(index);
  const double radius = 3 * mean_edge_length(graph.view());
  std::size_t listed = 0;
  for (const bool gaps : {false, true}) {
    const Values drawn = draw(mesh.size(), gaps);
    for (const Reduce reduce : {Reduce::Sum, Reduce::Mean}) {
      for (const SmoothingKernel kernel :
           {SmoothingKernel::Epanechnikov, SmoothingKernel::Biweight, SmoothingKernel::Gaussian}) {
        const AggregateQuery query{.radius = radius,
                                   .reduce = {reduce},
                                   .kernel = kernel,
                                   .missing = gaps ? MissingValues::Omit : MissingValues::Propagate};
        listed += is_better_listed(index, drawn.view(), query, radius, {}) ? 1 : 0;
        const std::vector<double> together = aggregate(index, drawn.view(), query, {.threads = 2});
        EXPECT_THAT(aggregate(index, drawn.view(), query, {.threads = 1}),
                    testing::Pointwise(testing::NanSensitiveDoubleEq(), together));
        for (const std::size_t c : {std::size_t{0}, kChannels - 1}) {
          const std::vector<double> values = drawn.channel(c);
          const std::vector<double> alone = aggregate(index, {values, 1, drawn.weights}, query);
          for (std::size_t v = 0; v < mesh.size(); ++v) {
            const double found = together[v * kChannels + c];
            if (std::isnan(alone[v])) {
              ASSERT_TRUE(std::isnan(found)) << "vertex " << v;
            } else {
              ASSERT_NEAR(found, alone[v], 1e-12 * std::max(1.0, std::abs(alone[v]))) << "vertex " << v;
            }
          }
        }
      }
    }
  }
  std::printf("%s: %zu of 12 calls listed\n", std::string(GetParam().name).c_str(), listed);
}

TEST(ListedSums, AreForManyChannelsOfModerateValuesOverSmallNeighborhoods) {
  const auto [mesh, index] = indexed(make_grid(40, 40, false));
  const AggregateQuery mean{.radius = 3.0, .kernel = SmoothingKernel::Biweight};
  Values drawn = draw(mesh.size(), false);
  EXPECT_TRUE(is_better_listed(index, drawn.view(), mean, 3, {}));
  EXPECT_FALSE(is_better_listed(index, drawn.view(), mean, 100, {}));
  EXPECT_FALSE(is_better_listed(index, drawn.view(), {.radius = 3.0}, 3, {}));
  const std::vector<double> few(mesh.size() * 16, 1.0);
  EXPECT_FALSE(is_better_listed(index, {few, 16}, mean, 3, {}));
  // The weights of a Gaussian serve some channels without a list, too.
  const AggregateQuery smooth{.radius = 3.0, .kernel = SmoothingKernel::Gaussian};
  const std::vector<double> many(mesh.size() * 48, 1.0);
  EXPECT_TRUE(is_better_listed(index, drawn.view(), smooth, 3, {}));
  EXPECT_FALSE(is_better_listed(index, drawn.view(), smooth, 6, {}));
  EXPECT_TRUE(is_better_listed(index, {many, 48}, smooth, 6, {}));
  drawn.values[5] = 1e200;
  EXPECT_FALSE(is_better_listed(index, drawn.view(), mean, 3, {}));
}

}  // namespace
}  // namespace meshhood::test
