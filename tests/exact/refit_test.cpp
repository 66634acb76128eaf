// SPDX-License-Identifier: MIT
// Indexes of meshes whose vertices have moved: answers, what is shared, what fails, and searchers of the state before.
#include "meshhood/refit.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numeric>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/index_bytes.h"
#include "support/indexed.h"
#include "support/oracle.h"
#include "support/refusal.h"
#include "support/reports.h"
#include "support/same_storage.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

/// A way to move vertices. Keeps coordinates below their limit.
struct Deformation {
  const char* name;
  void (*move)(Random& random, std::vector<double>& positions);
};

const std::vector<Deformation>& deformations() {
  static const std::vector<Deformation> all{
      {"noise",
       [](Random& random, std::vector<double>& xyz) {
         for (double& x : xyz) x *= random.uniform(0.8, 1.0);
       }},
      {"smaller",
       [](Random&, std::vector<double>& xyz) {
         for (double& x : xyz) x *= 0x1p-90;
       }},
      {"flat",
       [](Random&, std::vector<double>& xyz) {
         for (std::size_t i = 2; i < xyz.size(); i += 3) xyz[i] = 0;
       }},
      {"one point", [](Random&, std::vector<double>& xyz) { std::fill(xyz.begin(), xyz.end(), 0.75); }},
      {"folded",
       [](Random&, std::vector<double>& xyz) {
         for (double& x : xyz) x = std::abs(x - xyz[0] / 2) / 2;
       }},
      {"twisted",
       [](Random&, std::vector<double>& xyz) {
         for (std::size_t i = 0; i < xyz.size(); i += 3) {
           const double angle = 20 * static_cast<double>(i) / static_cast<double>(xyz.size());
           const double y = xyz[i + 1] / 2;
           const double z = xyz[i + 2] / 2;
           xyz[i + 1] = std::cos(angle) * y - std::sin(angle) * z;
           xyz[i + 2] = std::sin(angle) * y + std::cos(angle) * z;
         }
       }},
      {"exchanged",
       [](Random& random, std::vector<double>& xyz) {
         for (std::size_t v = xyz.size() / 3; v > 1; --v) {
           const std::size_t other = random.below(v);
           for (std::size_t axis = 0; axis < 3; ++axis) std::swap(xyz[3 * v - 3 + axis], xyz[3 * other + axis]);
         }
       }},
  };
  return all;
}

TestMesh deformed(const TestMesh& mesh, const std::function<void(std::vector<double>&)>& move) {
  TestMesh result = mesh;
  move(result.positions);
  return result.finish(mesh.single_precision);
}

/// Queries at random vertices and at all radii at which errors are likely, compared with the oracle.
std::size_t expect_right_answers(const Index& index, const TestMesh& mesh, Random& random, std::size_t vertices) {
  const Oracle oracle(mesh);
  std::vector<Searcher> searchers = searchers_of(index);
  std::vector<VertexId> ids;
  std::size_t queries = 0;
  for (std::size_t i = 0; i < vertices && mesh.size() > 0; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    for (const double radius : draw_radii(random, oracle, v)) {
      searchers[queries++ % searchers.size()].neighborhood(v, radius, ids);
      EXPECT_EQ(sorted(ids), oracle.exact(v, radius)) << "vertex " << v << ", radius " << radius;
    }
  }
  return queries;
}

MESHHOOD_SUITE_OF_FAMILIES(RefitFamilies);

TEST_P(RefitFamilies, AnswersAreThoseOfTheOracle) {
  std::size_t queries = 0;
  for (const std::size_t vertices : {1U, 3U, 40U, 300U, 1500U}) {
    const auto [mesh, index] = indexed(make_mesh(GetParam(), vertices, vertices));
    for (const Deformation& deformation : deformations()) {
      SCOPED_TRACE(mesh.name + ", " + deformation.name);
      Random random(vertices);
      const TestMesh moved = deformed(mesh, [&](auto& xyz) { deformation.move(random, xyz); });
      const Index refitted = refit(index, moved.positions_view());
      EXPECT_THAT(refitted.check(moved.view()), IsEmpty());
      queries += expect_right_answers(refitted, moved, random, scaled(8, 2));
      ASSERT_FALSE(HasFailure());
    }
  }
  std::printf("%zu queries\n", queries);
}

