// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/error.h"
#include "meshhood/face_graph.h"
#include "meshhood/index.h"
#include "meshhood/link_points.h"
#include "meshhood/paper.h"
#include "meshhood/refit.h"

#include "about.h"
#include "arrays.h"
#include "bindings.h"
#include "interpreter.h"
#include "methods.h"
#include "shared/coarse_float.h"
#include "shared/unplaced.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// The first edge of `some` that `all` does not have.
std::optional<std::pair<std::size_t, VertexId>> first_missing(const AdjacencyView& some, const AdjacencyView& all) {
  for (std::size_t v = 0; v < some.size(); ++v) {
    for (const VertexId w : some[v]) {
      if (!std::ranges::binary_search(all[v], w)) return std::pair(v, w);
    }
  }
  return std::nullopt;
}

/// Positions that other threads may write to, copied before they are validated; no edges. An error begins with
/// `argument`.
GraphData positions_copy(const PositionsView& positions, const char* argument) {
  GraphData copy;
  positions.visit([&](const auto& strided) {
    const auto xyz = strided.packed();
    copy.positions = std::vector(xyz.begin(), xyz.end());
  });
  about(argument, [&] {
    validate(copy.view().positions);
    check_vertex_count(positions.size());
  });
  return copy;
}

/// Throws unless the faces are those of the graph: some of its faces, or all of them if edges were cut. So the edges of
/// one are edges of the other.
void check_faces(const GraphView& graph, const FacesView& faces) {
  const Adjacency of_faces = about("F", [&] { return adjacency({graph.positions, faces}); });
  const auto missing = first_missing(of_faces.view(), graph.adjacency);
  if (!missing || !first_missing(graph.adjacency, of_faces.view())) return;
  raise(ErrorCode::InvalidMesh, "F: faces of another mesh: one joins vertices " + std::to_string(missing->first) +
                                    " and " + std::to_string(missing->second) + ", which the index does not");
}

std::shared_ptr<ExactMethod> make_exact(const Mesh& given, const std::optional<Input>& cut, unsigned threads,
                                        nb::handle progress) {
  const MeshView mesh = mesh_of(given);
  const Run run{.threads = threads, .progress = progress_to(progress)};
  const IndicesView edges = cut ? indices_of(*cut, "cut") : IndicesView();
  return without_lock([&] {
    GraphData copy = positions_copy(mesh.positions, "V");
    const MeshView copied{copy.view().positions, mesh.faces};
    if (!cut) return about("F", [&] { return exact_method(build(copied, run)); });
    copy.adjacency = about("F", [&] { return adjacency(copied); });
    copy.adjacency = about("cut", [&] { return cut_edges(copy.adjacency.view(), edges); });
    return exact_method(build(copy.view(), run));
  });
}

/// For vertices of NaN in no face: positions with these at another vertex, and the mask of them. Otherwise None.
std::optional<std::pair<nb::object, Output<bool>>> place_all(const Mesh& given) {
  const MeshView mesh = mesh_of(given);
  return mesh.positions.visit([&](const auto& positions) -> decltype(place_all(given)) {
    using Real = std::remove_cvref_t<decltype(positions.packed().front())>;
    const std::span<const Real> all = positions.packed();
    if (std::none_of(all.begin(), all.end(), [](Real x) { return std::isnan(x); })) return std::nullopt;
    std::vector<Real> xyz(all.begin(), all.end());
    Unplaced unplaced =
        without_lock([&] { return about("F", [&] { return place(std::span<Real>(xyz), mesh.faces); }); });
    if (unplaced.used) raise(ErrorCode::InvalidMesh, "V: " + unplaced.used->text());
    return std::pair(owned_positions(std::move(xyz)), owned<bool>(std::move(unplaced.walls)));
  });
}

/// The index of points that are joined if at most `link` apart.
std::shared_ptr<ExactMethod> make_linked(const Input& positions, double link, std::size_t max_edges, unsigned threads,
                                         nb::handle progress) {
  const PositionsView points = positions_of(positions, "P");
  const LinkOptions options{.max_edges = max_edges};
  const Run run{.threads = threads, .progress = progress_to(progress)};
  return without_lock([&] {
    const GraphData copy = positions_copy(points, "P");
    return exact_method(build_linked(copy.view().positions, link, options, run));
  });
}

/// The index of the faces of a mesh.
std::shared_ptr<ExactMethod> make_of_faces(const Mesh& given, unsigned threads, nb::handle progress) {
  const MeshView mesh = mesh_of(given);
  const Run run{.threads = threads, .progress = progress_to(progress)};
  return without_lock([&] {
    const GraphData copy = positions_copy(mesh.positions, "V");
    const GraphData graph = about("F", [&] {
      check_vertex_count(mesh.faces.size());
      return face_graph({copy.view().positions, mesh.faces});
    });
    return exact_method(build(graph.view(), run));
  });
}

