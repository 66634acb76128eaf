// SPDX-License-Identifier: MIT
// Meshes that are known to break other programs, in the order of the catalogue in docs/reliability.md: built, checked
// and queried. Rows A4 to A12, A15 and A16.
#include <algorithm>
#include <climits>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include "meshhood/meshhood.h"

#include "support/exact_answer.h"
#include "support/families.h"
#include "support/index_bytes.h"
#include "support/paper_bounds.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Ball {
  VertexId v;
  double radius;
};

/// Balls around vertices of the mesh, if it has any; some of them for the whole component.
std::vector<Ball> draw_balls(const TestMesh& mesh, std::size_t count) {
  std::vector<Ball> balls;
  Random random(7);
  for (std::size_t i = 0; mesh.size() > 0 && i < count; ++i) {
    const auto v = static_cast<VertexId>(i == 0 ? 0 : random.below(mesh.size()));
    const auto w = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = i % 10 == 0 ? kInfinity : distance(mesh.positions_view(), v, w) * random.uniform();
    balls.push_back({v, radius});
  }
  return balls;
}

/// Builds the exact index and compares answers with the reference. Returns the first error.
std::vector<std::string> faults_of_exact(const TestMesh& mesh, const std::vector<Ball>& balls) {
  ExactAnswer exact(mesh.view());
  std::vector<std::string> faults = exact.index().check(mesh.view());
  for (const auto& [v, radius] : balls) exact.query(v, radius);
  if (exact.mismatches() > 0) faults.emplace_back("exact answers differ");
  return faults;
}

/// Builds the paper's index with few and with all levels, and compares answers with the reference.
std::vector<std::string> faults_of_paper(const TestMesh& mesh, const std::vector<Ball>& balls) {
  std::vector<std::string> faults;
  ReferenceSearcher reference(mesh.view());
  for (const int levels : {5, paper::BuildOptions::kAllLevels}) {
    const paper::Index index = paper::build(mesh.view(), {.levels = levels});
    for (const std::string& fault : index.check(mesh.view())) faults.push_back(fault);
    paper::Searcher searcher(index);
    PaperBounds bounds(mesh.size());
    std::vector<VertexId> exact;
    std::vector<VertexId> answer;
    for (const Ball& ball : balls) {
      reference.neighborhood(ball.v, ball.radius, exact);
      searcher.neighborhood(ball.v, ball.radius, answer);
      const auto inside = [&](VertexId u) { return distance(mesh.positions_view(), ball.v, u) <= ball.radius; };
      if (!bounds.holds(exact, answer, inside)) faults.push_back("vertex " + std::to_string(ball.v));
    }
  }
  return faults;
}

std::vector<std::string> faults_of(const TestMesh& mesh, std::size_t queries) {
  const std::vector<Ball> balls = draw_balls(mesh, queries);
  std::vector<std::string> faults = faults_of_exact(mesh, balls);
  for (const std::string& fault : faults_of_paper(mesh, balls)) faults.push_back(fault);
  return faults;
}

void expect_sound(const TestMesh& mesh, std::size_t queries = 100) {
  EXPECT_THAT(faults_of(mesh, queries), IsEmpty());
  std::printf("%zu vertices, %zu faces, %zu queries\n", mesh.size(), mesh.face_count(), 3 * queries);
}

TestMesh family_mesh(std::string_view name, std::size_t vertices, bool single = true) {
  const auto all = families();
  Random random(1);
  TestMesh mesh = std::ranges::find(all, name, &Family::name)->make(random, vertices);
  return mesh.finish(single);
}

std::vector<VertexId> whole_answer(const TestMesh& mesh, VertexId v) {
  const paper::Index index = paper::build(mesh.view());
  std::vector<VertexId> out;
  paper::Searcher(index).neighborhood(v, kInfinity, out);
  std::sort(out.begin(), out.end());
  return out;
}

/// `searcher` of an empty mesh.
template <class AnySearcher>
void expect_no_vertex(AnySearcher&& searcher) {
  std::vector<VertexId> out;
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 0, but the mesh has 0 vertices",
                 [&] { searcher.neighborhood(0, 1, out); });
}

template <class AnySearcher, class AnyIndex>
void expect_empty(const AnyIndex& index) {
  EXPECT_EQ(index.vertex_count(), 0U);
  EXPECT_THAT(index.check(MeshView{}), IsEmpty());
  EXPECT_THAT(index.check(GraphView{}), IsEmpty());
  expect_no_vertex(AnySearcher(index));
}

// A4
TEST(Robustness, EmptyMesh) {
  expect_empty<Searcher>(build(MeshView{}));
  expect_empty<Searcher>(build(GraphView{}));
  expect_empty<Searcher>(load(saved(build(MeshView{}))));
  expect_empty<paper::Searcher>(paper::build(MeshView{}));
  expect_empty<paper::Searcher>(paper::build(GraphView{}));
  expect_empty<paper::Searcher>(paper::load(saved(paper::build(MeshView{}))));
  EXPECT_EQ(paper::build(MeshView{}).levels().size(), 1U);
  expect_no_vertex(ReferenceSearcher{MeshView{}});
}

// A4
TEST(Robustness, OneVertex) {
  TestMesh mesh;
  mesh.add_vertex(1, 2, 3);
  EXPECT_THAT(whole_answer(mesh.finish(true), 0), ElementsAre(0));
  expect_sound(mesh);
}

