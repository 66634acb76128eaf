// SPDX-License-Identifier: MIT
// What is made from an index before it changes: after a refit in place it answers by the new positions or refuses;
// after a refit, a move or the end of the index it answers as the index was. What has been moved from refuses. A result
// may lie in the memory of an argument.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

constexpr double kRadius = 2.5;

/// What an object answers, as numbers that can be compared.
using Answer = std::vector<double>;
/// Asks an object that was made before a change.
using Ask = std::function<Answer()>;

template <class T>
Answer numbers(const std::vector<T>& list) {
  Answer answer(list.begin(), list.end());
  for (double& number : answer) {
    if (std::isnan(number)) number = -1e300;  // so that it equals itself
  }
  return answer;
}

template <class Made>
std::shared_ptr<Made> kept(Made made) {
  return std::make_shared<Made>(std::move(made));
}

/// All that can be made from an index and lives on, by its name.
std::map<std::string, Ask> everything(const Index& index, const TestMesh& mesh,
                                      const std::vector<std::uint8_t>& walls) {
  const VertexId v = 44;
  std::map<std::string, Ask> all;
  const auto add_searcher = [&]<class S>(const std::string& name, S made) {
    auto searcher = kept(std::move(made));
    all[name + ": neighborhood"] = [=] { return numbers(searcher->neighborhood(v, kRadius)); };
    all[name + ": count"] = [=] { return Answer{static_cast<double>(searcher->count(v, kRadius))}; };
    all[name + ": distances"] = [=] {
      std::vector<VertexId> ids;
      std::vector<double> distances;
      searcher->neighborhood(v, kRadius, ids, distances);
      return distances;
    };
    all[name + ": ranges"] = [=] {
      Answer answer;
      for (const VertexRange& range : searcher->ranges(v, kRadius)) {
        answer.push_back(range.begin);
        answer.push_back(range.end);
      }
      return answer;
    };
  };
  const auto add_method = [&](const std::string& name, const SearchMethod& method) {
    all[name + ": counts"] = [=] { return numbers(counts(method, {.radius = kRadius})); };
    all[name + ": ids"] = [=] { return numbers(neighborhoods(method, {.radius = kRadius}).ids); };
    std::visit([&](auto&& searcher) { add_searcher(name + ": searcher", std::move(searcher)); },
               method.make_searcher());
  };
  add_searcher("Searcher", Searcher(index));
  add_searcher("Searcher by paths", Searcher(index, Metric::Path));
  const std::vector<std::pair<std::string, SearchMethod>> methods{{"straight", SearchMethod(index)},
                                                                  {"paths", SearchMethod(index).by(Metric::Path)},
                                                                  {"rings", SearchMethod(index).by(Metric::Rings)},
                                                                  {"space", SearchMethod(index).by(Metric::Space)}};
  for (const auto& [name, method] : methods) {
    add_method(name, method);
  }
  const auto with_walls = kept(masked(index, {.walls = walls}));
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings}) {
    const std::string name = "masked by metric " + std::to_string(static_cast<int>(metric));
    all[name + ": counts"] = [=] { return numbers(counts(*with_walls, {.radius = kRadius, .metric = metric})); };
    all[name + ": ids"] = [=] {
      return numbers(neighborhoods(*with_walls, {.radius = kRadius, .metric = metric}).ids);
    };
    add_searcher(name + ": searcher", Searcher(*with_walls, metric));
  }
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings}) {
    const auto searcher = kept(Searcher(index, metric));
    const std::string name = "Searcher by metric " + std::to_string(static_cast<int>(metric));
    all[name + ": connecting radius"] = [=] { return Answer{searcher->connecting_radius(v, 0)}; };
    all[name + ": contains"] = [=] { return Answer{searcher->contains(v, 0, kRadius) ? 1.0 : 0.0}; };
    all[name + ": nearest"] = [=] {
      std::vector<VertexId> ids;
      std::vector<double> radii;
      searcher->nearest_connected(v, 20, ids, radii);
      return numbers(radii);
    };
  }
  const auto from_points = kept(Searcher(index));
  all["Searcher: from a point"] = [=] {
    const std::vector<VertexId> seeds{v};
    return numbers(from_points->neighborhood({{4.2, 5.1, 0}, seeds}, 2 * kRadius));
  };
  const auto faces = kept(Surface(index, mesh.view().faces));
  all["Surface: first_hit"] = [=] { return Answer{faces->first_hit({3.2, 4.1, 7}, {0, 0, -1}).distance}; };
  all["Surface: closest_point"] = [=] { return Answer{faces->closest_point({3.2, 4.1, 7}).distance}; };
  const auto surface = kept(Surface(index, mesh.view()));
  all["Surface: curvatures"] = [=] { return numbers(curvatures(*surface, {.radius = kRadius}).k1); };
  all["Surface: vertex_areas"] = [=] {
    const auto areas = surface->vertex_areas();
    return Answer(areas.begin(), areas.end());
  };
  all["Surface: closest_points"] = [=] {
    const std::vector<SpacePoint> points{{3.2, 4.1, 7}};
    return Answer{surface->closest_points(points).front().distance};
  };
  all["Surface: first_hits"] = [=] {
    const std::vector<SpacePoint> ends{{3.2, 4.1, 7}, {0, 0, -1}};
    return Answer{surface->first_hits(std::span(ends).first(1), std::span(ends).last(1)).front().distance};
  };
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    all["Surface: thickness by method " + std::to_string(static_cast<int>(method))] = [=] {
      return Answer(thickness(*surface, {}, method));
    };
    all["Surface: thickness of points by method " + std::to_string(static_cast<int>(method))] = [=] {
      const std::vector<std::size_t> owners{2};
      const std::vector<SpacePoint> points{{3.2, 4.1, 7}};
      return Answer(thickness(*surface, owners, points, method));
    };
  }
  all["Surface: invariants"] = [=] { return numbers(invariants(*surface, {.radius = kRadius}).area); };
  const auto along = kept(surface_paths(*surface));
  all["surface_paths: counts"] = [=] { return numbers(counts(*along, {.radius = kRadius, .metric = Metric::Path})); };
  all["Surface: gaps"] = [=] { return Answer{gaps(*surface, {.radius = kRadius})[v].distance}; };
  const auto patches = kept(PatchSearcher(*surface));
  all["PatchSearcher: measure"] = [=] { return Answer{patches->measure(v, kRadius).area}; };
  all["PatchSearcher: clip"] = [=] { return Answer{patches->clip(v, kRadius).points.back()[0]}; };
  all["PatchSearcher: patch"] = [=] { return numbers(patches->patch(v, kRadius)); };
  all["Surface: features"] = [=] { return numbers(features(*surface, {.radius = BatchRadius::scales({kRadius})})); };
  return all;
}

