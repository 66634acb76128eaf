// SPDX-License-Identifier: MIT
// Whole calls whose results are numbers have the same bits with every kernel and any number of threads, with masks and
// without; those of aggregates, corrected curvature, nearest vertices, patches, rays and thickness do not depend on the
// other rows of the call, either.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/exact_answer.h"
#include "support/families.h"
#include "support/limited_isa.h"
#include "support/oracle.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

constexpr std::array kReductions{Reduce::Sum,     Reduce::Mean,     Reduce::Minimum,
                                 Reduce::Maximum, Reduce::Variance, Reduce::StandardDeviation,
                                 Reduce::Count,   Reduce::Median,   Reduce::Quantile};
constexpr std::array kKernels{SmoothingKernel::Box, SmoothingKernel::Epanechnikov, SmoothingKernel::Biweight,
                              SmoothingKernel::Gaussian};

using Bits = std::vector<std::uint64_t>;

void append(Bits& bits, const std::vector<double>& numbers) {
  for (const double number : numbers) bits.push_back(std::bit_cast<std::uint64_t>(number));
}

/// A mesh with everything that a call may need.
struct Scene {
  TestMesh mesh;
  Index whole;
  Index index;  // `whole`, or with masks
  Surface surface;
  std::vector<double> areas;
  std::vector<double> signal;
  std::vector<std::uint8_t> walls;
  std::vector<std::uint8_t> ignored;
  double edge;

  explicit Scene(TestMesh given)
      : mesh(std::move(given)),
        whole(build(mesh.view())),
        index(masked(whole, {})),
        surface(index, mesh.view()),
        areas(vertex_areas(mesh.view())),
        edge(Oracle(mesh).mean_edge()) {
    Random random(3);
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      signal.push_back(random.uniform(-1, 1) * random.uniform(0, 1e6));
      walls.push_back(random.below(40) == 0 ? 1 : 0);
      ignored.push_back(random.below(9) == 0 ? 1 : 0);
    }
  }

  void set_masks(bool has_masks) {
    index = masked(whole, has_masks ? Masks{walls, ignored} : Masks{});
    surface = surface.on(index);
  }

  /// In each leaf `least` to `most` of its vertices, in no order.
  [[nodiscard]] std::vector<VertexId> rows(std::size_t least, std::size_t most) const {
    Random random(least);
    std::vector<VertexId> chosen;
    const auto starts = index.leaf_starts();
    for (std::size_t leaf = 0; leaf + 1 < starts.size(); ++leaf) {
      std::vector<VertexId> of_leaf;
      for (VertexId i = starts[leaf]; i < starts[leaf + 1]; ++i) {
        of_leaf.push_back(index.permutation().empty() ? i : index.permutation()[i]);
      }
      for (std::size_t i = of_leaf.size(); i > 1; --i) std::swap(of_leaf[i - 1], of_leaf[random.below(i)]);
      of_leaf.resize(std::min<std::size_t>(of_leaf.size(), least + random.below(most - least + 1)));
      chosen.insert(chosen.end(), of_leaf.begin(), of_leaf.end());
    }
    std::reverse(chosen.begin(), chosen.end());
    return chosen;
  }
};

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  all.emplace_back(bumpy_grid(40).finish(true));
  all.emplace_back(bumpy_grid(40).finish(false));
  for (const Family& family : surface_families()) all.emplace_back(make_mesh(family, 2, 700));
  return all;
}

/// A call whose result is numbers, as a function of its rows.
struct Call {
  std::string name;
  std::function<std::vector<double>(const std::vector<VertexId>& rows, unsigned threads)> result;
  std::size_t columns;
  bool by_row;  // each row depends on its vertex alone
};

std::vector<Call> aggregates(const Scene& scene, double radius) {
  std::vector<Call> calls;
  for (const Reduce reduce : kReductions) {
    for (const SmoothingKernel kernel : kKernels) {
      if (kernel != SmoothingKernel::Box && reduce != Reduce::Sum && reduce != Reduce::Mean) continue;
      for (const Nesting nesting : {Nesting::Own, Nesting::Patch}) {
        calls.push_back({"reduction " + std::to_string(static_cast<int>(reduce)) + ", kernel " +
                             std::to_string(static_cast<int>(kernel)) + ", nesting " +
                             std::to_string(static_cast<int>(nesting)),
                         [&scene, radius, reduce, kernel, nesting](const auto& rows, unsigned threads) {
                           AggregateQuery query{.vertices = rows, .radius = BatchRadius::scales({radius, radius / 2})};
                           query.reduce = {reduce};
                           query.kernel = kernel;
                           query.nesting = nesting;
                           const std::vector<double> both =
                               aggregate(scene.index, {scene.signal, 1, scene.areas}, query, {.threads = threads});
                           std::vector<double> by_row;
                           for (std::size_t i = 0; i < rows.size(); ++i) {
                             by_row.push_back(both[i]);
                             by_row.push_back(both[rows.size() + i]);
                           }
                           return by_row;
                         },
                         2, true});
      }
    }
  }
  return calls;
}

