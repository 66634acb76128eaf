// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

// All conversions of nanobind that any source uses: those of a type must be the same in all of them.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "meshhood/mesh.h"
#include "meshhood/start.h"

namespace meshhood::python {

/// An array of Python, read in place: C order, in the memory of the processor, of any type.
using Input = nanobind::ndarray<nanobind::ro, nanobind::c_contig, nanobind::device::cpu>;

/// Bytes of Python, read in place.
using Bytes = nanobind::ndarray<const std::uint8_t, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>;

/// Ids, numbers and points, read in place.
using Ids = nanobind::ndarray<const std::int32_t, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>;
using Reals = nanobind::ndarray<const double, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>;
using Points = nanobind::ndarray<const double, nanobind::shape<-1, 3>, nanobind::c_contig, nanobind::device::cpu>;

[[nodiscard]] inline std::span<const VertexId> ids_of(const Ids& ids) {
  return {reinterpret_cast<const VertexId*>(ids.data()), ids.size()};
}
[[nodiscard]] inline std::span<const double> numbers_of(const Reals& array) { return {array.data(), array.size()}; }
[[nodiscard]] inline std::span<const double> numbers_of(const std::optional<Reals>& array) {
  return array ? numbers_of(*array) : std::span<const double>();
}
[[nodiscard]] inline std::span<const std::uint8_t> bytes_of(const std::optional<Bytes>& array) {
  return array ? std::span(array->data(), array->size()) : std::span<const std::uint8_t>();
}
[[nodiscard]] inline std::span<const SpacePoint> points_of(const Points& points) {
  static_assert(sizeof(SpacePoint) == 3 * sizeof(double));
  return {reinterpret_cast<const SpacePoint*>(points.data()), points.shape(0)};
}

/// An array that is returned to Python.
template <class T>
using Output = nanobind::ndarray<nanobind::numpy, T>;

/// Views of float32 or float64, and of integers of 32 or 64 bits. They last as long as the array.
/// Throws a TypeError that names `argument` for another type.
[[nodiscard]] PositionsView positions_of(const Input& array, const char* argument);
[[nodiscard]] IndicesView indices_of(const Input& array, const char* argument);

/// Corners, and offsets unless all faces are triangles; of the argument F.
using Faces = std::pair<Input, std::optional<Input>>;
[[nodiscard]] FacesView faces_of(const Faces& faces);

/// Positions, corners and offsets; of the arguments V and F.
using Mesh = std::tuple<Input, Input, std::optional<Input>>;
[[nodiscard]] MeshView mesh_of(const Mesh& mesh);

/// Throws Error{TooLarge} for more vertices than there are ids in Python.
void check_vertex_count(std::size_t count);

/// An array that owns the values, which Python sees as `T`; writable unless that is const.
template <class T, class Value>
Output<T> owned(std::vector<Value>&& values, std::initializer_list<std::size_t> shape) {
  static_assert(sizeof(Value) % sizeof(T) == 0);
  auto holder = std::make_unique<std::vector<Value>>(std::move(values));
  auto* const data = reinterpret_cast<T*>(holder->data());
  const nanobind::capsule owner(holder.get(),
                                [](void* vector) noexcept { delete static_cast<std::vector<Value>*>(vector); });
  holder.release();
  return Output<T>(data, shape, owner);
}

template <class T, class Value>
auto owned(std::vector<Value>&& values) {
  const std::size_t size = values.size();
  return owned<T>(std::move(values), {size});
}

/// Positions, #V by 3.
template <class Real>
nanobind::object owned_positions(std::vector<Real>&& xyz) {
  const std::size_t size = xyz.size() / 3;
  return nanobind::cast(owned<Real>(std::move(xyz), {size, 3}));
}

/// An array in memory of NumPy, of `rows` values, or by `columns` if these are not 0, that are not set. For large
/// arrays this is faster than a vector, which would be initialized first: NumPy asks the system for large pages.
[[nodiscard]] nanobind::object unset(std::size_t rows, const char* dtype, std::size_t columns = 0);

/// The values of such an array as `T`, which has as many bytes as one or several of them.
template <class T>
std::span<T> values_of(const nanobind::object& array) {
  const auto values = nanobind::cast<nanobind::ndarray<nanobind::c_contig, nanobind::device::cpu>>(array);
  return {static_cast<T*>(values.data()), values.nbytes() / sizeof(T)};
}

}  // namespace meshhood::python