TEST_P(RefitFamilies, WithTheSamePositionsGivesTheSameIndex) {
  for (const std::size_t vertices : {1U, 50U, 2000U}) {
    const auto [mesh, index] = indexed(make_mesh(GetParam(), 7, vertices));
    EXPECT_THAT(differences(refit(index, mesh.positions_view()), index), IsEmpty());
    EXPECT_THAT(differences(refit(index, mesh.positions_view(), {.threads = 3}), index), IsEmpty());
    const ReorderedMesh reordered = reorder(mesh.view());
    EXPECT_THAT(differences(refit(reordered.index, reordered.index.positions()), reordered.index), IsEmpty());
  }
}

/// Moves some vertices to places between others, again and again.
TEST_P(RefitFamilies, OfSomeVerticesGivesTheAnswersOfTheOracle) {
  std::size_t queries = 0;
  for (const std::size_t vertices : {2U, 60U, 900U}) {
    TestMesh mesh = make_mesh(GetParam(), 11 + vertices, vertices);
    Index index = build(mesh.view());
    Random random(vertices);
    for (int step = 0; step < 6 && mesh.size() > 0; ++step) {
      std::vector<std::uint32_t> changed;
      mesh = deformed(mesh, [&](std::vector<double>& xyz) {
        for (std::size_t i = 0; i < 1 + mesh.size() / 20; ++i) {
          const std::size_t v = random.below(mesh.size());
          const std::size_t w = random.below(mesh.size());
          changed.push_back(static_cast<std::uint32_t>(v));
          for (std::size_t axis = 0; axis < 3; ++axis) {
            xyz[3 * v + axis] = 0.7 * xyz[3 * v + axis] + 0.3 * xyz[3 * w + axis];
          }
        }
      });
      index.refit_in_place(mesh.positions_view(), changed);
      EXPECT_THAT(index.check(mesh.view()), IsEmpty());
      queries += expect_right_answers(index, mesh, random, scaled(4, 1));
      ASSERT_FALSE(HasFailure());
    }
  }
  std::printf("%zu queries\n", queries);
}

/// Some vertices inside the bounding box of a grid, and the mesh in which they have moved inside it.
class RefitOfGrid : public testing::Test {
 protected:
  TestMesh mesh = bumpy_grid(60);
  TestMesh moved = mesh;
  std::vector<std::int64_t> changed;
  Index index = build(mesh.view());

  RefitOfGrid() {
    for (std::size_t v = 25 * 60 + 20; v < 35 * 60; v += v % 60 == 40 ? 40 : 1) {
      changed.push_back(static_cast<std::int64_t>(v));
      moved.positions[3 * v] += 0.3;
      moved.positions[3 * v + 1] -= 0.2;
    }
    moved.finish(true);
  }
};

TEST_F(RefitOfGrid, OfTheChangedVerticesHasTheNodesOfARefitOfAll) {
  const Index all = refit(index, moved.positions_view());
  const Index some = refit(index, moved.positions_view(), changed);
  EXPECT_FALSE(differences(all, index).empty());
  EXPECT_THAT(differences(some, all), IsEmpty());
  EXPECT_THAT(some.check(moved.view()), IsEmpty());
  EXPECT_THAT(differences(index, build(mesh.view())), IsEmpty());
}

/// The path distances of the vertices of the mesh from vertex 0, by their ids.
std::vector<double> path_distances(const Index& index) {
  std::vector<VertexId> ids;
  std::vector<double> distances;
  Searcher(index, Metric::Path).neighborhood(0, kInfinity, ids, distances);
  std::vector<double> result(index.vertex_count(), kInfinity);
  for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]] = distances[i];
  return result;
}

