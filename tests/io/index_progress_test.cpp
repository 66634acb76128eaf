// SPDX-License-Identifier: MIT
// Progress and cancellation of loading and saving an index.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "io/index_io.h"
#include "support/index_bytes.h"
#include "support/reports.h"
#include "support/scratch.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

/// One polygon of a thousand corners.
TestMesh make_polygon() {
  constexpr std::uint32_t kCorners = 1000;
  TestMesh mesh;
  std::vector<std::uint32_t> face;
  for (std::uint32_t i = 0; i < kCorners; ++i) face.push_back(mesh.add_vertex(std::cos(i), std::sin(i), 0.001 * i));
  mesh.add_face(face);
  return mesh.finish(false);
}

/// Every function that loads or maps an index with verification.
class IndexProgress : public testing::Test {
 protected:
  using Load = std::function<Index(const Progress&)>;

  [[nodiscard]] std::vector<Load> loads() {
    return {[this](const Progress& progress) { return load(bytes_, {.progress = progress}); },
            [this](const Progress& progress) { return map(mappable_.bytes(), nullptr, {}, {.progress = progress}); },
            [this](const Progress& progress) { return io::load(path_, {.progress = progress}); },
            [this](const Progress& progress) { return io::map(path_, {}, {.progress = progress}); }};
  }

 private:
  std::vector<std::byte> bytes_ = saved(build(make_polygon().view()));
  Mappable mappable_{bytes_};
  Scratch scratch_;
  std::filesystem::path path_ = scratch_.write("index", {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()});
};

TEST_F(IndexProgress, ReportsFromZeroToTheTotal) {
  for (const Load& load : loads()) expect_from_nothing_to_all(reports_of(load), 10);
}

TEST_F(IndexProgress, CancelsLoadingAtAnyReport) {
  for (const Load& load : loads()) {
    const std::size_t all = reports_of(load).size();
    for (std::size_t last = 0; last < all; ++last) expect_cancelled_at(last, load);
  }
}

/// Every function that saves an index of either kind.
class IndexSaveProgress : public testing::Test {
 protected:
  /// The least number of reports of the core.
  static constexpr std::size_t kFewest = 25;

  using Save = std::function<void(const Progress&)>;

  static void ignore(std::span<const std::byte> /*bytes*/) {}

  [[nodiscard]] std::vector<Save> to_bytes() const {
    return {[this](const Progress& progress) { save(exact, ignore, {}, {.progress = progress}); },
            [this](const Progress& progress) { save(approximate, ignore, {.progress = progress}); }};
  }

  [[nodiscard]] std::vector<Save> to_files() const {
    return {[this](const Progress& progress) { io::save(path, exact, {}, {.progress = progress}); },
            [this](const Progress& progress) { io::save(path, approximate, {.progress = progress}); }};
  }

  TestMesh polygon = make_polygon();
  Index exact = build(polygon.view());
  paper::Index approximate = paper::build(polygon.view());
  Scratch scratch;
  std::filesystem::path path = scratch.write("index", "old");
};

TEST_F(IndexSaveProgress, ReportsFromZeroToTheTotal) {
  for (const Save& save : to_bytes()) expect_from_nothing_to_all(reports_of(save), 10);
  for (const Save& save : to_files()) expect_from_nothing_to_all(reports_of(save), 10);
}

TEST_F(IndexSaveProgress, CancelsSavingAtAnyReport) {
  for (const Save& save : to_bytes()) {
    for (std::size_t last = 0; last < kFewest; ++last) expect_cancelled_at(last, save);
  }
}

TEST_F(IndexSaveProgress, KeepsTheOldFileWhenCancelled) {
  for (const Save& save : to_files()) {
    for (std::size_t last = 0; last <= kFewest; ++last) {
      expect_cancelled_at(last, save);
      EXPECT_EQ(std::filesystem::file_size(path), 3U);
      EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 1);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
