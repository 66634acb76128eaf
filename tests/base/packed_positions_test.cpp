// SPDX-License-Identifier: MIT
#include "base/packed_positions.h"

#include <cstddef>
#include <span>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

namespace meshhood::test {
namespace {

using testing::ElementsAre;

TEST(PackedPositions, AreRowsOfPositionsByColumns) {
  const std::vector<double> columns{0, 1, 2, 3, 4, 5};
  const PackedPositions<double> packed({columns.data(), 2, 1, 2});
  EXPECT_THAT(packed.view(), ElementsAre(0, 2, 4, 1, 3, 5));
}

TEST(RowsOf, AreInTheOrderOfTheVertices) {
  const std::vector<double> xyz{0, 1, 2, 3, 4, 5, 6, 7, 8};
  const std::vector<VertexId> vertices{2, 0, 2};
  EXPECT_THAT(rows_of(std::span<const double>(xyz), std::span<const VertexId>(vertices)),
              ElementsAre(6, 7, 8, 0, 1, 2, 6, 7, 8));
}

/// Positions of so many vertices that a place does not fit into an id. Only the pages that are used take memory.
class ManyPositions {
 public:
  explicit ManyPositions(std::size_t vertices)
      : bytes_(3 * vertices * sizeof(float)),
        memory_(::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {}
  ManyPositions(const ManyPositions&) = delete;
  ManyPositions& operator=(const ManyPositions&) = delete;
  ~ManyPositions() {
    if (is_mapped()) ::munmap(memory_, bytes_);
  }

  [[nodiscard]] bool is_mapped() const { return memory_ != MAP_FAILED; }
  [[nodiscard]] std::span<float> all() const { return {static_cast<float*>(memory_), bytes_ / sizeof(float)}; }

 private:
  std::size_t bytes_;
  void* memory_;
};

TEST(RowsOf, AreThoseOfVerticesWhosePlacesExceedTheirIds) {
  constexpr VertexId kVertex = 1'431'655'766;  // 3 times this is 2^32 + 2
  const ManyPositions positions(std::size_t{kVertex} + 1);
  if (sizeof(std::size_t) == 4 || !positions.is_mapped()) GTEST_SKIP() << "no 17 GB of addresses";
  positions.all()[3 * std::size_t{kVertex}] = 7;
  positions.all()[2] = 1;
  EXPECT_THAT(rows_of(std::span<const float>(positions.all()), std::vector{kVertex}), ElementsAre(7, 0, 0));
}

}  // namespace
}  // namespace meshhood::test