// The first search makes a graph with the lengths of the edges, which the index keeps.
TEST_F(RefitOfGrid, LengthsOfEdgesAreThoseOfTheNewPositions) {
  const std::vector<double> before = path_distances(index);
  const std::vector<double> expected = path_distances(build(moved.view()));
  ASSERT_NE(before, expected);
  EXPECT_EQ(path_distances(refit(index, moved.positions_view())), expected);
  EXPECT_EQ(path_distances(refit(index, moved.positions_view(), changed)), expected);
  EXPECT_EQ(path_distances(index), before);
  index.refit_in_place(moved.positions_view(), changed);
  EXPECT_EQ(path_distances(index), expected);
}

TEST_F(RefitOfGrid, ReadsOnlyThePositionsOfTheChangedVertices) {
  const Index expected = refit(index, moved.positions_view(), changed);
  std::vector<float> poisoned(moved.single_positions.size(), std::nanf(""));
  for (const std::int64_t v : changed) {
    std::copy_n(&moved.single_positions[3 * static_cast<std::size_t>(v)], 3,
                &poisoned[3 * static_cast<std::size_t>(v)]);
  }
  EXPECT_THAT(differences(refit(index, poisoned, changed), expected), IsEmpty());
}

TEST_F(RefitOfGrid, OfVerticesThatLeaveTheFrameIsARefitOfAll) {
  moved.positions[3 * static_cast<std::size_t>(changed[7])] = 1e6;
  moved.finish(true);
  const Index all = refit(index, moved.positions_view());
  EXPECT_THAT(differences(refit(index, moved.positions_view(), changed), all), IsEmpty());
  Index own = build(mesh.view());
  own.refit_in_place(moved.positions_view(), changed);
  EXPECT_THAT(differences(own, all), IsEmpty());
}

TEST(Refit, IsTheSameForAnyNumberOfThreads) {
  const TestMesh mesh = bumpy_grid(160);
  TestMesh moved = mesh;
  for (double& x : moved.positions) x *= 0.9;
  moved.finish(true);
  std::vector<std::uint32_t> changed(mesh.size());
  std::iota(changed.begin(), changed.end(), 0U);
  const Index index = build(mesh.view());
  const Index expected = refit(index, moved.positions_view(), {.threads = 1});
  EXPECT_THAT(differences(refit(index, moved.positions_view(), {.threads = 4}), expected), IsEmpty());
  const Index some = refit(index, moved.positions_view(), changed, {.threads = 1});
  EXPECT_THAT(differences(refit(index, moved.positions_view(), changed, {.threads = 4}), some), IsEmpty());
}

TEST(Refit, OfAMeshWithoutVerticesHasNone) {
  const TestMesh mesh;
  const Index index = build(mesh.view());
  EXPECT_EQ(refit(index, mesh.positions_view()).vertex_count(), 0U);
  const std::vector<std::uint32_t> none;
  EXPECT_EQ(refit(index, mesh.positions_view(), none).vertex_count(), 0U);
}

TEST(Refit, TakesTheTypeOfTheNewPositions) {
  TestMesh mesh = bumpy_grid(20);
  const Index single = build(mesh.view());
  for (double& x : mesh.positions) x += 0.1;
  const Index twice = refit(single, mesh.positions);
  EXPECT_THAT(twice.check({mesh.positions, mesh.view().faces}), IsEmpty());
  Random random(1);
  mesh.finish(false);
  expect_right_answers(twice, mesh, random, 20);
}

