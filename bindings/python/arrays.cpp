// SPDX-License-Identifier: MIT
#include "arrays.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "meshhood/error.h"

#include "interpreter.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

// Ids are int32 in Python, as SciPy's sparse matrices have them.
constexpr std::size_t kMostVertices = std::numeric_limits<std::int32_t>::max();

template <class T>
bool holds(const Input& array) {
  return array.dtype() == nb::dtype<T>();
}

template <class T>
std::span<const T> span_of(const Input& array) {
  return {static_cast<const T*>(array.data()), array.size()};
}

[[noreturn]] void refuse(const char* argument, const char* expected) {
  throw nb::type_error((std::string(argument) + ": expected " + expected).c_str());
}

}  // namespace

PositionsView positions_of(const Input& array, const char* argument) {
  if (holds<float>(array)) return span_of<float>(array);
  if (holds<double>(array)) return span_of<double>(array);
  refuse(argument, "float32 or float64");
}

IndicesView indices_of(const Input& array, const char* argument) {
  if (holds<std::int32_t>(array)) return span_of<std::int32_t>(array);
  if (holds<std::int64_t>(array)) return span_of<std::int64_t>(array);
  if (holds<std::uint32_t>(array)) return span_of<std::uint32_t>(array);
  if (holds<std::uint64_t>(array)) return span_of<std::uint64_t>(array);
  refuse(argument, "integers of 32 or 64 bits");
}

FacesView faces_of(const Faces& faces) {
  const auto& [corners, offsets] = faces;
  const IndicesView flat = indices_of(corners, "F");
  return offsets ? FacesView::polygons(indices_of(*offsets, "F"), flat) : FacesView::triangles(flat);
}

MeshView mesh_of(const Mesh& mesh) {
  const auto& [positions, corners, offsets] = mesh;
  return {positions_of(positions, "V"), faces_of({corners, offsets})};
}

void check_vertex_count(std::size_t count) {
  if (count <= kMostVertices) return;
  raise(ErrorCode::TooLarge, std::to_string(count) + " vertices, but the limit is " + std::to_string(kMostVertices));
}

// The name of a type with a shape, as "(3,)float64", would run Python code, in which a thread may be ended while it has
// other arrays.
nb::object unset(std::size_t rows, const char* dtype, std::size_t columns) {
  return stop_at_shutdown([&] {
    const nb::object empty = nb::module_::import_("numpy").attr("empty");
    return columns == 0 ? empty(rows, dtype) : empty(nb::make_tuple(rows, columns), dtype);
  });
}

}  // namespace meshhood::python
