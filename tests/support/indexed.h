// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "meshhood/index.h"
#include "meshhood/surface.h"

#include "support/test_mesh.h"

/// A mesh with what tests make of it, to be taken apart by a structured binding.
namespace meshhood::test {

struct Indexed {
  TestMesh mesh;
  Index index;
};

[[nodiscard]] inline Indexed indexed(TestMesh mesh) {
  Index index = build(mesh.view());
  return {std::move(mesh), std::move(index)};
}

struct WithSurface {
  TestMesh mesh;
  Index index;
  Surface surface;
};

[[nodiscard]] inline WithSurface with_surface(TestMesh mesh) {
  Index index = build(mesh.view());
  Surface surface(index, mesh.view().faces);
  return {std::move(mesh), std::move(index), std::move(surface)};
}

}  // namespace meshhood::test