TEST_F(RefitOfGrid, HasTheFingerprintOfTheMovedMeshAndCanBeSavedAndLoaded) {
  // The frame is then larger than the positions need.
  TestMesh smaller = mesh;
  for (double& x : smaller.positions) x *= 0.125;
  smaller.finish(true);
  std::vector<std::uint32_t> every(smaller.size());
  std::iota(every.begin(), every.end(), 0U);
  const Index in_large_frame = refit(index, smaller.positions_view(), every);
  EXPECT_THAT(differences(load(saved(in_large_frame)), in_large_frame), IsEmpty());
  EXPECT_EQ(fingerprint(in_large_frame), fingerprint(smaller.view()));
}

TEST_F(RefitOfGrid, OfALoadedIndexWorksAndLeavesItAsItIs) {
  const std::vector<std::byte> file = saved(build(mesh.view()));
  Index loaded = load(file);
  const Index expected = refit(build(mesh.view()), moved.positions_view(), changed);
  EXPECT_THAT(differences(refit(loaded, moved.positions_view(), changed), expected), IsEmpty());
  EXPECT_EQ(saved(loaded), file);
  loaded.refit_in_place(moved.positions_view(), changed);
  EXPECT_THAT(differences(loaded, expected), IsEmpty());
}

const float* positions_of(const Index& index) {
  return std::get<std::span<const float>>(IndexAccess::view(index).positions).data();
}

TEST_F(RefitOfGrid, InPlaceHasTheIndexOfARefitInTheSameMemory) {
  const Searcher searcher(index);
  const float* const before = positions_of(index);
  index.refit_in_place(moved.positions_view(), changed);
  EXPECT_EQ(positions_of(index), before);
  EXPECT_THAT(differences(index, refit(build(mesh.view()), moved.positions_view())), IsEmpty());
  index.refit_in_place(mesh.positions_view());
  EXPECT_THAT(differences(index, build(mesh.view())), IsEmpty());
}

TEST(RefitInPlace, SearchersAskedForTheSameRadiusInAnotherFrameCompareWithItThere) {
  constexpr double kRadius = 120;
  TestMesh mesh = bumpy_grid(160).finish(false);
  Index index = build(mesh.view());
  Searcher searcher(index);
  const VertexId v = 160 * 80 + 80;
  EXPECT_EQ(searcher.count(v, kRadius), mesh.size());
  for (double& x : mesh.positions) x *= 4;
  index.refit_in_place(mesh.positions_view());
  searcher.rebind(index);
  const std::vector<VertexId> found = searcher.neighborhood(v, kRadius);
  EXPECT_EQ(found, Searcher(index).neighborhood(v, kRadius));
  EXPECT_LT(found.size(), mesh.size() / 4);
}

/// Moves some vertices, then more of them out of the frame, then all.
TEST_P(RefitFamilies, SearchersThatAreBoundAgainGiveTheAnswersOfNewOnes) {
  TestMesh mesh = make_mesh(GetParam(), 5, 400);
  if (mesh.size() == 0) return;
  for (double& x : mesh.positions) x *= 0.25;  // so that there is room for larger numbers
  mesh.finish(mesh.single_precision);
  Index index = build(mesh.view());
  Searcher searcher(index);
  Searcher regions(index);
  Searcher edges(index, Metric::Path);
  Random random(17);
  const double fixed = 0.4 * distance(mesh.positions_view(), 0, static_cast<VertexId>(mesh.size() / 2));
  std::vector<VertexId> changed;
  for (VertexId v = 0; v < mesh.size(); v += 3) changed.push_back(v);
  for (int step = 0; step < 6; ++step) {
    for (const VertexId v : changed) mesh.positions[3 * std::size_t{v}] *= step == 3 ? 1.5 : random.uniform(0.7, 1.0);
    mesh.finish(mesh.single_precision);
    if (step == 5) {
      index.refit_in_place(mesh.positions_view());
    } else {
      index.refit_in_place(mesh.positions_view(), changed);
    }
    searcher.rebind(index);
    regions.rebind(index);
    edges.rebind(index);
    EXPECT_EQ(path_distances(index), path_distances(build(mesh.view())));
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const auto w = static_cast<VertexId>(random.below(mesh.size()));
    const double far = distance(mesh.positions_view(), v, w);
    for (const double radius : {fixed, 0.3 * far, far, fixed}) {  // the last one is also that before the next refit
      const std::array seeds{w};
      const Start start({0, 0, 0}, seeds);
      EXPECT_EQ(searcher.neighborhood(v, radius), Searcher(index).neighborhood(v, radius));
      EXPECT_EQ(regions.neighborhood(v, radius), Searcher(index).neighborhood(v, radius));
      EXPECT_EQ(regions.neighborhood(start, radius), Searcher(index).neighborhood(start, radius));
      EXPECT_EQ(edges.neighborhood(v, radius), Searcher(index, Metric::Path).neighborhood(v, radius));
    }
  }
}

