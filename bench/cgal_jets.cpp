// SPDX-License-Identifier: MIT
// CGAL's Monge_via_jet_fitting of degrees 2 and 2 for a sample of the vertices, on neighborhoods that our searcher
// finds: the processor time of the fit and of the search, in microseconds a row, as JSON.
//
//   cgal_jets MESH RADIUS_IN_MEAN_EDGES
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include "meshhood/meshhood.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

void measure_jets(const MeshView& mesh, double edges) {
  const Index index = build(mesh);
  const double radius = edges * mean_edge_length(index);
  const std::size_t rows = edges <= 10 ? 2000 : 200;
  const std::size_t step = std::max<std::size_t>(1, index.vertex_count() / rows);
  Searcher searcher(index);
  std::vector<VertexId> ids;
  std::vector<Kernel::Point_3> points;
  double search = 0;
  double fit = 0;
  double sum = 0;
  std::size_t done = 0;
  for (std::size_t v = 0; v < index.vertex_count(); v += step) {
    const double start = measure::processor_time();
    searcher.neighborhood(static_cast<VertexId>(v), radius, ids);
    const double found = measure::processor_time();
    search += found - start;
    if (ids.size() < 6) continue;
    points.clear();
    const auto add = [&](std::size_t w) {
      mesh.positions.visit([&](const auto& xyz) { points.emplace_back(xyz(w, 0), xyz(w, 1), xyz(w, 2)); });
    };
    add(v);
    for (const VertexId w : ids) {
      if (w != v) add(w);
    }
    CGAL::Monge_via_jet_fitting<Kernel> fitting;
    sum += fitting(points.begin(), points.end(), 2, 2).principal_curvatures(0);
    fit += measure::processor_time() - found;
    ++done;
  }
  const double each = 1e6 / static_cast<double>(done);
  std::printf("{\"rows\": %zu, \"fit\": %.5g, \"search\": %.5g, \"sum\": %.5g}\n", done, each * fit, each * search,
              sum);
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  using namespace meshhood::bench;
  return run_program(argc, argv, {"cgal_jets MESH RADIUS_IN_MEAN_EDGES", 2, 2}, [](const Arguments& arguments) {
    const MeshArgument mesh(arguments[0]);
    measure_jets(mesh.view(), std::stod(arguments[1]));
    return 0;
  });
}
