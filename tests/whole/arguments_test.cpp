// SPDX-License-Identifier: MIT
// Invalid and extreme arguments to every method: rows A1 to A3 and A18 of docs/reliability.md. The meshes of A4 to A16
// are in robustness_test, A13 and A14 in paper/fusion_test, A17 in base/error_test.
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Every method on the same mesh: two unconnected grids of nine vertices each, at a distance of a hundred.
class Arguments : public testing::Test {
 protected:
  using Method = std::function<void(Vertex, double, std::vector<VertexId>&)>;

  static TestMesh two_grids() {
    TestMesh mesh = make_grid(3, 3, false);
    TestMesh far = make_grid(3, 3, false);
    for (double& x : far.positions) x += 100;
    append(mesh, far);
    return mesh.finish(true);
  }

  /// The answers of all methods to a query.
  std::vector<std::vector<VertexId>> answers(Vertex v, double radius) {
    std::vector<std::vector<VertexId>> result;
    for (const auto& [name, search] : methods_) search(v, radius, result.emplace_back());
    return result;
  }

  /// Every method throws and leaves the previous answer unchanged.
  void expect_all_refused(ErrorCode code, const std::string& cause, Vertex v, double radius) {
    for (const auto& [name, search] : methods_) {
      SCOPED_TRACE(name);
      std::vector<VertexId> out{7};
      expect_refused(code, cause, [&] { search(v, radius, out); });
      EXPECT_THAT(out, ElementsAre(7));
    }
    expect_refused(code, cause, [&] { return BallSearcher(mesh_.positions_view()).neighborhood(v, radius); });
  }

  TestMesh mesh_ = two_grids();
  Index index_ = build(mesh_.view());
  paper::Index paper_index_ = paper::build(mesh_.view());
  Searcher searcher_{index_};
  paper::Searcher paper_searcher_{paper_index_};
  ReferenceSearcher reference_{mesh_.view()};
  std::vector<std::pair<std::string, Method>> methods_{
      {"exact", [this](Vertex v, double r, auto& out) { searcher_.neighborhood(v, r, out); }},
      {"paper", [this](Vertex v, double r, auto& out) { paper_searcher_.neighborhood(v, r, out); }},
      {"reference", [this](Vertex v, double r, auto& out) { reference_.neighborhood(v, r, out); }},
      {"once", [this](Vertex v, double r, auto& out) { out = exact_neighborhood(mesh_.view(), v, r); }},
      {"exact, distances",
       [this](Vertex v, double r, auto& out) {
         std::vector<double> distances;
         searcher_.neighborhood(v, r, out, distances);
       }},
      {"exact, ranges",
       [this](Vertex v, double r, auto& out) {
         const std::span<const VertexRange> ranges = searcher_.ranges(v, r);
         out.clear();
         for (const VertexRange& range : ranges) {
           const auto part = index_.permutation().subspan(range.begin, range.end - range.begin);
           out.insert(out.end(), part.begin(), part.end());
         }
       }},
      {"exact, count", [this](Vertex v, double r, auto& out) { out.assign(searcher_.count(v, r), v); }},
      {"paper, count", [this](Vertex v, double r, auto& out) { out.assign(paper_searcher_.count(v, r), v); }}};
};

TEST_F(Arguments, RadiusNaNOrNegativeIsRefused) {
  expect_all_refused(ErrorCode::InvalidRadius, "radius nan, expected a number >= 0", 0, kNan);
  expect_all_refused(ErrorCode::InvalidRadius, "radius -0.5, expected a number >= 0", 0, -0.5);
  expect_all_refused(ErrorCode::InvalidRadius, "radius -inf, expected a number >= 0", 0, -kInfinity);
}

TEST_F(Arguments, RadiusMinusZeroIsZero) { EXPECT_THAT(answers(4, -0.0), Each(ElementsAre(4))); }

TEST_F(Arguments, RadiusInfiniteIsTheComponent) {
  EXPECT_THAT(answers(4, kInfinity), Each(SizeIs(9)));
  EXPECT_THAT(answers(4, std::numeric_limits<double>::max()), Each(SizeIs(9)));
}

TEST_F(Arguments, RadiusRatioIsPositiveAndFinite) {
  for (const double factor : {kNan, 0.0, -0.0, -1.0, kInfinity}) {
    expect_refused(ErrorCode::InvalidOption, "radius_ratio is ",
                   [&] { paper_searcher_.set_options({.radius_ratio = factor}); });
  }
}