TEST(Searchers, AreBoundToAnotherIndex) {
  const TestMesh small = bumpy_grid(20);
  const TestMesh large = bumpy_grid(70);
  const Index first = build(small.view());
  const Index second = build(large.view());
  Searcher searcher(first);
  Searcher moved = std::move(searcher);
  searcher.rebind(second);  // NOLINT(bugprone-use-after-move): that binds it again
  EXPECT_EQ(searcher.neighborhood(2450, 5), Searcher(second).neighborhood(2450, 5));
  moved.rebind(second);
  EXPECT_EQ(moved.neighborhood(2450, 5), Searcher(second).neighborhood(2450, 5));
}

/// Two components far apart; a vertex of one moves next to the other.
TEST(Refit, OfSomeVerticesIsKnownToTheSearchForTheNearestVertex) {
  TestMesh mesh = bumpy_grid(40);
  TestMesh other = mesh;
  for (std::size_t i = 0; i < other.positions.size(); i += 3) other.positions[i] += 200;
  append(mesh, other);
  mesh.finish(false);
  Index index = build(mesh.view());
  const std::vector<VertexId> changed{820};
  const SpacePoint place{180, 20, 0};
  std::copy(place.begin(), place.end(), mesh.positions.begin() + std::ptrdiff_t{3} * 820);
  EXPECT_EQ(nearest(refit(index, mesh.positions, changed), place).vertex, 820U);
  index.refit_in_place(mesh.positions, changed);
  EXPECT_EQ(nearest(index, place).vertex, 820U);
}