class Outlives : public testing::Test {
 protected:
  Outlives() {
    for (std::size_t v = 0; v < mesh.size(); v += 5) walls[v] = 1;
    walls[44] = 0;
    for (std::size_t i = 0; i < moved.positions.size(); ++i) moved.positions[i] *= 1.5;
  }

  /// Asks all, and counts those that refuse.
  void expect_current_or_refused(const std::map<std::string, Ask>& before, const std::map<std::string, Ask>& after) {
    std::size_t refused = 0;
    std::size_t right = 0;
    for (const auto& [name, ask] : before) {
      try {
        EXPECT_EQ(ask(), after.at(name)()) << name;
        ++right;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidOption) << name;
        EXPECT_THAT(error.what(), testing::HasSubstr("refitted in place")) << name;
        ++refused;
      }
    }
    std::printf("%zu answer by the new positions, %zu refuse\n", right, refused);
    EXPECT_GT(right, 0U);
    EXPECT_GT(refused, 0U);
  }

  TestMesh mesh = bumpy_grid(12).finish(false);
  TestMesh moved = mesh;
  std::vector<std::uint8_t> walls = std::vector<std::uint8_t>(mesh.size());
  Index index = build(mesh.view());
};

TEST_F(Outlives, ARefitInPlaceOfAllPositions) {
  const auto before = everything(index, mesh, walls);
  for (const auto& [name, ask] : before) static_cast<void>(ask());
  index.refit_in_place(moved.positions_view());
  expect_current_or_refused(before, everything(index, moved, walls));
}

TEST_F(Outlives, ARefitInPlaceOfSomeVertices) {
  const std::vector<VertexId> changed{43, 44, 45, 56, 57};
  TestMesh some = mesh;
  for (const VertexId v : changed) some.positions[3 * v + 2] += 2;
  const auto before = everything(index, mesh, walls);
  index.refit_in_place(some.positions_view(), changed);
  expect_current_or_refused(before, everything(index, some, walls));
}

