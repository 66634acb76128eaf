// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>

#include "io/mesh_io.h"
#include "shapes/shapes.h"

#if defined(MESHHOOD_FAMILIES)
#include "support/families.h"
#endif

namespace meshhood::bench {

/// A mesh file, or a shape by kind and size ("scroll:1000000"). With the tests, also one of their families
/// ("mixed scales:20000").
class MeshArgument {
 public:
  /// `precision`: of the positions of a file.
  explicit MeshArgument(const std::string& name, io::Precision precision = io::Precision::FromFile)
      : mesh_(load(name, {.precision = precision})) {}

  [[nodiscard]] MeshView view() const {
    return std::visit([](const auto& mesh) { return mesh.view(); }, mesh_);
  }

 private:
#if defined(MESHHOOD_FAMILIES)
  using Either = std::variant<io::Mesh, shapes::Shape, test::TestMesh>;
#else
  using Either = std::variant<io::Mesh, shapes::Shape>;
#endif

  static Either load(const std::string& name, const io::ReadOptions& reading) {
    const auto colon = name.find(':');
    if (colon == std::string::npos) return io::read_mesh(name, reading);
    const std::string kind_name = name.substr(0, colon);
    const shapes::Kind* kind = shapes::find_kind(kind_name);
    if (kind != nullptr) return kind->make(std::stoul(name.substr(colon + 1)));
#if defined(MESHHOOD_FAMILIES)
    for (const test::Family& family : test::families()) {
      if (family.name == kind_name) return test::make_mesh(family, 1, std::stoul(name.substr(colon + 1)));
    }
#endif
    return io::read_mesh(name, reading);
  }

  Either mesh_;
};

}  // namespace meshhood::bench