// A4
TEST(Robustness, NoFaces) {
  const TestMesh mesh = family_mesh("no faces", 1000);
  EXPECT_THAT(whole_answer(mesh, 500), ElementsAre(500));
  expect_sound(mesh);
}

// A5
TEST(Robustness, IsolatedVertices) {
  TestMesh mesh = make_grid(10, 10, false);
  for (int i = 0; i < 5000; ++i) mesh.add_vertex(i % 10, 0, 0);
  EXPECT_THAT(whole_answer(mesh.finish(true), 3000), ElementsAre(3000));
  EXPECT_EQ(whole_answer(mesh, 3).size(), 100U);
  expect_sound(mesh);
}

// A6
TEST(Robustness, FlatDoubledAndInvertedFaces) {
  TestMesh mesh = make_grid(10, 10, false);
  const std::vector<VertexId> before = whole_answer(mesh, 0);
  for (std::uint32_t v = 0; v + 2 < 10; ++v) {
    mesh.add_face({v, v + 1, v + 2});  // no area
    mesh.add_face({v + 1, v, v + 10});
  }
  EXPECT_EQ(whole_answer(mesh, 0), before);
  expect_sound(mesh);
}

// A7
TEST(Robustness, RepeatedCornersAndFacesOfFew) { expect_sound(family_mesh("random faces", 2000)); }

// A8
TEST(Robustness, NotManifold) {
  expect_sound(family_mesh("book", 2000));
  expect_sound(family_mesh("moebius", 2000));
}

// A8
TEST(Robustness, SheetsThatShareAVertexAreJoined) {
  TestMesh mesh = make_grid(3, 3, false);
  append(mesh, make_grid(3, 3, false));
  EXPECT_EQ(whole_answer(mesh, 0).size(), 9U);
  mesh.add_face({0, 9});
  EXPECT_EQ(whole_answer(mesh, 0).size(), 18U);
}

// A9
TEST(Robustness, CoincidentVerticesAreNotJoined) {
  TestMesh mesh = make_grid(5, 5, false);
  append(mesh, make_grid(5, 5, false));
  EXPECT_EQ(whole_answer(mesh, 7).size(), 25U);
  expect_sound(mesh);
}

// A10
TEST(Robustness, ThirteenThousandComponents) {
  const std::size_t components = scaled(13'000, 500);
  const TestMesh mesh = family_mesh("soup", 3 * components);
  EXPECT_EQ(mesh.face_count(), components);
  expect_sound(mesh);
}

// A11
TEST(Robustness, StarOfAMillion) {
  const TestMesh mesh = family_mesh("star", scaled(1'000'000, 1000) + 1);
  EXPECT_THAT(faults_of(mesh, 2), IsEmpty());
  std::printf("%zu leaves\n", mesh.size() - 1);
}

// A15
TEST(Robustness, OnePlaceOrOneLine) {
  for (const double step : {0.0, 1.0}) {
    TestMesh mesh = make_grid(40, 40, false);
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      std::fill_n(mesh.positions.begin() + static_cast<std::ptrdiff_t>(3 * v), 3, step * static_cast<double>(v));
    }
    expect_sound(mesh.finish(true));
  }
}

// A15
TEST(Robustness, OneSphere) { expect_sound(family_mesh("sphere", 2000)); }

// A16
TEST(Robustness, EndsOfTheRange) {
  for (const char* const name : {"huge", "tiny", "denormal", "float limits", "mixed scales"}) {
    SCOPED_TRACE(name);
    expect_sound(family_mesh(name, 1000));
  }
  for (const char* const name : {"colossal", "vanishing"}) {
    SCOPED_TRACE(name);
    expect_sound(family_mesh(name, 1000, false));
  }
}

// A16
TEST(Robustness, DistancesWhoseSquareVanishesCountAsZero) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(0x1p-539, 0, 0);
  mesh.add_vertex(0x1p-500, 0, 0);
  mesh.add_face({0, 1, 2});
  EXPECT_THAT(exact_neighborhood(mesh.finish(false).view(), 0, 0), ElementsAre(0, 1));
  expect_sound(mesh);
}

TEST(Robustness, PolygonOfAHundredThousandSides) { expect_sound(family_mesh("polygon", scaled(100'000, 2000)), 30); }

/// Runs `work(argument)` on a thread with a stack as small as in a browser.
void run_on_small_stack(void* (*work)(void*), void* argument) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
#if defined(PTHREAD_STACK_MIN)  // not of MinGW
  const auto least = static_cast<std::size_t>(PTHREAD_STACK_MIN);
#else
  constexpr std::size_t least = 0;
#endif
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, std::max<std::size_t>(least, std::size_t{64} * 1024)), 0);
  pthread_t thread{};
  ASSERT_EQ(pthread_create(&thread, &attributes, work, argument), 0);
  ASSERT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
}

struct PathCase {
  TestMesh mesh;
  std::vector<std::string> faults{"never ran"};
};

// A12
TEST(Robustness, PathOfAMillionOnASmallStack) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need more stack";
  PathCase path{family_mesh("path", scaled(1'000'000, 1000))};
  run_on_small_stack(
      [](void* argument) -> void* {
        auto& self = *static_cast<PathCase*>(argument);
        self.faults = faults_of(self.mesh, 30);
        return nullptr;
      },
      &path);
  EXPECT_THAT(path.faults, IsEmpty());
  std::printf("%zu vertices on a stack of 64 KiB\n", path.mesh.size());
}

}  // namespace
}  // namespace meshhood::test