TEST_F(Arguments, VertexOutOfRangeIsRefusedAndNeverWraps) {
  constexpr std::uint64_t kWrapsToThree = (std::uint64_t{1} << 32) + 3;
  expect_all_refused(ErrorCode::VertexOutOfRange, "vertex 18, but the mesh has 18 vertices", 18, 1);
  expect_all_refused(ErrorCode::VertexOutOfRange, "vertex 4294967295, but", static_cast<VertexId>(-1), 1);
  expect_all_refused(ErrorCode::VertexOutOfRange, "vertex 4294967295, but", kWrapsToThree, 1);
  for (const auto& call : std::initializer_list<std::function<void()>>{
           [&] { static_cast<void>(searcher_.contains(0, kWrapsToThree, 1)); },
           [&] { static_cast<void>(searcher_.connecting_radius(0, kWrapsToThree)); },
           [&] { static_cast<void>(distance(mesh_.positions_view(), 0, kWrapsToThree)); }}) {
    expect_refused(ErrorCode::VertexOutOfRange, "vertex 4294967295, but", call);
  }
}

TEST_F(Arguments, ArraysOfTheWrongLengthAreRefused) {
  const std::vector<float> seven(7, 0.0F);
  expect_refused(ErrorCode::InvalidMesh, "7 coordinates, expected three a vertex",
                 [&] { return build(MeshView{seven, {}}); });
  const std::vector<std::uint32_t> four(4, 0);
  expect_refused(ErrorCode::InvalidMesh, "4 corners, expected three a triangle",
                 [&] { return build(MeshView{mesh_.positions_view(), FacesView::triangles(four)}); });
}

TEST_F(Arguments, AnswersMayReuseAnyBuffer) {
  std::vector<VertexId> out(1000, 7);
  for (const auto& [name, search] : methods_) {
    search(4, kInfinity, out);
    EXPECT_THAT(out, SizeIs(9)) << name;
  }
}

TEST_F(Arguments, ACallbackThatThrowsOrQueriesLeavesTheIndexUsable) {
  const auto thrower = [](const BatchRow&) { throw std::runtime_error("enough"); };
  EXPECT_THROW(for_each_neighborhood(index_, {.radius = 1.0}, thrower, {}, {.threads = 2}), std::runtime_error);
  EXPECT_THROW(for_each_neighborhood(paper_index_, {.radius = 1.0}, thrower, {}, {.threads = 2}), std::runtime_error);
  std::size_t rows = 0;
  for_each_neighborhood(index_, {.radius = 1.0}, [&](const BatchRow& row) {
    // The callback queries the vertices of the rows again.
    rows += static_cast<std::size_t>(neighborhoods(index_, {.radius = 1.0}, {}, {.threads = 2}).offsets.size() == 19);
    EXPECT_EQ(searcher_.count(static_cast<VertexId>(row.row), 1), row.ids.size());
  });
  EXPECT_EQ(rows, 18U);
  EXPECT_THAT(answers(4, kInfinity), Each(SizeIs(9)));
}

TEST_F(Arguments, AnEmptyFunctionIsRefusedByName) {
  const Surface surface(index_, mesh_.view());
  const std::vector<SpacePoint> points(1);
  const auto refuse = [&](const std::string& name, const auto& call) {
    expect_refused(ErrorCode::InvalidOption, name + " is empty, expected a function", call);
  };
  const BatchAllocator none;
  refuse("sink", [&] { for_each_neighborhood(index_, {.radius = 1.0}, {}); });
  refuse("sink", [&] { save(index_, Sink()); });
  refuse("sink", [&] { paper::save(paper_index_, Sink()); });
  refuse("allocate", [&] { return neighborhoods(index_, {.radius = 1.0}, none); });
  refuse("allocate", [&] { k_nearest(index_, {}, 2, none); });
  refuse("visit", [&] { for_each_gap(surface, {.radius = 1.0}, {}); });
  refuse("visit", [&] { surface.for_each_closest_point(points, {}); });
  refuse("visit", [&] { surface.for_each_first_hit(points, points, {}); });
}

TEST_F(Arguments, ACancelledBuildLeaksNothing) {
  expect_refused(ErrorCode::Cancelled, "",
                 [&] { return build(mesh_.view(), {.progress = [](auto&&...) { return false; }}); });
}

}  // namespace
}  // namespace meshhood::test
