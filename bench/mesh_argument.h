// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>

#include "io/mesh_io.h"
#include "shapes/shapes.h"

namespace meshhood::bench {

/// A mesh file, or a shape by kind and size ("scroll:1000000").
class MeshArgument {
 public:
  explicit MeshArgument(const std::string& name) : mesh_(load(name)) {}

  [[nodiscard]] MeshView view() const {
    return std::visit([](const auto& mesh) { return mesh.view(); }, mesh_);
  }

 private:
  using Either = std::variant<io::Mesh, shapes::Shape>;

  static Either load(const std::string& name) {
    const auto colon = name.find(':');
    const shapes::Kind* kind = colon == std::string::npos ? nullptr : shapes::find_kind(name.substr(0, colon));
    if (kind != nullptr) return kind->make(std::stoul(name.substr(colon + 1)));
    return io::read_mesh(name);
  }

  Either mesh_;
};

}  // namespace meshhood::bench