std::shared_ptr<ExactMethod> make_refitted(const ExactMethod& method, const Input& positions,
                                           const std::optional<Input>& changed, unsigned threads, nb::handle progress) {
  const PositionsView moved = positions_of(positions, "V");
  const IndicesView vertices = changed ? indices_of(*changed, "changed") : IndicesView();
  const Run run{.threads = threads, .progress = progress_to(progress)};
  return without_lock([&] {
    return about("V", [&] {
      return exact_method(changed ? refit(method.index(), moved, vertices, run) : refit(method.index(), moved, run));
    });
  });
}

/// Says why float is coarse for a mesh; None if it is not.
std::optional<std::string> why_coarse(const Mesh& given) {
  const MeshView mesh = mesh_of(given);
  const auto coarse = without_lock([&] { return coarse_float(mesh); });
  return coarse ? std::optional(coarse->text()) : std::nullopt;
}

std::shared_ptr<GraphData> make_graph(const ExactMethod& method) {
  return without_lock([&] { return std::make_shared<GraphData>(extract_graph(method.index())); });
}

/// A copy in the order of the mesh, which may not be written to.
nb::object positions(const ExactMethod& method) {
  const Index& index = method.index();
  return index.positions().visit([&](const auto& xyz) {
    using Real = std::remove_cvref_t<decltype(xyz.packed().front())>;
    std::vector<Real> copy(3 * index.vertex_count());
    without_lock([&] {
      const std::span<const VertexId> ids = index.permutation();
      for (std::size_t place = 0; place < index.vertex_count(); ++place) {
        const std::size_t id = ids.empty() ? place : ids[place];
        std::copy_n(xyz.packed().begin() + static_cast<std::ptrdiff_t>(3 * place), 3,
                    copy.begin() + static_cast<std::ptrdiff_t>(3 * id));
      }
    });
    return nb::cast(owned<const Real>(std::move(copy), {index.vertex_count(), 3}));
  });
}

std::shared_ptr<paper::Index> make_hierarchy(const GraphData& graph, int levels, int discard, double fusion_growth) {
  const paper::BuildOptions options{.levels = levels, .discard = discard, .fusion_growth = fusion_growth};
  const Run run{.progress = progress_to(nb::handle(Py_None))};
  return without_lock([&] { return std::make_shared<paper::Index>(paper::build(graph.view(), options, run)); });
}

/// The approximate neighborhood by the index of the paper.
std::shared_ptr<Method> make_paper(std::shared_ptr<paper::Index> hierarchy, double radius_ratio) {
  const SearchMethod search(*hierarchy, {.radius_ratio = radius_ratio});
  return std::make_shared<Method>(search, std::move(hierarchy));
}

std::shared_ptr<Method> make_by_metric(std::shared_ptr<ExactMethod> exact, Metric metric) {
  const SearchMethod search = exact->search().by(metric);
  return std::make_shared<Method>(search, std::move(exact));
}

/// Breadth-first search.
std::shared_ptr<Method> make_bfs(std::shared_ptr<GraphData> graph) {
  const SearchMethod search = without_lock([&] { return SearchMethod::breadth_first(graph->view()); });
  return std::make_shared<Method>(search, std::move(graph));
}

}  // namespace

void bind_makers(nb::module_& module) {
  nb::class_<GraphData>(module, "Graph").def("mean_edge_length", [](const GraphData& graph) {
    return without_lock([&] { return mean_edge_length(graph.view()); });
  });
  static_cast<void>(nb::class_<paper::Index>(module, "Hierarchy"));
  module.def("exact", &make_exact, nb::arg(), nb::arg("cut").none(), nb::arg("threads"), nb::arg("progress").none());
  module.def("place", &place_all);
  module.def("check_mesh", [](const Mesh& given) {
    const MeshView mesh = mesh_of(given);
    without_lock([&] {
      about("V", [&] { validate(mesh.positions); });
      about("F", [&] { validate(mesh); });
    });
  });
  module.def("exact_of_points", &make_linked, nb::arg(), nb::arg("link"), nb::arg("max_edges"), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("exact_of_faces", &make_of_faces, nb::arg(), nb::arg("threads"), nb::arg("progress").none());
  module.def("refit", &make_refitted, nb::arg(), nb::arg(), nb::arg("changed").none(), nb::arg("threads"),
             nb::arg("progress").none());
  module.def("why_coarse", &why_coarse);
  module.def("graph", &make_graph);
  module.def("positions", &positions);
  module.def("check_faces", [](const GraphData& graph, const Faces& given) {
    const FacesView faces = faces_of(given);
    without_lock([&] { check_faces(graph.view(), faces); });
  });
  module.def("hierarchy", &make_hierarchy, nb::arg(), nb::arg("levels"), nb::arg("discard"), nb::arg("fusion_growth"));
  module.def("paper", &make_paper, nb::arg(), nb::arg("radius_ratio"));
  module.def("by_metric", &make_by_metric);
  module.def("bfs", &make_bfs);
}

}  // namespace meshhood::python
