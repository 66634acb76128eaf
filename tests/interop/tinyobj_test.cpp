// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tiny_obj_loader.h>

#include "io/mesh_io.h"
#include "support/shared_meshes.h"

// Compares every shared OBJ mesh, except the broken ones, with tinyobjloader.

namespace meshhood::test {
namespace {

struct Faces {
  std::vector<std::size_t> sizes;
  std::vector<std::uint32_t> corners;

  bool operator==(const Faces&) const = default;
};

Faces faces_of(const io::Mesh& mesh) {
  Faces faces;
  faces.corners = mesh.corners;
  mesh.view().faces.for_each(
      [&faces](std::size_t, std::span<const VertexId> corners) { faces.sizes.push_back(corners.size()); });
  return faces;
}

Faces faces_of(const std::vector<tinyobj::shape_t>& shapes) {
  Faces faces;
  for (const auto& shape : shapes) {
    for (const auto size : shape.mesh.num_face_vertices) faces.sizes.push_back(size);
    for (const auto& corner : shape.mesh.indices)
      faces.corners.push_back(static_cast<std::uint32_t>(corner.vertex_index));
  }
  return faces;
}

struct Tally {
  std::size_t meshes = 0;
  std::size_t coordinates = 0;
  std::size_t faces = 0;
};

void compare(const std::string& name, Tally& tally) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::string warning;
  std::string error;
  const auto path = (shared_meshes_dir() / name).string();
  ASSERT_TRUE(tinyobj::LoadObj(&attributes, &shapes, nullptr, &warning, &error, path.c_str(), nullptr, false)) << error;

  const auto mesh = io::read_mesh(path, {.precision = io::Precision::Float});
  EXPECT_EQ(faces_of(mesh), faces_of(shapes));
  const auto& ours = std::get<std::vector<float>>(mesh.positions);
  EXPECT_EQ(ours, attributes.vertices);
  ++tally.meshes;
  tally.coordinates += ours.size();
  tally.faces += mesh.view().faces.size();
}

TEST(Interop, TinyobjloaderReadsTheSame) {
  MESHHOOD_NEED_SHARED_MESHES();
  Tally tally;
  for (const auto& row : read_manifest()) {
    if (!row.file.ends_with(".obj") || row.file.starts_with("broken/")) continue;
    SCOPED_TRACE(row.file);
    compare(row.file, tally);
  }
  std::printf("%zu meshes: %zu coordinates and %zu faces equal\n", tally.meshes, tally.coordinates, tally.faces);
  EXPECT_GE(tally.meshes, 30U);
}

}  // namespace
}  // namespace meshhood::test
