// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/index.h"

#include "exact/index_access.h"
#include "exact/search/query.h"
#include "support/draw.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/oracle.h"
#include "support/scale.h"
#include "support/sorted.h"

/// Meshes and queries for testing one step of the search against brute force.
namespace meshhood::test {

using Ids = std::vector<std::uint32_t>;  // the caller's, ascending

struct SearchCase {
  const TestMesh& mesh;
  const Oracle& oracle;
  const IndexView& index;
  const Query& query;
  const Kernels& kernels;

  [[nodiscard]] Ids neighborhood() const { return oracle.exact(query.vertex, query.radius); }
  [[nodiscard]] std::uint32_t id(LeafId leaf, unsigned lane) const { return index.id(index.leaf_begin[leaf] + lane); }
  [[nodiscard]] LeafId leaf_of_id(std::uint32_t v) const { return leaf_of(index.slot[v]); }
};

/// Calls `f` with queries on small meshes of `family`, with the kernels of every instruction set in turn. Returns the
/// number of queries.
template <class F>
std::size_t for_each_search_case(const Family& family, std::size_t meshes, std::size_t vertices_per_mesh, F&& f) {
  const std::vector<Isa> isas = available_isas();
  std::size_t cases = 0;
  for (std::uint64_t seed = 0; seed < meshes; ++seed) {
    const TestMesh mesh = make_mesh(family, seed, seed == 0 ? 1500 : std::min<std::size_t>(draw_size(seed), 400));
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index built = build(mesh.view());
    const IndexView& index = IndexAccess::view(built);
    Random random(seed);
    for (std::size_t i = 0; i < vertices_per_mesh; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) {
        const Query query(index, v, RadiusBounds(index.frame, radius));
        f(SearchCase{mesh, oracle, index, query, kernels(isas[cases++ % isas.size()])});
      }
    }
  }
  return cases;
}

}  // namespace meshhood::test