std::vector<Call> curvature_calls(const Scene& scene, double radius, Metric metric) {
  std::vector<Call> calls;
  calls.push_back({"corrected curvature",
                   [&scene, radius, metric](const auto& rows, unsigned threads) {
                     return corrected_curvatures(scene.surface, {rows, radius, metric}, {.threads = threads}).measures;
                   },
                   CorrectedCurvatures::kMeasures, true});
  calls.push_back({"moments",
                   [&scene, radius, metric](const auto& rows, unsigned threads) {
                     return moments(scene.index, {rows, radius, metric}, {.degree = 4, .weights = scene.areas},
                                    {.threads = threads});
                   },
                   35, false});
  calls.push_back({"features",
                   [&scene, radius, metric](const auto& rows, unsigned threads) {
                     return features(
                         scene.surface, {rows, radius, metric},
                         {.kinds = {Feature::Crease, Feature::Height, Feature::Variation}, .areas = scene.areas},
                         {.threads = threads});
                   },
                   3, false});
  for (const CurvatureFit fit : {CurvatureFit::Quadric, CurvatureFit::Jet}) {
    calls.push_back({"curvature of fit " + std::to_string(static_cast<int>(fit)),
                     [&scene, radius, metric, fit](const auto& rows, unsigned threads) {
                       CurvatureOptions options;
                       options.fit = fit;
                       const Curvatures found =
                           curvatures(scene.surface, {rows, radius, metric}, options, {.threads = threads});
                       std::vector<double> numbers;
                       for (std::size_t i = 0; i < rows.size(); ++i) {
                         numbers.insert(numbers.end(), {found.k1[i], found.k2[i], static_cast<double>(found.state[i])});
                         for (std::size_t axis = 0; axis < 3; ++axis) numbers.push_back(found.d1[3 * i + axis]);
                       }
                       return numbers;
                     },
                     6, false});
  }
  return calls;
}

std::vector<double> interleaved(const std::vector<VertexId>& ids, const std::vector<double>& distances) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < ids.size(); ++i)
    numbers.insert(numbers.end(), {static_cast<double>(ids[i]), distances[i]});
  return numbers;
}

std::vector<Call> nearest_calls(const Scene& scene, double radius) {
  constexpr std::size_t kNearest = 9;
  std::vector<Call> calls;
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings}) {
    const std::string name = " of metric " + std::to_string(static_cast<int>(metric));
    calls.push_back({"nearest unconnected" + name,
                     [&scene, radius, metric](const auto& rows, unsigned threads) {
                       const Unconnected found =
                           nearest_unconnected(scene.index, {rows, radius, metric}, {.threads = threads});
                       return interleaved(found.vertex, found.distance);
                     },
                     2, true});
    const NearestOptions options{.metric = metric};
    calls.push_back({"k nearest" + name,
                     [&scene, options](const auto& rows, unsigned threads) {
                       const KNearest found = k_nearest(scene.index, rows, kNearest, options, {.threads = threads});
                       return interleaved(found.ids, found.distances);
                     },
                     2 * kNearest, true});
    calls.push_back({"discs" + name,
                     [&scene, options](const auto& rows, unsigned threads) {
                       const double area = 20 * scene.edge * scene.edge;
                       const Neighborhoods found =
                           discs(scene.index, rows, area, scene.areas, options, {.threads = threads});
                       return interleaved(found.ids, found.distances);
                     },
                     0, false});
  }
  for (const Metric metric : {Metric::Path, Metric::Rings, Metric::Space}) {
    for (const SmoothingKernel kernel : kKernels) {
      calls.push_back({"sums of metric " + std::to_string(static_cast<int>(metric)) + ", kernel " +
                           std::to_string(static_cast<int>(kernel)),
                       [&scene, radius, metric, kernel](const auto& rows, unsigned threads) {
                         AggregateQuery query{.vertices = rows, .radius = radius};
                         query.metric = metric;
                         query.kernel = kernel;
                         return aggregate(scene.index, {scene.signal, 1, scene.areas}, query, {.threads = threads});
                       },
                       1, true});
    }
  }
  return calls;
}

