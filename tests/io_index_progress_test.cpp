// SPDX-License-Identifier: MIT
// An index that is being loaded may be watched, and given up.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/error.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/serialize.h"

#include "index_bytes.h"
#include "io/index_io.h"
#include "refusal.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

/// The bytes of the index of one polygon of a thousand corners.
std::vector<std::byte> saved_polygon() {
  constexpr std::uint32_t kCorners = 1000;
  std::vector<double> xyz;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    xyz.insert(xyz.end(), {std::cos(i), std::sin(i), 0.001 * i});
    corners.push_back(i);
  }
  const std::vector<std::uint32_t> offsets{0, kCorners};
  return saved(build({xyz, FacesView::polygons(offsets, corners)}));
}

using Reports = std::vector<std::pair<std::size_t, std::size_t>>;

/// Every way to take an index that is not trusted, each with a `Progress`.
class IndexProgress : public testing::Test {
 protected:
  using Load = std::function<Index(const Progress&)>;

  [[nodiscard]] std::vector<Load> loads() {
    return {[this](const Progress& progress) { return load(bytes_, {.progress = progress}); },
            [this](const Progress& progress) { return map(mappable_.bytes(), nullptr, {.progress = progress}); },
            [this](const Progress& progress) { return io::load(path_, {.progress = progress}); },
            [this](const Progress& progress) { return io::map(path_, {.progress = progress}); }};
  }

  [[nodiscard]] static Reports reports_of(const Load& load) {
    Reports reports;
    static_cast<void>(load([&](std::size_t done, std::size_t total) {
      reports.emplace_back(done, total);
      return true;
    }));
    return reports;
  }

 private:
  std::vector<std::byte> bytes_ = saved_polygon();
  Mappable mappable_{bytes_};
  Scratch scratch_;
  std::filesystem::path path_ = scratch_.write("index", {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()});
};

TEST_F(IndexProgress, TellsFromNothingToAll) {
  for (const Load& load : loads()) {
    const Reports reports = reports_of(load);
    ASSERT_GE(reports.size(), 10U);
    EXPECT_EQ(reports.front().first, 0U);
    EXPECT_EQ(reports.back().first, reports.back().second);
    EXPECT_GT(reports.back().second, 0U);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    for (const auto& [done, total] : reports) EXPECT_EQ(total, reports.back().second);
    std::printf("%zu reports\n", reports.size());
  }
}

TEST_F(IndexProgress, EndsTheLoadingAtAnyReport) {
  for (const Load& load : loads()) {
    const std::size_t all = reports_of(load).size();
    for (std::size_t last = 0; last < all; ++last) {
      std::size_t reports = 0;
      expect_refused(ErrorCode::Cancelled, "cancelled",
                     [&] { static_cast<void>(load([&](std::size_t, std::size_t) { return reports++ < last; })); });
      EXPECT_EQ(reports, last + 1);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
