// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/error.h"

#include "support/shared_meshes.h"
#include "support/test_mesh.h"

namespace meshhood::test {

/// The mesh of a file of the shared folder; none if the readers refuse it, which the tests of the readers cover.
inline std::optional<io::Mesh> readable_mesh(const std::string& file) {
  try {
    return shared_mesh(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// A copy with positions of the same precision.
inline TestMesh to_test_mesh(const std::string& name, const io::Mesh& mesh) {
  TestMesh copy;
  copy.name = name;
  std::visit([&](const auto& xyz) { copy.positions.assign(xyz.begin(), xyz.end()); }, mesh.positions);
  copy.corners = mesh.corners;
  copy.offsets = mesh.offsets;
  if (copy.offsets.empty()) {
    for (std::size_t corner = 0; corner <= copy.corners.size(); corner += 3) copy.offsets.push_back(corner);
  }
  return copy.finish(std::holds_alternative<std::vector<float>>(mesh.positions));
}

/// Calls `f(mesh)` for each readable mesh of a folder ("scan/") that has vertices, until a check fails. Returns their
/// number.
template <class F>
std::size_t for_each_shared_mesh(std::string_view folder, F&& f) {
  std::size_t meshes = 0;
  for (const ManifestRow& row : read_manifest()) {
    if (!row.file.starts_with(folder)) continue;
    const std::optional<io::Mesh> mesh = readable_mesh(row.file);
    if (!mesh) continue;
    const TestMesh copy = to_test_mesh(row.file, *mesh);
    if (copy.size() == 0) continue;
    SCOPED_TRACE(row.file);
    f(copy);
    ++meshes;
    if (testing::Test::HasFailure()) break;
  }
  return meshes;
}

/// The folders of the shared meshes, as parameters of tests, and the names of their cases.
inline auto shared_folders() {
  return testing::Values("paper/", "scan/", "cad/", "nonmanifold/", "components/", "poly/", "boundary/", "broken/");
}

inline std::string shared_folder_case(const testing::TestParamInfo<const char*>& folder) {
  const std::string name = folder.param;
  return name.substr(0, name.size() - 1);
}

}  // namespace meshhood::test
