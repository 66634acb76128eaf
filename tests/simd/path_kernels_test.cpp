// SPDX-License-Identifier: MIT
// The kernels of paths give the results of plain loops, with the same bits on every processor.
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "simd/aggregate.h"
#include "simd/joint.h"
#include "support/exact_answer.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class EveryPathKernel : public testing::TestWithParam<Isa> {
 protected:
  static constexpr std::uint32_t kVertices = 8;

  /// Lengths of which many are equal, so that sums are too, and some are infinite.
  double length() {
    switch (random.below(8)) {
      case 0: return std::numeric_limits<double>::infinity();
      case 1: return 0;
      case 2: return std::numeric_limits<double>::denorm_min() * static_cast<double>(random.below(4));
      case 3: return std::numeric_limits<double>::max() / static_cast<double>(1 + random.below(3));
      case 4: return random.uniform(0, 3);
      default: return static_cast<double>(random.below(4));
    }
  }

  void draw() {
    for (PathLengths& lengths : *all) {
      for (double& value : lengths) value = length();
    }
    edges.resize(random.below(33));
    for (PathEdge& edge : edges) edge = {length(), 1 + static_cast<std::uint32_t>(random.below(kVertices - 1))};
  }

  const PathKernels& kernels = path_kernels(GetParam());
  Random random{44};
  std::unique_ptr<std::array<PathLengths, kVertices>> all = std::make_unique<std::array<PathLengths, kVertices>>();
  std::vector<PathEdge> edges;
};

TEST_P(EveryPathKernel, FollowsEdges) {
  for (std::size_t round = 0; round < scaled(20000, 2000); ++round) {
    draw();
    auto expected = std::make_unique<std::array<PathLengths, kVertices>>(*all);
    std::uint32_t shorter = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t lane = 0; lane < kPacketCapacity; ++lane) {
        double& to = (*expected)[edges[i].end][lane];
        const double through = (*expected)[0][lane] + edges[i].length;
        if (!(through < to)) continue;
        to = through;
        shorter |= std::uint32_t{1} << i;
      }
    }
    ASSERT_EQ(kernels.follow_edges((*all)[0], edges, all->data()), shorter);
    ASSERT_EQ(std::memcmp(all->data(), expected->data(), sizeof(*all)), 0);
  }
}

TEST_P(EveryPathKernel, FindsWhatIsWithinLimits) {
  for (std::size_t round = 0; round < scaled(20000, 2000); ++round) {
    draw();
    (*all)[1][random.below(kPacketCapacity)] = -1;
    QueryWord expected = 0;
    for (std::size_t lane = 0; lane < kPacketCapacity; ++lane) {
      expected |= QueryWord{(*all)[0][lane] <= (*all)[1][lane]} << lane;
    }
    ASSERT_EQ(kernels.within_limits((*all)[0], (*all)[1]), expected);
  }
}

TEST_P(EveryPathKernel, WeighsLengths) {
  for (std::size_t round = 0; round < scaled(20000, 2000); ++round) {
    draw();
    for (const SmoothingKernel kernel :
         {SmoothingKernel::Epanechnikov, SmoothingKernel::Biweight, SmoothingKernel::Gaussian}) {
      PerLane<double> weights;
      aggregate_kernels(GetParam()).set_path_weights((*all)[0], (*all)[1], kernel, weights);
      for (std::size_t lane = 0; lane < kPacketCapacity; ++lane) {
        const double length = (*all)[0][lane];
        const double radius = (*all)[1][lane];
        if (!(length <= radius) || radius == 0 || length == std::numeric_limits<double>::infinity()) continue;
        ASSERT_EQ(weights[lane], smoothing_weight(kernel, length, radius));
        if (length == radius && kernel != SmoothingKernel::Gaussian) {
          ASSERT_EQ(weights[lane], 0);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Isas, EveryPathKernel, testing::ValuesIn(available_isas()));

}  // namespace
}  // namespace meshhood::test
