// SPDX-License-Identifier: MIT
// What follows from a neighborhood: moments, components, curvature, features and the nearest unconnected vertex, by
// each metric. Compared with the definition, and with the same call of all vertices, of which those of no neighborhood
// are ignored.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Ids = std::vector<VertexId>;

/// A mesh with masks, and the neighborhoods of a metric by their definition.
class MetricCase {
 public:
  MetricCase(TestMesh mesh, Metric metric)
      : mesh_(std::move(mesh)),
        metric_(metric),
        oracle_(mesh_),
        index_(build(mesh_.view())),
        surface_(Surface(index_, mesh_.view())),
        areas_(vertex_areas(mesh_.view())),
        walls_(mesh_.size()),
        ignored_(mesh_.size()),
        asked_(masked(index_, {})) {}

  /// Of the index that is asked; without masks at first.
  void draw_masks(Random& random) {
    walls_ = draw_mask(random, mesh_.size(), 20);
    ignored_ = draw_mask(random, mesh_.size(), 9);
    asked_ = masked(index_, {walls_, ignored_});
  }

  /// Rows of whole leaves, and a radius for each.
  void draw_rows(Random& random, double edges) {
    const double unit = metric_ == Metric::Rings ? 1 : oracle_.graph().mean_edge();
    rows_.clear();
    radii_.clear();
    for (std::size_t i = 0; i < std::min(scaled(120, 40), mesh_.size()); ++i) {
      rows_.push_back(index_.permutation().empty() ? static_cast<VertexId>(i) : index_.permutation()[i]);
      radii_.push_back(random.below(4) == 0 ? 0.7 * edges * unit : edges * unit);
    }
  }

  void compare_moments() const {
    const std::vector<double> found = moments(asked_, query(), {.degree = 3, .weights = areas_}, {.threads = 2});
    const PrincipalComponents patch = principal_components(asked_, query(), {.weights = areas_});
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const Ids ids = neighborhood(row);
      for (unsigned i = 0; i <= 3; ++i) {
        for (unsigned j = 0; i + j <= 3; ++j) {
          for (unsigned k = 0; i + j + k <= 3; ++k) {
            const auto [sum, size] = moment(rows_[row], ids, {i, j, k});
            ASSERT_NEAR(found[moment_count(3) * row + moment_column(i, j, k)], sum, 1e-12 * size)
                << mesh_.name << ", vertex " << rows_[row] << ", moment " << i << j << k;
          }
        }
      }
      ASSERT_EQ(patch.weight[row], found[moment_count(3) * row]);
    }
  }

  /// With the fit to a neighborhood that is given by its vertices. Returns how many were compared.
  [[nodiscard]] std::size_t compare_curvatures() const {
    std::size_t compared = 0;
    const Surface surface = surface_.on(asked_);
    const Curvatures found = curvatures(surface, query(), {}, {.threads = 2});
    const std::vector<double> creases =
        features(surface, query(), {.kinds = {Feature::K1, Feature::Variation}, .areas = areas_});
    const PrincipalComponents patch = principal_components(asked_, query(), {.weights = areas_});
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const Ids ids = neighborhood(row);
      if (found.state[row] != CurvatureState::Fitted) continue;
      std::vector<std::uint8_t> others(mesh_.size(), 1);
      for (const VertexId id : ids) others[id] = 0;
      const Ids vertex{rows_[row]};
      const Metric all = metric_ == Metric::Space ? Metric::Space : Metric::Straight;
      const Curvatures expected = curvatures(surface_.on(masked(index_, {.ignored = others})),
                                             {.vertices = vertex, .radius = kInfinity, .metric = all});
      EXPECT_EQ(expected.state[0], CurvatureState::Fitted);
      EXPECT_EQ(expected.count[0], found.count[row]);
      const double tolerance = 1e-6 * (std::abs(expected.k1[0]) + std::abs(expected.k2[0]) + 1e-3 / edge());
      EXPECT_NEAR(found.k1[row], expected.k1[0], tolerance) << mesh_.name << ", vertex " << vertex[0];
      EXPECT_NEAR(found.k2[row], expected.k2[0], tolerance) << mesh_.name << ", vertex " << vertex[0];
      const double radius = metric_ == Metric::Rings ? radii_[row] * mean_edge_length(index_) : radii_[row];
      EXPECT_EQ(creases[2 * row], radius * found.k1[row]);
      const double* const variances = &patch.variances[3 * row];
      EXPECT_EQ(creases[2 * row + 1], surface_variation(variances[0], variances[1], variances[2]));
      ++compared;
    }
    return compared;
  }

  void compare_unconnected() const {
    const Unconnected found = nearest_unconnected(asked_, query(), {.threads = 2});
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const VertexId v = rows_[row];
      std::vector<bool> is_out(mesh_.size());
      for (const VertexId id : neighborhood(row)) is_out[id] = true;
      VertexId nearest = kNoVertex;
      double gap = kInfinity;
      for (VertexId w = 0; w < mesh_.size() && walls_[v] == 0; ++w) {
        const double distance = oracle_.graph().distance(v, w);
        const bool is_in_ball = metric_ == Metric::Rings || distance <= radii_[row];
        if (is_out[w] || walls_[w] != 0 || ignored_[w] != 0 || !is_in_ball || !(distance < gap)) continue;
        nearest = w;
        gap = distance;
      }
      ASSERT_EQ(found.vertex[row], nearest) << mesh_.name << ", vertex " << v << ", radius " << radii_[row];
      ASSERT_EQ(found.distance[row], gap);
    }
  }

 private:
  struct Moment {
    double sum;
    double size;  // of the terms, and of those of the same degree
  };

  [[nodiscard]] BatchQuery query() const { return {.vertices = rows_, .radius = radii_, .metric = metric_}; }

  [[nodiscard]] double edge() const { return oracle_.graph().mean_edge(); }

  [[nodiscard]] Ids neighborhood(std::size_t row) const {
    if (metric_ == Metric::Space) return neighborhood_in_space(row);
    PlainStart start;
    start.center = position(mesh_, rows_[row]);
    start.seeds = {rows_[row]};
    start.walls = walls_;
    start.ignored = ignored_;
    if (metric_ == Metric::Straight) return oracle_.region(start, radii_[row]);
    const std::vector<double> lengths = oracle_.path_lengths(start, radii_[row], [&](std::uint32_t v, std::uint32_t w) {
      return metric_ == Metric::Rings ? 1 : oracle_.graph().distance(v, w);
    });
    Ids ids;
    for (VertexId v = 0; v < lengths.size(); ++v) {
      if (lengths[v] < kInfinity && ignored_[v] == 0) ids.push_back(v);
    }
    return ids;
  }

  [[nodiscard]] Ids neighborhood_in_space(std::size_t row) const {
    Ids ids;
    for (VertexId v = 0; v < mesh_.size() && walls_[rows_[row]] == 0; ++v) {
      const bool is_masked = walls_[v] != 0 || ignored_[v] != 0;
      if (!is_masked && oracle_.graph().distance(rows_[row], v) <= radii_[row]) ids.push_back(v);
    }
    return ids;
  }

  [[nodiscard]] Moment moment(VertexId v, const Ids& ids, const std::array<unsigned, 3>& powers) const {
    long double sum = 0;
    long double size = 0;
    for (const VertexId w : ids) {
      long double term = areas_[w];
      long double length = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const long double x = static_cast<long double>(mesh_.positions[3 * std::size_t{w} + axis]) -
                              mesh_.positions[3 * std::size_t{v} + axis];
        term *= std::pow(x, static_cast<long double>(powers[axis]));
        length += x * x;
      }
      sum += term;
      size += areas_[w] * std::pow(std::sqrt(length), static_cast<long double>(powers[0] + powers[1] + powers[2]));
    }
    return {static_cast<double>(sum), static_cast<double>(size)};
  }

  TestMesh mesh_;
  Metric metric_;
  RegionOracle oracle_;
  Index index_;
  Surface surface_;
  std::vector<double> areas_;
  std::vector<std::uint8_t> walls_;
  std::vector<std::uint8_t> ignored_;
  Index asked_;
  Ids rows_;
  std::vector<double> radii_;
};