// Each thread takes the present index, searches it while the next one is made from it, and releases it.
TEST_F(RefitOfGrid, LetsOtherThreadsSearchTheOldState) {
  const Oracle even(mesh);
  const Oracle odd(moved);
  const auto center = static_cast<VertexId>(changed[changed.size() / 2]);
  const std::array<std::vector<std::uint32_t>, 2> answers = {even.exact(center, 4), odd.exact(center, 4)};
  ASSERT_NE(answers[0], answers[1]);
  std::atomic<std::size_t> wrong = 0;
  std::atomic<std::size_t> searched = 0;
  for (std::size_t step = 0; step < scaled(200, 20); ++step) {
    std::vector<std::thread> threads;
    std::atomic<std::size_t> ready = 0;
    for (int t = 0; t < 3; ++t) {
      threads.emplace_back([&, step, searcher = Searcher(index)]() mutable {
        ++ready;
        std::vector<VertexId> ids;
        for (int i = 0; i < 20; ++i) {
          searcher.neighborhood(center, 4, ids);
          if (sorted(ids) != answers[step % 2]) ++wrong;
          ++searched;
        }
      });
    }
    while (ready == 0) std::this_thread::yield();
    const TestMesh& next = step % 2 == 0 ? moved : mesh;
    index = refit(index, next.positions_view(), changed);
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(wrong, 0U);
  std::printf("%zu searches\n", searched.load());
}

TEST_F(RefitOfGrid, RefusesPositionsByTheVertexAtFault) {
  std::vector<float> xyz = moved.single_positions;
  const auto bad = static_cast<std::size_t>(changed[5]);
  xyz[3 * bad + 1] = std::nanf("");
  const std::string fault = "vertex " + std::to_string(bad) + ": y is nan, expected a finite number";
  expect_refused(ErrorCode::InvalidMesh, fault, [&] { return refit(index, xyz); });
  expect_refused(ErrorCode::InvalidMesh, fault, [&] { return refit(index, xyz, changed); });
  std::vector<double> large(xyz.size(), 0.5);
  large[3 * bad] = 0x1p501;
  expect_refused(ErrorCode::InvalidMesh, "vertex " + std::to_string(bad) + ": x is ",
                 [&] { return refit(index, large); });
  xyz.resize(xyz.size() - 3);
  const char* const size = "10797 coordinates, but the index has 3600 vertices";
  expect_refused(ErrorCode::InvalidMesh, size, [&] { return refit(index, xyz); });
  expect_refused(ErrorCode::InvalidMesh, size, [&] { return refit(index, xyz, changed); });
}

TEST_F(RefitOfGrid, RefusesChangedVerticesByTheRowAtFault) {
  const auto expect = [&](const char* fault, const auto& wrong) {
    expect_refused(ErrorCode::VertexOutOfRange, fault, [&] { return refit(index, moved.positions_view(), wrong); });
  };
  expect("changed: row 2: vertex 3600, but the mesh has 3600 vertices", std::vector<std::uint32_t>{0, 3599, 3600});
  expect("changed: row 0: vertex -1, but", std::vector<std::int32_t>{-1});
  expect("changed: row 1: vertex 4294967296, but", std::vector<std::uint64_t>{7, std::uint64_t{1} << 32});
}

TEST_F(RefitOfGrid, RefusesToRoundDoublesToAnIndexInFloat) {
  expect_refused(ErrorCode::InvalidMesh, "the positions are double, but those of the index are float",
                 [&] { return refit(index, moved.positions, changed); });
  // The reverse loses nothing.
  const Index twice = build({mesh.positions, mesh.view().faces});
  const Index refitted = refit(twice, moved.single_positions, changed);
  EXPECT_THAT(refitted.check({moved.positions, moved.view().faces}), IsEmpty());
}

TEST_F(RefitOfGrid, LeavesTheIndexUnchangedIfItFails) {
  const std::vector<std::byte> before = saved(index);
  std::vector<float> xyz = moved.single_positions;
  xyz[3 * static_cast<std::size_t>(changed.back())] = std::nanf("");
  EXPECT_THROW(index.refit_in_place(xyz, changed), Error);
  EXPECT_THROW(index.refit_in_place(xyz), Error);
  EXPECT_EQ(saved(index), before);
  std::size_t cancelled = 0;
  for (std::size_t last = 1; last < 8; ++last) {
    std::size_t reports = 0;
    const auto give_up = [&](std::size_t, std::size_t) { return ++reports < last; };
    try {
      index.refit_in_place(moved.positions_view(), changed, {.progress = give_up});
      break;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::Cancelled);
      EXPECT_EQ(saved(index), before);
      ++cancelled;
    }
  }
  EXPECT_GE(cancelled, 2U) << "at the beginning, and when all is written";
  EXPECT_NE(saved(index), before);
}

TEST_F(RefitOfGrid, ReportsProgressFromZeroToTheTotal) {
  const auto of_all = [&](const Progress& progress) {
    static_cast<void>(refit(index, moved.positions_view(), {.progress = progress}));
  };
  const auto of_some = [&](const Progress& progress) {
    static_cast<void>(refit(index, moved.positions_view(), changed, {.progress = progress}));
  };
  for (const Reports& reports : {reports_of(of_all), reports_of(of_some)}) {
    expect_from_nothing_to_all(reports);
    EXPECT_EQ(reports.back().second, 3U);
  }
}

}  // namespace
}  // namespace meshhood::test
