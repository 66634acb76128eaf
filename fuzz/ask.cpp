// SPDX-License-Identifier: MIT
#include "ask.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "meshhood/adjacency.h"
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

}  // namespace

void ask(const Index& index) {
  const std::size_t vertices = index.vertex_count();
  const GraphData graph = extract_graph(index);
  validate(graph.view());
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
}

}  // namespace meshhood::fuzz
