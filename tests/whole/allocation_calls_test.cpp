// SPDX-License-Identifier: MIT
// Every allocation of each other public call fails once: the call throws, or gives what it gives with enough memory.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/failing_allocations.h"
#include "support/families.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Numbers = std::vector<double>;

struct Call {
  std::string name;
  std::function<Numbers()> result;
};

template <class T>
Numbers numbers(const std::vector<T>& list) {
  return {list.begin(), list.end()};
}

Numbers areas_of(const Surface& surface) {
  const auto areas = surface.vertex_areas();
  return {areas.begin(), areas.end()};
}

/// What a call that takes a visitor, and gives it one point, passes to it.
template <class Call>
Numbers distances_of(Call&& call) {
  Numbers distances(6);
  call([&](std::size_t row, const SurfacePoint& point) { distances.at(row) = point.distance; });
  return distances;
}

class AllocationInEachCall : public testing::Test {
 protected:
  void expect_each(const std::vector<Call>& calls) {
    for (const Call& call : calls) {
      SCOPED_TRACE(call.name);
      const Numbers expected = call.result();
      ASSERT_FALSE(expected.empty());
      shortages.fail_each([] { return std::optional<Numbers>(); },
                          [&](std::optional<Numbers>& made) { made = call.result(); },
                          [&](const std::optional<Numbers>& made, Ending ending) {
                            ASSERT_EQ(made.has_value(), ending == Ending::Well);
                            EXPECT_TRUE(!made || *made == expected);
                          });
      if (HasFailure()) return;
    }
  }

  [[nodiscard]] BatchQuery query(Metric metric = Metric::Straight) const {
    return {.vertices = some, .radius = 2.5, .metric = metric};
  }

  const meshhood::Run run{.threads = 1};  // so that the allocations of a call have one order
  const TestMesh mesh = bumpy_grid(12).finish(false);
  const Index index = build(mesh.view());
  const Surface surface{index, mesh.view()};
  const std::vector<VertexId> some{0, 1, 2, 17, 90, 91};
  const std::vector<SpacePoint> points = std::vector<SpacePoint>(3, {3.1, 3.2, 9});
  const std::vector<std::size_t> faces_of_points = std::vector<std::size_t>(3, 3);
  const std::vector<SpacePoint> down = std::vector<SpacePoint>(3, {0, 0, -1});
  std::vector<double> values = std::vector<double>(mesh.size());
  Shortages shortages;
};

