// SPDX-License-Identifier: MIT
#include <memory>
#include <optional>
#include <utility>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"
#include "meshhood/paper.h"

#include "arrays.h"
#include "bindings.h"
#include "graph_copy.h"
#include "methods.h"
#include "watch.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

FacesView faces_of(const Input& corners, const std::optional<Input>& offsets) {
  const IndicesView flat = indices_of(corners, "F");
  return offsets ? FacesView::polygons(indices_of(*offsets, "F"), flat) : FacesView::triangles(flat);
}

std::shared_ptr<ExactMethod> make_exact(const Input& positions, const Input& corners,
                                        const std::optional<Input>& offsets, unsigned threads, nb::handle progress) {
  const MeshView mesh{positions_of(positions, "V"), faces_of(corners, offsets)};
  const BuildOptions options{.threads = threads, .progress = watch(progress)};
  const nb::gil_scoped_release unlocked;
  return exact_method(build(graph_copy(mesh).view(), options));
}

std::shared_ptr<GraphData> make_graph(const ExactMethod& method) {
  const nb::gil_scoped_release unlocked;
  return std::make_shared<GraphData>(extract_graph(method.index()));
}

std::shared_ptr<paper::Index> make_hierarchy(const GraphData& graph, int levels, int discard, double fusion_growth) {
  const Progress progress = watch(nb::handle(Py_None));
  const nb::gil_scoped_release unlocked;
  return std::make_shared<paper::Index>(paper::build(
      graph.view(), {.levels = levels, .discard = discard, .fusion_growth = fusion_growth, .progress = progress}));
}

std::shared_ptr<Method> make_paper(std::shared_ptr<paper::Index> hierarchy, double factor) {
  return paper_method(std::move(hierarchy), {.radius_ratio = factor});
}

}  // namespace

void bind_makers(nb::module_& module) {
  static_cast<void>(nb::class_<GraphData>(module, "Graph"));
  static_cast<void>(nb::class_<paper::Index>(module, "Hierarchy"));
  module.def("exact", &make_exact, nb::arg(), nb::arg(), nb::arg("offsets").none(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("graph", &make_graph);
  module.def("hierarchy", &make_hierarchy, nb::arg(), nb::arg("levels"), nb::arg("discard"), nb::arg("fusion_growth"));
  module.def("paper", &make_paper, nb::arg(), nb::arg("factor"));
  module.def("bfs", [](std::shared_ptr<GraphData> graph) { return bfs_method(std::move(graph)); });
  module.def("ball", [](std::shared_ptr<GraphData> graph) { return ball_method(std::move(graph)); });
}

}  // namespace meshhood::python
