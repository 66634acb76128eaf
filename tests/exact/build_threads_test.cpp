// SPDX-License-Identifier: MIT
// A build on several threads gives the same bytes, and can be cancelled.
#include <cstdio>
#include <new>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "support/families.h"
#include "support/refusal.h"
#include "support/reports.h"
#include "support/same_storage.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

void expect_the_same_for_any_threads(const MeshView& mesh) {
  const Index expected = build(mesh, {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    EXPECT_THAT(differences(build(mesh, {.threads = threads}), expected), IsEmpty()) << threads << " threads";
  }
}

TEST(ThreadedBuild, GivesTheSameBytesOnAllFamilies) {
  std::size_t meshes = 0;
  for (const Family& family : families()) {
    for (const std::size_t vertices : {50U, 20000U}) {
      const TestMesh mesh = make_mesh(family, 3, vertices);
      SCOPED_TRACE(mesh.name);
      expect_the_same_for_any_threads(mesh.view());
      ++meshes;
    }
  }
  std::printf("%zu meshes\n", meshes);
}

TEST(ThreadedBuild, RejectsTooManyThreads) {
  expect_refused(ErrorCode::InvalidOption, "threads is 1025, expected at most 1024",
                 [] { return build(MeshView{}, {.threads = 1025}); });
}

TEST(ThreadedBuild, ReportsAndCanBeCancelledAtAnyReport) {
  const TestMesh mesh = make_grid(300, 300, false).finish(true);
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    const auto call = [&](const Progress& progress) {
      static_cast<void>(build(mesh.view(), {.threads = threads, .progress = progress}));
    };
    const Reports reports = reports_of(call);
    expect_from_nothing_to_all(reports);
    EXPECT_EQ(reports.back().second, 7U);
    for (const std::size_t last : {0U, 1U}) expect_cancelled_at(last, call);
  }
}

TEST(ThreadedBuild, PassesOnExceptionsOfTheProgressCallback) {
  const TestMesh mesh = make_grid(300, 300, false).finish(true);
  const auto progress = [](std::size_t done, std::size_t) -> bool {
    if (done > 0) throw std::bad_alloc();
    return true;
  };
  for (const unsigned threads : {1U, 2U, 8U}) {
    EXPECT_THROW(static_cast<void>(build(mesh.view(), {.threads = threads, .progress = progress})), std::bad_alloc);
  }
}

}  // namespace
}  // namespace meshhood::test