TEST_F(AllocationInEachCall, OfQueriesAndBatches) {
  std::vector<Call> calls;
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings, Metric::Space}) {
    const std::string name = " by metric " + std::to_string(static_cast<int>(metric));
    calls.push_back({"counts" + name, [=, this] { return numbers(counts(index, query(metric), run)); }});
    calls.push_back({"ids" + name,
                     [=, this] { return numbers(neighborhoods(index, query(metric), {.distances = true}, run).ids); }});
    calls.push_back({"one" + name, [=, this] { return numbers(Searcher(index, metric).neighborhood(17, 2.0)); }});
    for (const Reduce reduce :
         {Reduce::Sum, Reduce::Minimum, Reduce::StandardDeviation, Reduce::Count, Reduce::Median}) {
      calls.push_back({"reduction " + std::to_string(static_cast<int>(reduce)) + name, [=, this] {
                         return aggregate(index, {values},
                                          {.vertices = some, .radius = 2.0, .metric = metric, .reduce = {reduce}}, run);
                       }});
    }
  }
  for (const Nesting nesting : {Nesting::Own, Nesting::Patch}) {
    const bool is_own = nesting == Nesting::Own;
    calls.push_back({is_own ? "smoothing at two scales" : "variances of a patch", [=, this] {
                       return aggregate(index, {values},
                                        {.radius = BatchRadius::scales({2.0, 1.0}),
                                         .reduce = {is_own ? Reduce::Mean : Reduce::Variance},
                                         .kernel = is_own ? SmoothingKernel::Gaussian : SmoothingKernel::Box,
                                         .nesting = nesting},
                                        run);
                     }});
  }
  for (const Metric metric : {Metric::Straight, Metric::Path}) {
    const NearestOptions options{.metric = metric};
    calls.push_back({"k nearest", [=, this] { return numbers(k_nearest(index, some, 20, options, run).ids); }});
    calls.push_back({"discs", [=, this] {
                       const Numbers ones(mesh.size(), 1.0);
                       return numbers(discs(index, some, 20, ones, options, run).ids);
                     }});
  }
  calls.push_back({"ids in memory of the caller", [&] {
                     std::vector<VertexId> ids;
                     Numbers distances;
                     const auto allocate = [&](std::size_t count) {
                       ids.resize(count);
                       distances.resize(count);
                       return BatchMemory{ids, distances};
                     };
                     const std::uint64_t count =
                         neighborhoods(index, query(), allocate, {.distances = true}, run).back();
                     const double last = ids[count - 1];
                     k_nearest(index, some, 20, allocate, {}, run);
                     return Numbers{last, static_cast<double>(ids.back())};
                   }});
  calls.push_back({"nearest unconnected", [&] { return nearest_unconnected(index, query(), run).distance; }});
  calls.push_back({"nearest", [&] { return Numbers{nearest(index, points, run)[0].distance}; }});
  calls.push_back({"a searcher bound again", [&] {
                     const Index other = build(mesh.view(), run);
                     Searcher searcher(index);
                     searcher.rebind(other);
                     return Numbers{static_cast<double>(searcher.contains(17, 18, 2.5))};
                   }});
  calls.push_back({"a masked index", [&] {
                     std::vector<std::uint8_t> walls(mesh.size());
                     for (std::size_t v = 3; v < walls.size(); v += 5) walls[v] = 1;
                     const Index with_walls = masked(index, {.walls = walls}, run);
                     return numbers(neighborhoods(with_walls, query(), {}, run).ids);
                   }});
  calls.push_back({"breadth-first search", [&] {
                     const GraphData graph = extract_graph(index);
                     return numbers(counts(SearchMethod::breadth_first(graph.view()), query(), run));
                   }});
  calls.push_back(
      {"a scan", [&] { return numbers(counts(SearchMethod::ball_scan(mesh.positions_view()), query(), run)); }});
  calls.push_back({"a single query of a mesh", [&] { return numbers(exact_neighborhood(mesh.view(), 17, 2.5)); }});
  expect_each(calls);
}

TEST_F(AllocationInEachCall, OfShape) {
  const BatchQuery scales{.vertices = some, .radius = BatchRadius::scales({1.0, 2.5})};
  expect_each({
      {"moments", [&] { return moments(index, query(), {}, run); }},
      {"principal components", [&] { return principal_components(index, query(), {}, run).center; }},
      {"features", [&] { return features(surface, scales, {.kinds = {Feature::Crease, Feature::Area}}, run); }},
      {"persistence", [&] { return persistence(Numbers{1, 2, 3, 4}, Numbers{1, 2}, 1).strength; }},
      {"radii", [&] { return geometric_radii(1, 8, 4); }},
      {"curvature in memory of the caller",
       [&] {
         Curvatures made = curvatures(surface, query(), {}, run);
         curvatures(surface, query(), {made.k1, made.k2, made.d1, made.d2, made.state, made.count}, {}, run);
         return made.k1;
       }},
      {"the radius of libigl", [&] { return Numbers{libigl_radius(mesh.view(), 5)}; }},
      {"corrected curvature", [&] { return corrected_curvatures(surface, query(), run).measures; }},
      {"curvature", [&] { return curvatures(Surface(index, mesh.view()), query(), {}, run).d2; }},
      {"curvature by normals of the caller",
       [&] {
         const Numbers up(mesh.positions.size(), 0.5);
         return curvatures(Surface::of_normals(index, up, mesh.view().faces), query(), {}, run).k1;
       }},
  });
}

