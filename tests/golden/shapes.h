// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "meshhood/paper.h"
#include "meshhood/reorder.h"
#include "meshhood/serialize.h"

#include "support/families.h"
#include "support/index_bytes.h"

namespace meshhood::test {

enum class GoldenIndex { Exact, Reordered, Paper };

/// The meshes of the golden files, made without functions that differ between C libraries.
struct GoldenShape {
  std::string name;
  TestMesh mesh;
  GoldenIndex index = GoldenIndex::Exact;
};

/// A wavy grid above another one, in triangles or quads, and 40 vertices without faces.
[[nodiscard]] inline TestMesh wavy_grids(std::size_t side, bool quads, bool single) {
  Random random(side);
  TestMesh mesh = make_grid(side, side + 3, quads);
  for (double& x : mesh.positions) x += random.uniform(-0.25, 0.25);
  TestMesh upper = make_grid(side, 4, !quads);
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] += random.uniform(1.0, 1.5);
  append(mesh, upper);
  for (std::uint32_t v = 0; v < 40; ++v) mesh.add_vertex(v * 0.5, -1, random.uniform());
  return mesh.finish(single);
}

[[nodiscard]] inline std::vector<GoldenShape> golden_shapes() {
  return {{"float", wavy_grids(15, false, true)},
          {"double", wavy_grids(12, true, false)},
          {"reordered", wavy_grids(9, false, true), GoldenIndex::Reordered},
          {"empty", TestMesh().finish(true)},
          {"paper", wavy_grids(14, false, true), GoldenIndex::Paper},
          {"paper_double", wavy_grids(11, true, false), GoldenIndex::Paper},
          {"paper_empty", TestMesh().finish(true), GoldenIndex::Paper}};
}

/// The paper's index always uses one thread.
[[nodiscard]] inline std::vector<std::byte> golden_bytes(const GoldenShape& shape, unsigned threads = 1) {
  const MeshView mesh = shape.mesh.view();
  switch (shape.index) {
    case GoldenIndex::Exact: return saved(build(mesh, {.threads = threads}));
    case GoldenIndex::Reordered: return saved(reorder(mesh, {.threads = threads}).index);
    case GoldenIndex::Paper: return saved(paper::build(mesh));
  }
  return {};
}

}  // namespace meshhood::test
