// SPDX-License-Identifier: MIT
#include "query_untrusted.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/batch.h"
#include "meshhood/search.h"

#include "judge.h"
#include "support/random.h"

namespace meshhood::fuzz {
namespace {

double draw_radius(const Index& index, VertexId v, test::Random& random) {
  if (random.below(8) == 0) return std::numeric_limits<double>::infinity();
  const GraphData mesh = extract_graph(index);
  const auto w = static_cast<VertexId>(random.below(index.vertex_count()));
  return distance(mesh.view().positions, v, w) * random.uniform(0, 1.5);
}

/// All vertices at one radius, and each at a radius of its own, so that leaves are answered together.
void ask_together(const Index& index, test::Random& random) {
  const std::size_t vertices = index.vertex_count();
  std::vector<double> radii(vertices, draw_radius(index, 0, random));
  for (int round = 0; round < 2; ++round) {
    static_cast<void>(counts(index, {.radius = radii}));
    const auto check = [&](const BatchRow& row) {
      if (row.distances.size() != row.ids.size()) fail("a row has too many ids or distances");
      if (std::any_of(row.ids.begin(), row.ids.end(), [&](VertexId w) { return w >= vertices; }))
        fail("a row has an id out of range");
    };
    for_each_neighborhood(index, {.radius = radii}, check, {.distances = true, .in_index_order = round == 1});
    for (double& radius : radii) radius *= random.uniform(0, 2);
  }
}

}  // namespace

void query_untrusted(const Index& index) {
  const std::size_t vertices = index.vertex_count();
  const GraphData graph = extract_graph(index);
  validate(graph.view());
  if (index.faces()) validate(MeshView{index.positions(), *index.faces()});
  Searcher searcher(index);
  std::vector<VertexId> ids;
  std::vector<double> distances;
  test::Random random(vertices);
  for (std::size_t query = 0; query < 64 && vertices > 0; ++query) {
    const auto v = static_cast<VertexId>(random.below(vertices));
    const double radius = draw_radius(index, v, random);
    searcher.neighborhood(v, radius, ids, distances);
    if (ids.size() > vertices || distances.size() != ids.size()) fail("the answer has too many vertices or distances");
    if (std::any_of(ids.begin(), ids.end(), [&](VertexId w) { return w >= vertices; }))
      fail("the answer has an id out of range");
    for (const VertexRange& range : searcher.ranges(v, radius)) {
      if (range.begin >= range.end || range.end > vertices) fail("the answer has an invalid range");
    }
  }
  if (vertices > 0) ask_together(index, random);
}

}  // namespace meshhood::fuzz