TEST_F(Outlives, ARefitAMoveAndTheEndOfTheIndex) {
  std::map<std::string, Answer> expected;
  for (const auto& [name, ask] : everything(index, mesh, walls)) expected[name] = ask();
  std::optional<Index> owner(std::move(index));
  const auto before = everything(*owner, mesh, walls);
  {
    const Index other = refit(*owner, moved.positions_view());
    for (const auto& [name, ask] : before) EXPECT_EQ(ask(), expected[name]) << name;
  }
  std::optional<Index> taken(std::move(*owner));
  std::size_t asked = 0;
  const auto ask_again = [&] {
    for (const auto& [name, ask] : before) {
      const bool borrows = name.find("straight: ") == 0 || name.find("paths") == 0 || name.find("rings: ") == 0 ||
                           name.find("space: ") == 0;  // methods, of which the index must stay where it is
      if (borrows && name.find("searcher") == std::string::npos) continue;
      EXPECT_EQ(ask(), expected[name]) << name;
      ++asked;
    }
  };
  ask_again();
  taken.reset();
  owner.reset();
  ask_again();
  std::printf("%zu answers\n", asked);
}

TEST_F(Outlives, ARefittedIndexARefitOfItsOrigin) {
  const Index other = refit(index, moved.positions_view());
  Searcher searcher(other);
  const std::vector<VertexId> expected = searcher.neighborhood(44, kRadius);
  index.refit_in_place(mesh.positions_view());
  EXPECT_EQ(searcher.neighborhood(44, kRadius), expected);
  EXPECT_EQ(Searcher(other).neighborhood(44, kRadius), expected);
}

TEST(Rebind, RingsOfAHubAreThoseOfTheNewState) {
  TestMesh star;  // a graph unlike a surface, whose rings are found vertex by vertex
  star.add_vertex(0, 0, 0);
  for (VertexId i = 1; i < 3000; ++i) {
    star.add_vertex(i, 1, 0);
    star.add_face({0, i});
  }
  star = star.finish(false);
  Index index = build(star.view());
  Searcher edges(index, Metric::Rings);
  std::vector<VertexId> before;
  std::vector<VertexId> after;
  edges.neighborhood(7, 1, before);
  index.refit_in_place(star.positions_view());
  edges.rebind(index);
  edges.neighborhood(7, 1, after);
  EXPECT_EQ(before, after);
}

TEST_F(Outlives, ASurfaceDoesNotTakeARefittedIndex) {
  const Surface surface(index, mesh.view());
  const Index other = refit(index, moved.positions_view());
  expect_refused(ErrorCode::InvalidOption, "of another mesh", [&] { return surface.on(other); });
  expect_refused(ErrorCode::InvalidOption, "of another mesh",
                 [&] { return surface.on(masked(other, {.walls = walls})); });
  static_cast<void>(surface.on(masked(index, {.walls = walls})));
}

TEST_F(Outlives, AMethodByAMetricIsOneByAnother) {
  const SearchMethod paths = SearchMethod(index).by(Metric::Path);
  EXPECT_EQ(counts(paths.by(Metric::Straight), {.radius = kRadius}), counts(index, {.radius = kRadius}));
  EXPECT_NE(counts(paths, {.radius = kRadius}), counts(index, {.radius = kRadius}));
  expect_refused(ErrorCode::InvalidOption, "metric: expected Straight", [&] {
    return counts(SearchMethod::ball_scan(mesh.view().positions), {.radius = kRadius, .metric = Metric::Path});
  });
}

/// Calls `ask` on an object of which `take` has moved the state to another.
template <class Made>
void expect_moved_from_refused(const std::string& name, Made made, const std::function<void(Made&)>& ask) {
  SCOPED_TRACE(name);
  Made taken = std::move(made);
  expect_refused(ErrorCode::InvalidOption, "has been moved from",
                 [&] { ask(made); });  // NOLINT(bugprone-use-after-move)
  ask(taken);
  made = std::move(taken);
  ask(made);
}

