// SPDX-License-Identifier: MIT
#include "data.h"

#include <cstdint>
#include <limits>
#include <string>

#include "meshhood/error.h"

namespace meshhood::python {
namespace {

// Ids are int32 in Python, as SciPy's sparse matrices have them.
constexpr std::size_t kMostVertices = std::numeric_limits<std::int32_t>::max();

/// Calls `f`; an error of it then begins with the name of the argument that it is about.
template <class F>
auto about(const char* argument, F&& f) {
  try {
    return f();
  } catch (const Error& error) {
    raise(error.code(), std::string(argument) + ": " + error.what());
  }
}

void check_positions(const PositionsView& positions) {
  validate(positions);
  if (positions.size() > kMostVertices) {
    raise(ErrorCode::TooLarge,
          std::to_string(positions.size()) + " vertices, but the limit is " + std::to_string(kMostVertices));
  }
}

}  // namespace

Data::Data(const MeshView& mesh) {
  about("V", [&] { check_positions(mesh.positions); });
  mesh.positions.visit([&](auto xyz) { positions_ = std::vector(xyz.begin(), xyz.end()); });
  adjacency_ = about("F", [&] { return adjacency({positions(), mesh.faces}); });
}

PositionsView Data::positions() const {
  return std::visit([](const auto& xyz) { return PositionsView(xyz); }, positions_);
}

GraphView Data::view() const { return {positions(), adjacency_.view()}; }

}  // namespace meshhood::python