TEST_F(AllocationInEachCall, OfTheSurface) {
  const std::vector<VertexId> near = Searcher(index).neighborhood(17, 2.5);
  expect_each({
      {"invariants", [&] { return invariants(surface, query(), run).area; }},
      {"gaps", [&] { return Numbers{gaps(surface, query(), run)[0].distance}; }},
      {"gaps by a visitor",
       [&] { return distances_of([&](const auto& visit) { for_each_gap(surface, query(), visit, run); }); }},
      {"invariants of points", [&] { return invariants(surface, faces_of_points, points, 20, run).area; }},
      {"gaps of points", [&] { return Numbers{gaps(surface, faces_of_points, points, 20, run)[0].distance}; }},
      {"a patch", [&] { return numbers(PatchSearcher(surface).patch(17, 2.5)); }},
      {"its measure", [&] { return Numbers{PatchSearcher(surface).measure(17, 2.5).area}; }},
      {"its gap", [&] { return Numbers{PatchSearcher(surface).gap(17, 2.5).distance}; }},
      {"a clipped patch", [&] { return numbers(PatchSearcher(surface).clip(17, 2.5).faces); }},
      {"faces", [&] { return numbers(surface.on(index).faces(some, Corners::Any)); }},
      {"a submesh",
       [&] { return numbers(Surface(build(mesh.view(), run), mesh.view()).submesh(some, Corners::Any).corners); }},
      {"its rim", [&] { return Numbers{surface.rim(near, points[0], kInfinity).points[0][0]}; }},
      {"closest points", [&] { return Numbers{Surface(index, mesh.view()).closest_points(points, run)[0].distance}; }},
      {"first hits", [&] { return Numbers{Surface(index, mesh.view()).first_hits(points, down, run)[0].distance}; }},
      {"closest points by a visitor",
       [&] {
         const Surface fresh(index, mesh.view());
         return distances_of([&](const auto& visit) { fresh.for_each_closest_point(points, visit, run); });
       }},
      {"first hits by a visitor",
       [&] {
         const Surface fresh(index, mesh.view());
         return distances_of([&](const auto& visit) { fresh.for_each_first_hit(points, down, visit, run); });
       }},
      {"a closest point", [&] { return Numbers{Surface(index, mesh.view()).closest_point(points[0]).distance}; }},
      {"a first hit", [&] { return Numbers{Surface(index, mesh.view()).first_hit(points[0], down[0]).distance}; }},
      {"paths over the surface",
       [&] {
         const Index along = surface_paths(Surface(index, mesh.view()), run);
         return numbers(Searcher(along, Metric::Path).neighborhood(17, 2.5));
       }},
      {"areas", [&] { return areas_of(Surface(index, mesh.view())); }},
      {"areas of a mesh", [&] { return vertex_areas(mesh.view()); }},
      {"thickness by rays", [&] { return thickness(surface, some, ThicknessMethod::Ray, run); }},
      {"thickness by spheres",
       [&] { return thickness(Surface(index, mesh.view()), some, ThicknessMethod::Sphere, run); }},
      {"thickness of points",
       [&] { return thickness(Surface(index, mesh.view()), faces_of_points, points, ThicknessMethod::Sphere, run); }},
      {"a refit in place",
       [&] {
         Index moving = build(mesh.view(), run);
         Surface follows(moving, mesh.view());
         moving.refit_in_place(mesh.positions_view(), run);
         follows.refit_in_place(moving);
         return areas_of(follows);
       }},
  });
}