TEST_F(Outlives, WhatHasBeenMovedFromRefusesUntilItIsAssigned) {
  const auto find = [](auto& searcher) { static_cast<void>(searcher.count(44, kRadius)); };
  expect_moved_from_refused<Searcher>("Searcher", Searcher(index), find);
  expect_moved_from_refused<ReferenceSearcher>("ReferenceSearcher", ReferenceSearcher(mesh.view()), find);
  const paper::Index approximate = paper::build(mesh.view());
  expect_moved_from_refused<paper::Searcher>("paper::Searcher", paper::Searcher(approximate), find);
  expect_moved_from_refused<paper::Index>("paper::Index", paper::build(mesh.view()),
                                          [](paper::Index& made) { static_cast<void>(made.vertex_count()); });
  const Surface patched(index, mesh.view());
  expect_moved_from_refused<PatchSearcher>("PatchSearcher", PatchSearcher(patched), [](PatchSearcher& made) {
    static_cast<void>(made.measure(VertexId{44}, kRadius));
  });
  expect_moved_from_refused<Surface>("Surface", Surface(index, mesh.view()),
                                     [](Surface& made) { static_cast<void>(curvatures(made, {.radius = kRadius})); });
}

TEST_F(Outlives, AMethodThatHasBeenMovedFromIsACopy) {
  SearchMethod method(index);
  const SearchMethod taken = std::move(method);
  EXPECT_EQ(counts(method, {.radius = kRadius}),  // NOLINT(bugprone-use-after-move)
            counts(taken, {.radius = kRadius}));
}

TEST_F(Outlives, ResultsInTheMemoryOfArguments) {
  Searcher regions(index);
  const SpacePoint center{4.2, 5.1, 0};
  const std::vector<VertexId> seeds{52, 64, 65};
  const std::vector<double> radii{0.0, 1.0, kRadius};
  std::vector<VertexId> ids = seeds;
  const std::vector<VertexId> expected = regions.neighborhood(Start(center, seeds), kRadius);
  regions.neighborhood(Start(center, ids), kRadius, ids);
  EXPECT_EQ(ids, expected);

  std::vector<double> distances;
  ids = seeds;
  regions.neighborhood(Start(center, ids), kRadius, ids, distances);
  EXPECT_EQ(ids, expected);

  ids = seeds;
  std::vector<std::size_t> sizes;
  regions.nested(Start(center, ids), radii, ids, sizes);
  std::sort(ids.begin(), ids.end());
  std::vector<VertexId> sorted = expected;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(ids, sorted);

  ids = seeds;
  const Dab dab{Start(center, ids), kRadius};
  regions.stroke({&dab, 1}, ids);
  EXPECT_EQ(ids, expected);

  std::vector<VertexId> nearest;
  std::vector<double> found;
  regions.nearest_connected(Start(center, seeds), 10, nearest, found);
  ids = seeds;
  regions.nearest_connected(Start(center, ids), 10, ids, found);
  EXPECT_EQ(ids, nearest);

  std::vector<VertexId> rows(mesh.size());
  for (VertexId v = 0; v < rows.size(); ++v) rows[v] = v;
  std::vector<double> row_radii(mesh.size(), 0.5);
  const Neighborhoods plain = neighborhoods(index, {.vertices = rows, .radius = row_radii});
  ASSERT_EQ(plain.ids.size(), rows.size());
  static_cast<void>(neighborhoods(
      index, {.vertices = rows, .radius = row_radii},
      [&](std::size_t count) { return BatchMemory{std::span(rows).first(count), std::span(row_radii).first(count)}; },
      {.distances = true}));
  EXPECT_EQ(rows, plain.ids);
}

TEST_F(Outlives, AnAggregateInPlace) {
  for (const std::size_t channels : {1U, 16U, 17U, 40U}) {
    for (const SmoothingKernel kernel : {SmoothingKernel::Box, SmoothingKernel::Biweight}) {
      std::vector<double> values(mesh.size() * channels);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i * 37 % 101);
      const AggregateQuery query{.radius = kRadius, .reduce = {Reduce::Mean}, .kernel = kernel};
      const std::vector<double> expected = aggregate(index, {.values = values, .channels = channels}, query);
      aggregate(index, {.values = values, .channels = channels}, query, values);
      EXPECT_EQ(values, expected) << channels << " channels";
    }
  }
  std::vector<double> weights(mesh.size(), 2);
  weights[7] = 1;
  const std::vector<double> values(mesh.size(), 3);
  const AggregateQuery query{.radius = BatchRadius::scales({kRadius}), .reduce = {Reduce::Sum}};
  const std::vector<double> expected = aggregate(index, {.values = values, .weights = weights}, query);
  aggregate(index, {.values = values, .weights = weights}, query, weights);
  EXPECT_EQ(weights, expected);
}

}  // namespace
}  // namespace meshhood::test
