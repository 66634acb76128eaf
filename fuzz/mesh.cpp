// SPDX-License-Identifier: MIT
// Arbitrary faces and coordinates. An input is a header of eight bytes (see `Header`), then equal numbers of bytes for
// coordinates and for faces. They change a surface that the header names, so that short inputs also give meshes of many
// leaves.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "meshhood/error.h"
#include "meshhood/index.h"

#include "bytes.h"
#include "judge.h"
#include "support/families.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

using test::Random;
using test::TestMesh;

struct Header {
  std::uint16_t vertices;
  std::uint8_t surface;      // to which the faces are added: none, a path, a grid, a star
  std::uint8_t coordinates;  // their encoding: see `coordinate`
  std::int16_t exponent;     // of a scale
  std::uint16_t seed;
};

enum class Surface { None, Path, Grid, Star };
enum class Coordinates { Lattice, Raw, Scaled, Noise };

double coordinate(Coordinates kind, double base, const Header& header, Bytes& bytes, Random& random) {
  switch (kind) {
    case Coordinates::Lattice: return base + bytes.take<std::int8_t>(static_cast<std::int8_t>(random.below(3)));
    case Coordinates::Raw: return bytes.take<double>(random.uniform(-1, 1));
    case Coordinates::Scaled:
      return std::ldexp(base + bytes.take<std::int8_t>(static_cast<std::int8_t>(random.below(3))),
                        header.exponent % 512);
    case Coordinates::Noise: return base + bytes.take<float>(static_cast<float>(random.uniform(0, 0.4)));
  }
  return base;
}

TestMesh surface(const Header& header) {
  const std::size_t vertices = header.vertices % 320U;
  if (static_cast<Surface>(header.surface % 4) == Surface::Grid) {
    const std::size_t rows = 1 + header.surface / 4U % 24U;
    return test::make_grid(rows, std::max<std::size_t>(1, vertices / rows), header.seed % 2 == 0);
  }
  TestMesh mesh;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    mesh.add_vertex(v, 0, 0);
    if (v == 0 || static_cast<Surface>(header.surface % 4) == Surface::None) continue;
    mesh.add_face({static_cast<Surface>(header.surface % 4) == Surface::Path ? v - 1 : 0, v});
  }
  return mesh;
}

/// Adds faces of up to seven corners, some of them out of range.
void add_faces(TestMesh& mesh, Bytes& bytes) {
  while (!bytes.empty()) {
    std::array<std::uint32_t, 7> corners{};
    const std::size_t size = bytes.take<std::uint8_t>(0) % 8U;
    for (std::size_t i = 0; i < size; ++i) {
      const auto corner = bytes.take<std::uint16_t>(0);
      corners[i] = corner >= 0xFF00U || mesh.size() == 0 ? corner : corner % static_cast<std::uint32_t>(mesh.size());
    }
    mesh.add_face(std::span(corners).first(size));
  }
}

/// Replaces coordinates of the surface by those of the input, as far as it has them.
void move_vertices(TestMesh& mesh, const Header& header, Bytes& bytes, Random& random) {
  const auto kind = static_cast<Coordinates>(header.coordinates / 2U % 4U);
  const bool random_rest = header.coordinates >= 128;
  for (double& x : mesh.positions) {
    if (!random_rest && bytes.empty()) break;
    x = coordinate(kind, x, header, bytes, random);
  }
}

bool is_valid(const MeshView& mesh) {
  try {
    validate(mesh);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// `build` must reject a mesh that `validate` rejects.
void expect_refused(const MeshView& mesh) {
  try {
    static_cast<void>(build(mesh));
  } catch (const Error&) {
    return;
  }
  fail("an invalid mesh was accepted");
}

}  // namespace

void run(std::span<const std::byte> input) {
  Bytes front(input);
  const Header header{front.take<std::uint16_t>(100), front.take<std::uint8_t>(2), front.take<std::uint8_t>(0),
                      front.take<std::int16_t>(0), front.take<std::uint16_t>(1)};
  const auto body = input.subspan(std::min<std::size_t>(input.size(), 8));
  Bytes coordinates(body.first(body.size() / 2));
  Bytes faces(body.subspan(body.size() / 2));
  Random random(header.seed);
  TestMesh mesh = surface(header);
  move_vertices(mesh, header, coordinates, random);
  add_faces(mesh, faces);
  mesh.finish(header.coordinates % 2 == 0);
  if (is_valid(mesh.view())) {
    judge(mesh, random, 64);
  } else {
    expect_refused(mesh.view());
  }
}

}  // namespace meshhood::fuzz
