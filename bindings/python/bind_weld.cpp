// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include "about.h"
#include "arrays.h"
#include "bindings.h"
#include "graph_copy.h"
#include "interpreter.h"
#include "io/weld.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// Returns positions (#kept by 3), corners, offsets (empty for triangles), and the new id of each vertex.
auto weld(const Input& positions, const Input& corners, const std::optional<Input>& offsets, double eps) {
  const MeshView mesh{positions_of(positions, "V"), faces_of(corners, offsets)};
  io::WeldedMesh welded = without_lock([&] {
    about("V", [&] {
      validate(mesh.positions);
      check_vertex_count(mesh.positions.size());
    });
    return about("F", [&] { return io::weld(mesh, eps); });
  });
  nb::object kept = std::visit(
      [](auto& xyz) {
        using Real = typename std::decay_t<decltype(xyz)>::value_type;
        const std::size_t size = xyz.size() / 3;
        return nb::cast(owned<Real>(std::move(xyz), {size, 3}));
      },
      welded.positions);
  return std::tuple(std::move(kept), owned<std::int32_t>(std::move(welded.corners)),
                    owned<std::int64_t>(std::move(welded.offsets)), owned<std::int32_t>(std::move(welded.ids)));
}

}  // namespace

void bind_weld(nb::module_& module) {
  module.def("weld", &weld, nb::arg(), nb::arg(), nb::arg("offsets").none(), nb::arg("eps"));
}

}  // namespace meshhood::python
