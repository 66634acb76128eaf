// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "meshhood/batch.h"
#include "meshhood/error.h"

#include "arrays.h"
#include "interpreter.h"

namespace meshhood::python {

/// A number; an array, one for each row; or a list, of scales.
using Radius = std::variant<double, Reals, std::vector<double>>;

[[nodiscard]] inline BatchVertices vertices_of(const std::optional<Ids>& vertices) {
  if (!vertices) return {};
  return ids_of(*vertices);
}

[[nodiscard]] inline BatchRadius radius_of(const Radius& radius) {
  if (const auto* const radii = std::get_if<Reals>(&radius)) return numbers_of(*radii);
  if (const auto* const scales = std::get_if<std::vector<double>>(&radius)) return BatchRadius::scales(*scales);
  return std::get<double>(radius);
}

/// The query of a batch. Borrows the arrays.
[[nodiscard]] inline BatchQuery query_of(const std::optional<Ids>& vertices, const Radius& radius,
                                         Metric metric = Metric::Straight) {
  return {.vertices = vertices_of(vertices), .radius = radius_of(radius), .metric = metric};
}

/// Rows in memory of NumPy.
struct FoundRows {
  nanobind::object ids;
  nanobind::object distances;

  /// Allocates both, or the ids alone. Called with the interpreter lock; the result without it, on the same thread.
  [[nodiscard]] BatchAllocator allocator(bool has_distances) {
    return [this, has_distances, state = PyThreadState_Get()](std::size_t count) {
      return with_lock(state, [&]() -> BatchMemory {
        ids = unset(count, "int32");
        distances = unset(has_distances ? count : 0, "float64");
        return {values_of<VertexId>(ids), values_of<double>(distances)};
      });
    };
  }
};

/// A result beyond the limit of bytes: a MemoryError in Python.
class ResultTooLarge : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls `f`. An error of a radius names the argument `scales` if that has it; the module names `r`.
template <class F>
auto about_radii(const BatchRadius& radius, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InvalidRadius || !radius.scales()) throw;
    raise(ErrorCode::InvalidOption, std::string("scales: ") + error.what());
  }
}

/// Calls `f`, whose result alone may be too large. `advice`: what to do then.
template <class F>
auto limited(const char* advice, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::TooLarge) throw;
    throw ResultTooLarge(std::string(error.what()) + "; " + advice);
  }
}

}  // namespace meshhood::python
