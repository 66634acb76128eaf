// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "support/hostile.h"
#include "support/scale.h"
#include "support/scratch.h"

// The peak memory of a process that reads a mesh is at most twice the decoded arrays plus 64 MB (R1).

namespace meshhood::test {
namespace {

constexpr std::size_t kSlack = 64'000'000;

struct Peak {
  std::size_t decoded = 0;
  std::size_t base = 0;
  std::size_t peak = 0;
};

Peak measure(const std::filesystem::path& file) {
  const auto command = std::string(MESHHOOD_READ_PEAK) + " '" + file.string() + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  Peak result;
  if (std::fscanf(pipe.get(), "%zu %zu %zu", &result.decoded, &result.base, &result.peak) != 3) {
    throw std::runtime_error("read_peak failed on " + file.string());
  }
  return result;
}

using Write = std::function<void(std::ofstream&)>;

class Memory : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
  }

  void expect_bounded(const std::string& name, const Write& write) {
    const auto path = scratch.path() / name;
    std::ofstream file(path, std::ios::binary);
    write(file);
    file.close();
    const auto [decoded, base, peak] = measure(path);
    std::printf("%-22s file %4zu MB, decoded %4zu MB, peak %4zu MB\n", name.c_str(),
                static_cast<std::size_t>(std::filesystem::file_size(path)) >> 20U, decoded >> 20U, peak >> 20U);
    EXPECT_GT(decoded, kSlack / 2) << "too small to measure";
    EXPECT_LE(peak - base, 2 * decoded + kSlack);
    std::filesystem::remove(path);
  }

  Scratch scratch;
};

// A strip of quadrangles, two triangles each.
constexpr std::uint32_t kPairs = 1'500'000;

template <class Vertex>
void each_vertex(Vertex vertex) {
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    vertex(static_cast<float>(i) * 0.001F, 0.125F);
    vertex(static_cast<float>(i) * 0.001F, 1.125F);
  }
}

template <class Face>
void each_face(Face face) {
  for (std::uint32_t v = 0; v + 3 < 2 * kPairs; v += 2) {
    face(v, v + 2, v + 1);
    face(v + 1, v + 2, v + 3);
  }
}

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(2 * kPairs) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(2 * kPairs - 2) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

// R1
TEST_F(Memory, PlyBinary) {
  expect_bounded("binary.ply", [](std::ofstream& file) {
    file << ply_header("binary_little_endian");
    each_vertex([&file](float x, float y) { file << little(x, y, 0.F); });
    each_face([&file](auto a, auto b, auto c) { file << little(std::uint8_t{3}, a, b, c); });
  });
}

// R1
TEST_F(Memory, PlyText) {
  expect_bounded("text.ply", [](std::ofstream& file) {
    file << ply_header("ascii");
    each_vertex([&file](float x, float y) { file << x << ' ' << y << " 0\n"; });
    each_face([&file](auto a, auto b, auto c) { file << "3 " << a << ' ' << b << ' ' << c << '\n'; });
  });
}

// R1
TEST_F(Memory, Obj) {
  expect_bounded("mesh.obj", [](std::ofstream& file) {
    each_vertex([&file](float x, float y) { file << "v " << x << ' ' << y << " 0\n"; });
    each_face([&file](auto a, auto b, auto c) { file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n'; });
  });
}

// R1
TEST_F(Memory, ObjWithPolygonsLast) {
  expect_bounded("polygons.obj", [](std::ofstream& file) {
    each_vertex([&file](float x, float y) { file << "v " << x << ' ' << y << " 0\n"; });
    each_face([&file](auto a, auto b, auto c) { file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n'; });
    file << "f 1 2 4 3\n";
  });
}

// R1
TEST_F(Memory, Off) {
  expect_bounded("mesh.off", [](std::ofstream& file) {
    file << "OFF\n" << 2 * kPairs << ' ' << 2 * kPairs - 2 << " 0\n";
    each_vertex([&file](float x, float y) { file << x << ' ' << y << " 0\n"; });
    each_face([&file](auto a, auto b, auto c) { file << "3 " << a << ' ' << b << ' ' << c << '\n'; });
  });
}

void write_facet(std::ofstream& file, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  file << little(0.F, 0.F, 0.F);
  for (const auto v : {a, b, c}) {
    const std::uint32_t row = v / 2;
    file << little(static_cast<float>(row), static_cast<float>(v % 2), 0.F);
  }
  file << little(std::uint16_t{0});
}

void write_stl_header(std::ofstream& file, std::uint32_t facets) { file << std::string(80, ' ') << little(facets); }

// R1
TEST_F(Memory, StlBinary) {
  expect_bounded("binary.stl", [](std::ofstream& file) {
    write_stl_header(file, 2 * kPairs - 2);
    each_face([&file](auto a, auto b, auto c) { write_facet(file, a, b, c); });
  });
}

// R1
TEST_F(Memory, StlBinaryOfUnconnectedTriangles) {
  constexpr std::uint32_t kFacets = 1'500'000;
  expect_bounded("unconnected.stl", [](std::ofstream& file) {
    write_stl_header(file, kFacets);
    for (std::uint32_t i = 0; i < kFacets; ++i) write_facet(file, 3 * i, 3 * i + 1, 3 * i + 2);
  });
}

// R1
TEST_F(Memory, StlBinaryOfOnePosition) {
  constexpr std::uint32_t kFacets = 4'000'000;
  expect_bounded("one_position.stl", [](std::ofstream& file) {
    write_stl_header(file, kFacets);
    for (std::uint32_t i = 0; i < kFacets; ++i) write_facet(file, 7, 7, 7);
  });
}

// R1
TEST_F(Memory, StlText) {
  expect_bounded("text.stl", [](std::ofstream& file) {
    file << "solid\n";
    const auto vertex = [&file](std::uint32_t v) { file << "vertex " << v / 2 << ' ' << v % 2 << " 0\n"; };
    each_face([&](auto a, auto b, auto c) {
      file << "facet normal 0 0 1\nouter loop\n";
      vertex(a);
      vertex(b);
      vertex(c);
      file << "endloop\nendfacet\n";
    });
    file << "endsolid\n";
  });
}

// M1
TEST_F(Memory, ARefusedCountCostsNoMemory) {
  const std::string axes = "property float x\nproperty float y\nproperty float z\nend_header\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1099511627776\n" + axes},
      {"b.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n" + axes},
      {"c.off", "OFF\n2000000000 1 0\n"},
      {"d.stl", std::string(80, ' ') + little(0xfffffff0U)}};
  for (const auto& [name, content] : files) {
    const auto peak = measure(scratch.write(name, content));
    EXPECT_EQ(peak.decoded, 0U) << name;
    EXPECT_LT(peak.peak, 16'000'000U) << name;
  }
}

}  // namespace
}  // namespace meshhood::test
