// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "support/families.h"

namespace meshhood::test {
namespace {

std::uint32_t add_random_vertex(TestMesh& mesh, Random& random, double size = 1) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  return mesh.add_vertex(x, y, random.uniform(-size, size));
}

void add_on_circle(TestMesh& mesh, std::size_t i, std::size_t n) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
  mesh.add_vertex(std::cos(angle), std::sin(angle), 0);
}

TestMesh fan(Random&, std::size_t vertices) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  for (std::size_t i = 1; i < vertices; ++i) add_on_circle(mesh, i, vertices);
  for (std::uint32_t i = 2; i < vertices; ++i) mesh.add_face({0, i - 1, i});
  return mesh;
}

/// Edges alone, as faces of two corners.
TestMesh star(Random& random, std::size_t vertices) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  for (std::size_t i = 1; i < vertices; ++i) {
    mesh.add_face({0, add_random_vertex(mesh, random)});
  }
  return mesh;
}

TestMesh path(Random& random, std::size_t vertices) {
  TestMesh mesh;
  double x = 0;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.add_vertex(x += random.uniform(0.5, 1.5), random.uniform(-0.3, 0.3), 0);
    if (i > 0) mesh.add_face({i - 1, i});
  }
  return mesh;
}

/// A strip of triangles that winds around itself.
TestMesh spiral(Random& random, std::size_t vertices) {
  TestMesh mesh;
  const double gap = random.uniform(0.02, 0.5);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const std::uint32_t step = i / 2;  // each two vertices lie one above the other
    const double angle = 0.2 * step;
    const double radius = 1 + gap * angle / (2 * std::numbers::pi);
    mesh.add_vertex(radius * std::cos(angle), radius * std::sin(angle), i % 2 == 0 ? 0 : 0.2);
    if (i > 1) mesh.add_face({i - 2, i - 1, i});
  }
  return mesh;
}

/// Teeth side by side on one bar: neighbors in space are connected only through the bar.
TestMesh comb(Random& random, std::size_t vertices) {
  TestMesh mesh;
  const std::size_t length = 2 + random.below(15);
  std::uint32_t previous_root = 0;
  for (std::size_t tooth = 0; mesh.size() + length <= std::max(vertices, length); ++tooth) {
    const double x = 0.1 * static_cast<double>(tooth);
    const std::uint32_t root = mesh.add_vertex(x, 0, 0);
    if (tooth > 0) mesh.add_face({previous_root, root});
    previous_root = root;
    for (std::size_t i = 1; i < length; ++i) {
      const std::uint32_t tip = mesh.add_vertex(x, static_cast<double>(i), 0);
      mesh.add_face({tip - 1, tip});
    }
  }
  return mesh;
}

TestMesh polygon(Random&, std::size_t vertices) {
  TestMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) add_on_circle(mesh, i, vertices);
  std::vector<std::uint32_t> face(vertices);
  std::iota(face.begin(), face.end(), 0U);
  mesh.add_face(face);
  return mesh;
}

TestMesh clique(Random& random, std::size_t vertices) {
  TestMesh mesh;
  const std::size_t n = std::min<std::size_t>(vertices, 60);
  for (std::uint32_t i = 0; i < n; ++i) {
    add_random_vertex(mesh, random);
    for (std::uint32_t j = 0; j < i; ++j) mesh.add_face({i, j});
  }
  return mesh;
}

TestMesh soup(Random& random, std::size_t vertices) {
  TestMesh mesh;
  for (std::uint32_t v = 0; v + 2 < vertices; v += 3) {
    for (int i = 0; i < 3; ++i) add_random_vertex(mesh, random);
    mesh.add_face({v, v + 1, v + 2});
  }
  return mesh;
}

/// Pages on one spine: every edge of the spine belongs to all pages.
TestMesh book(Random& random, std::size_t vertices) {
  TestMesh mesh;
  const std::size_t pages = 3 + random.below(10);
  const auto length = static_cast<std::uint32_t>(std::max<std::size_t>(2, vertices / (pages + 1)));
  for (std::uint32_t i = 0; i < length; ++i) mesh.add_vertex(0, 0, i);
  for (std::size_t page = 0; page < pages; ++page) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(page) / static_cast<double>(pages);
    const auto first = static_cast<std::uint32_t>(mesh.size());
    for (std::uint32_t i = 0; i < length; ++i) mesh.add_vertex(std::cos(angle), std::sin(angle), i);
    for (std::uint32_t i = 1; i < length; ++i) mesh.add_face({i - 1, i, first + i, first + i - 1});
  }
  return mesh;
}

/// Many small closed shells, some inside each other; some pairs share a single vertex.
TestMesh shells(Random& random, std::size_t vertices) {
  TestMesh mesh;
  while (mesh.size() + 4 <= std::max<std::size_t>(vertices, 4)) {
    std::vector<std::uint32_t> v;
    if (mesh.size() > 0 && random.below(10) == 0) v.push_back(static_cast<std::uint32_t>(random.below(mesh.size())));
    while (v.size() < 4) v.push_back(add_random_vertex(mesh, random, 2));
    for (std::size_t i = 0; i < 4; ++i) mesh.add_face({v[i], v[(i + 1) % 4], v[(i + 2) % 4]});
  }
  return mesh;
}

TestMesh isolated_vertices(Random& random, std::size_t vertices) {
  const std::size_t n = std::max<std::size_t>(2, static_cast<std::size_t>(std::sqrt(vertices / 2)));
  TestMesh mesh = make_grid(n, n, false);
  while (mesh.size() < vertices) add_random_vertex(mesh, random, static_cast<double>(n));
  return mesh;
}

/// Faces of 0 to 9 random corners, often with repeated ones.
TestMesh random_faces(Random& random, std::size_t vertices) {
  TestMesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) add_random_vertex(mesh, random);
  const std::size_t faces = random.below(vertices + 1);
  for (std::size_t f = 0; f < faces; ++f) {
    std::vector<std::uint32_t> face(random.below(10));
    const std::size_t around = random.below(vertices);
    for (std::uint32_t& corner : face) {
      corner = static_cast<std::uint32_t>((around + random.below(random.below(4) == 0 ? vertices : 4)) % vertices);
    }
    mesh.add_face(face);
  }
  return mesh;
}

constexpr auto kTraps = std::to_array<Family>({
    {"fan", fan},
    {"star", star},
    {"path", path},
    {"spiral", spiral},
    {"comb", comb},
    {"polygon", polygon},
    {"clique", clique},
    {"soup", soup},
    {"book", book},
    {"shells", shells},
    {"isolated vertices", isolated_vertices},
    {"random faces", random_faces},
});

}  // namespace

std::span<const Family> trap_families() { return kTraps; }

}  // namespace meshhood::test