class MetricsOfFamily : public testing::TestWithParam<Family> {};

TEST_P(MetricsOfFamily, AnswerAsTheVerticesOfTheNeighborhood) {
  std::size_t fits = 0;
  Random random(5);
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings, Metric::Space}) {
    const TestMesh mesh = make_mesh(GetParam(), 3, 400);
    if (mesh.size() == 0) continue;
    MetricCase scene(mesh, metric);
    for (const bool has_masks : {false, true}) {
      if (has_masks) scene.draw_masks(random);
      for (const double edges : {0.0, 2.0, 5.0}) {
        scene.draw_rows(random, edges);
        scene.compare_moments();
        if (metric != Metric::Space) scene.compare_unconnected();
        if (edges > 0) fits += scene.compare_curvatures();
      }
    }
  }
  std::printf("%s: %zu fits\n", std::string(GetParam().name).c_str(), fits);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, MetricsOfFamily, testing::ValuesIn(surface_families()), family_name);

TEST(Metrics, InSpaceRefuseWhatAsksForConnections) {
  const auto [mesh, index] = indexed(make_grid(4, 4, false));
  const std::vector<double> areas(mesh.size(), 1);
  const auto refuses = [](const auto& ask) { expect_refused(ErrorCode::InvalidOption, "nothing is connected", ask); };
  Ids ids{7};
  std::vector<double> radii{7};
  refuses([&] { Searcher(index, Metric::Space).nearest_connected(0, 2, ids, radii); });
  EXPECT_EQ(ids, Ids{7});
  EXPECT_EQ(radii, std::vector<double>{7});
  refuses([&] { return k_nearest(index, {}, 2, {.metric = Metric::Space}); });
  refuses([&] { return discs(index, {}, 2, areas, {.metric = Metric::Space}); });
  refuses([&] { return nearest_unconnected(index, {.radius = 1, .metric = Metric::Space}); });
}

TEST(Metrics, AreOfAnIndexAlone) {
  const TestMesh mesh = make_grid(4, 4, false);
  const GraphData graph = extract_graph(build(mesh.view()));
  EXPECT_THROW(
      static_cast<void>(counts(SearchMethod::breadth_first(graph.view()), {.radius = 1, .metric = Metric::Path})),
      Error);
}

}  // namespace
}  // namespace meshhood::test