TEST_F(AllocationInEachCall, OfTheIndexAndTheGraph) {
  shortages.skip_to_every(20 / scaled(20));
  expect_each({
      {"quality", [&] { return Numbers{quality(index).gain}; }},
      {"check", [&] { return Numbers{static_cast<double>(index.check(mesh.view()).size())}; }},
      {"levels", [&] { return Numbers{static_cast<double>(index.levels().size())}; }},
      {"fingerprint", [&] { return Numbers{static_cast<double>(fingerprint(index) == fingerprint(mesh.view()))}; }},
      {"graph", [&] { return numbers(extract_graph(index).adjacency.neighbors); }},
      {"adjacency", [&] { return numbers(adjacency(mesh.view()).neighbors); }},
      {"cut edges",
       [&] {
         const Adjacency all = adjacency(mesh.view());
         const std::vector<VertexId> cut{0, 1};
         return numbers(cut_edges(all.view(), cut).neighbors);
       }},
      {"faces as vertices", [&] { return numbers(face_graph(mesh.view()).adjacency.neighbors); }},
      {"mean edges",
       [&] {
         const GraphData graph = extract_graph(index);
         return Numbers{mean_edge_length(index), mean_edge_length(graph.view())};
       }},
      {"links", [&] { return numbers(link_points(mesh.positions_view(), 1.5, {}, run).neighbors); }},
      {"the paper's index",
       [&] {
         const paper::Index other = paper::build(mesh.view(), {}, run);
         return Numbers{static_cast<double>(other.levels().size()),
                        static_cast<double>(other.check(mesh.view()).size())};
       }},
      {"points that are linked",
       [&] {
         const Index linked = build_linked(mesh.positions_view(), 1.5, {}, run);
         return numbers(Searcher(linked).neighborhood(17, 2.5));
       }},
  });
}

/// What follows from the positions, the patches, the normals and the tree of a surface.
Numbers answers_of(const Surface& surface) {
  const meshhood::Run run{.threads = 1};
  Numbers all = areas_of(surface);
  const auto add = [&](const Numbers& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(invariants(surface, {.radius = 2.5}, run).area);
  add(corrected_curvatures(surface, {.radius = 2.5}, run).measures);
  for (double x = 0; x < 12; ++x) {
    for (double y = 0; y < 12; ++y) all.push_back(surface.closest_point({x, y, 1}).distance);
  }
  return all;
}

TEST_F(AllocationInEachCall, LeavesWhatSharesASurfaceThatIsRefitted) {
  TestMesh moved = mesh;
  for (const VertexId v : some) moved.positions[3 * std::size_t{v} + 2] *= 0.5;  // within the frame
  const Index refitted = refit(index, moved.positions_view(), some, run);
  const Numbers before = answers_of(surface);
  const Numbers after = answers_of(Surface(refitted, moved.view()));
  const double area = PatchSearcher(surface).measure(17, 2.5).area;
  struct Scene {
    Surface follows;
    std::optional<Surface> other;
    std::optional<PatchSearcher> searcher;
  };
  for (const bool is_shared : {false, true}) {  // what is shared is copied before it is renewed
    const auto prepare = [&] {
      Scene scene{Surface(index, mesh.view()), {}, {}};
      EXPECT_EQ(answers_of(scene.follows), before);
      if (is_shared) scene.other = scene.follows.on(index);
      if (is_shared) scene.searcher.emplace(scene.follows);
      return scene;
    };
    shortages.fail_each(
        prepare, [&](Scene& scene) { scene.follows.refit_in_place(refitted, some); },
        [&](Scene& scene, Ending ending) {
          if (is_shared) {
            EXPECT_EQ(answers_of(*scene.other), before);
            EXPECT_EQ(scene.searcher->measure(17, 2.5).area, area);
          }
          const Numbers now = answers_of(scene.follows);
          EXPECT_TRUE(now == after || (now == before && ending == Ending::OutOfMemory));
          scene.follows.refit_in_place(refitted, some);
          EXPECT_EQ(answers_of(scene.follows), after);
        });
  }
}

}  // namespace
}  // namespace meshhood::test