/// Of patches, rays and walls.
std::vector<Call> surface_calls(const Scene& scene, double radius) {
  std::vector<Call> calls;
  calls.push_back({"patches",
                   [&scene, radius](const auto& rows, unsigned threads) {
                     const BatchQuery query{.vertices = rows, .radius = radius};
                     const Invariants found = invariants(scene.surface, query, {.threads = threads});
                     const std::vector<SurfacePoint> nearest = gaps(scene.surface, query, {.threads = threads});
                     std::vector<double> numbers;
                     for (std::size_t i = 0; i < rows.size(); ++i) {
                       numbers.insert(numbers.end(), {found.area[i], found.volume[i], nearest[i].distance});
                     }
                     return numbers;
                   },
                   3, true});
  calls.push_back({"first hits",
                   [&scene](const auto& rows, unsigned threads) {
                     std::vector<SpacePoint> origins;
                     std::vector<SpacePoint> directions;
                     for (const VertexId v : rows) {
                       const double* const at = &scene.mesh.positions[3 * v];
                       origins.push_back({at[0] + scene.edge / 3, at[1] - scene.edge / 5, at[2] + scene.edge});
                       directions.push_back({scene.signal[v] / 1e7, 0.1, -1});
                     }
                     std::vector<double> numbers;
                     for (const SurfacePoint& hit :
                          scene.surface.first_hits(origins, directions, {.threads = threads})) {
                       numbers.insert(numbers.end(), {static_cast<double>(hit.face), hit.distance, hit.barycentric[0]});
                     }
                     return numbers;
                   },
                   3, true});
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    calls.push_back({"thickness by method " + std::to_string(static_cast<int>(method)),
                     [&scene, method](const auto& rows, unsigned threads) {
                       return thickness(scene.surface, rows, method, {.threads = threads});
                     },
                     1, true});
    calls.push_back({"thickness of points by method " + std::to_string(static_cast<int>(method)),
                     [&scene, method](const auto& rows, unsigned threads) {
                       std::vector<SpacePoint> points;
                       for (const VertexId v : rows) {
                         const double* const at = &scene.mesh.positions[3 * v];
                         points.push_back({at[0] + scene.edge / 3, at[1] - scene.edge / 5, at[2]});
                       }
                       std::vector<std::size_t> faces;
                       for (const SurfacePoint& found : scene.surface.closest_points(points)) {
                         faces.push_back(found.face);
                       }
                       return thickness(scene.surface, faces, points, method, {.threads = threads});
                     },
                     1, true});
  }
  return calls;
}

std::vector<Call> all_calls(const Scene& scene, double radius) {
  std::vector<Call> calls = aggregates(scene, radius);
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings, Metric::Space}) {
    for (Call& call : curvature_calls(scene, radius, metric)) calls.push_back(std::move(call));
  }
  for (Call& call : nearest_calls(scene, radius)) calls.push_back(std::move(call));
  for (Call& call : surface_calls(scene, radius)) calls.push_back(std::move(call));
  return calls;
}

Bits bits_of(const Call& call, const std::vector<VertexId>& rows, unsigned threads) {
  Bits bits;
  append(bits, call.result(rows, threads));
  return bits;
}

/// Calls `f(scene, call)` for all calls without masks, and with masks at the last radius; or each time for a share of
/// the calls, others than the time before.
template <class F>
void for_each_call(const std::vector<double>& radii, F&& f) {
  std::vector<Scene> all = scenes();
  std::size_t times = 0;
  for (Scene& scene : all) {
    for (const double edges : radii) {
      for (const bool has_masks : {false, true}) {
        if (has_masks && edges != radii.back()) continue;
        scene.set_masks(has_masks);
        const std::vector<Call> calls = all_calls(scene, edges * scene.edge);
        const std::size_t step = calls.size() / scaled(calls.size(), 4);
        for (std::size_t i = times++ % step; i < calls.size(); i += step) {
          const Call& call = calls[i];
          SCOPED_TRACE(call.name + ", " + std::to_string(edges) + " edges" + (has_masks ? ", masks" : ""));
          f(scene, call);
          if (testing::Test::HasFatalFailure()) return;
        }
      }
    }
  }
}

TEST(SameBits, OfWholeCallsWithEveryKernelAndAnyNumberOfThreads) {
  std::size_t compared = 0;
  for_each_call({2.0, 12.0}, [&](const Scene& scene, const Call& call) {
    const std::vector<VertexId> rows = scene.rows(8, 17);
    const Bits expected = bits_of(call, rows, 1);
    for (const Isa isa : available_isas()) {
      const LimitedIsa limited(isa);
      ASSERT_EQ(bits_of(call, rows, 1), expected) << "kernels " << static_cast<int>(isa);
    }
    ASSERT_EQ(bits_of(call, rows, 3), expected) << "threads";
    compared += expected.size();
  });
  std::printf("%zu numbers\n", compared);
}

TEST(SameBits, OfARowWhateverTheOtherRows) {
  std::size_t compared = 0;
  for_each_call({0.0, 2.0, 12.0}, [&](const Scene& scene, const Call& call) {
    if (!call.by_row) return;
    const std::vector<VertexId> all = scene.rows(32, 32);
    const Bits together = bits_of(call, all, 1);
    for (std::size_t row = 0; row < all.size(); row += 37) {
      const Bits alone = bits_of(call, {all[row]}, 1);
      const auto first = together.begin() + static_cast<std::ptrdiff_t>(call.columns * row);
      ASSERT_TRUE(std::equal(alone.begin(), alone.end(), first)) << "vertex " << all[row];
      compared += alone.size();
    }
  });
  std::printf("%zu numbers\n", compared);
}

}  // namespace
}  // namespace meshhood::test
