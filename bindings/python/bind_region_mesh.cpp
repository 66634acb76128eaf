// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/tuple.h>

#include "meshhood/region_mesh.h"

#include "arrays.h"
#include "bindings.h"

namespace nb = nanobind;

// These calls keep the interpreter lock: they are short, and the mesher is not for several threads.
namespace meshhood::python {
namespace {

using IdList = nb::ndarray<const std::int32_t, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

std::span<const VertexId> id_span(const IdList& ids) {
  return {reinterpret_cast<const VertexId*>(ids.data()), ids.size()};
}

Corners corners_of(bool all) { return all ? Corners::All : Corners::Any; }

/// The caller keeps the positions alive and unchanged.
std::shared_ptr<RegionMesher> make_mesher(const Input& positions, const Input& corners,
                                          const std::optional<Input>& offsets) {
  return std::make_shared<RegionMesher>(MeshView{positions_of(positions, "V"), faces_of(corners, offsets)});
}

Output<std::int64_t> faces(RegionMesher& mesher, const IdList& ids, bool all) {
  return owned<std::int64_t>(mesher.faces(id_span(ids), corners_of(all)));
}

auto submesh(RegionMesher& mesher, const IdList& ids, bool all) {
  Submesh part = mesher.submesh(id_span(ids), corners_of(all));
  return std::tuple(owned<std::int32_t>(std::move(part.vertices)), owned<std::int64_t>(std::move(part.faces)),
                    owned<std::int64_t>(std::move(part.offsets)), owned<std::int32_t>(std::move(part.corners)));
}

auto clip(RegionMesher& mesher, const IdList& ids, const SpacePoint& center, double radius) {
  ClippedMesh part = mesher.clip(id_span(ids), center, radius);
  const std::size_t points = part.points.size();
  return std::tuple(owned<double>(std::move(part.points), {points, 3}),
                    owned<std::int32_t>(std::move(part.edges), {points, 2}), owned<std::int64_t>(std::move(part.faces)),
                    owned<std::int64_t>(std::move(part.offsets)), owned<std::int32_t>(std::move(part.corners)));
}

auto rim(RegionMesher& mesher, const IdList& ids, const SpacePoint& center, double radius) {
  Rim rim = mesher.rim(id_span(ids), center, radius);
  const std::size_t size = rim.points.size();
  return std::tuple(owned<double>(std::move(rim.points), {size, 3}),
                    owned<std::int32_t>(std::move(rim.edges), {size, 2}), owned<std::int64_t>(std::move(rim.offsets)),
                    owned<std::uint8_t>(std::move(rim.closed)));
}

}  // namespace

void bind_region_mesh(nb::module_& module) {
  nb::class_<RegionMesher>(module, "Mesher")
      .def_prop_ro("face_count", &RegionMesher::face_count)
      .def("faces", &faces)
      .def("submesh", &submesh)
      .def("clip", &clip)
      .def("rim", &rim);
  module.def("mesher", &make_mesher, nb::arg(), nb::arg(), nb::arg("offsets").none(), nb::keep_alive<0, 1>());
}

}  // namespace meshhood::python
