// SPDX-License-Identifier: MIT
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/mesh.h"

#include "support/hostile.h"

// Randomly damaged files of every format give a valid mesh or an error of one line. Under the sanitizers, this is a
// small fuzzer with a fixed seed.

namespace meshhood::test {
namespace {

using Random = std::mt19937;

const std::string kPlyElements =
    "element vertex 3\nproperty float x\nproperty double y\nproperty short z\nproperty list uchar float extra\n"
    "element face 2\nproperty list uchar int vertex_indices\nelement tristrips 1\nproperty list int int "
    "vertex_indices\n"
    "end_header\n";

std::vector<std::pair<std::string, std::string>> seeds() {
  const auto vertex = [](float x) { return little(x, double{1}, std::int16_t{2}, std::uint8_t{1}, 0.5F); };
  return {
      {"text.ply", "ply\nformat ascii 1.0\ncomment c\n" + kPlyElements +
                       "0 0 0 0\n1 1e-3 -7 1 0.5\n+2 .5 3 2 1 1\n3 0 1 2\n1 0\n4 0 1 2 -1\n"},
      {"binary.ply", "ply\nformat binary_little_endian 1.0\n" + kPlyElements + vertex(0) + vertex(1) + vertex(2) +
                         little(std::uint8_t{3}, 0, 1, 2, std::uint8_t{0}, 4, 0, 1, 2, -1)},
      {"mesh.obj", "# c\nv 0 0 0\nv 1 0 0 0.5\nv 1 1 0 1 1 1\nvt 0 0\nf 1/1 2//1 \\\n 3/1/1\nf -1 -2 -3\nl 1 2\ng a\n"},
      {"mesh.off", "COFF # c\n3 2 0\n0 0 0 1 1 1 1\n1 0 0 0 0 0 1\n0 1 0 0 0 0 1\n3 0 1 2 255 0 0\n2 1 0\n"},
      {"text.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e2 -0\nendloop\n"
       "endfacet\nendsolid a\n"},
      {"binary.stl", binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, 0}}, "solid")},
      {"text.vtk",
       "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nFIELD a 1\nb 1 2 int\n1 2\nPOINTS 3 float\n"
       "0 0 0 1 0 0 0 1e2 -0\nMETADATA\nx\n\nPOLYGONS 2 7\n3 0 1 2\n2 0 1\nPOINT_DATA 3\n"},
      {"binary.vtk", "# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
                         big(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F) + "\nPOLYGONS 2 3\nOFFSETS vtktypeint64\n" +
                         big(std::int64_t{0}, std::int64_t{3}) + "\nCONNECTIVITY vtktypeint32\n" + big(0, 1, 2) + "\n"},
      {"lh.white",
       "\xff\xff\xfe"
       "a\n\n" +
           big(3, 1, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0, 1, 2) + big(20) + "cras = 1 0 0\n"},
  };
}

const std::vector<std::string> kWords = {"-1", "0",       "4294967296", "1e999", "nan",  "99999999999999999999",
                                         "\n", "\r",      " ",          "/",     "\\\n", "#",
                                         "v",  "element", "-"};

std::string damaged(std::string file, Random& random) {
  const auto damages = 1 + random() % 4;
  for (unsigned i = 0; i < damages && !file.empty(); ++i) {
    const auto at = random() % file.size();
    switch (random() % 5) {
      case 0: file[at] = static_cast<char>(random()); break;
      case 1: file[at] = static_cast<char>(file[at] ^ (1 << random() % 8)); break;
      case 2: file.resize(at); break;
      case 3: file.erase(at, random() % 8); break;
      default: file.insert(at, kWords[random() % kWords.size()]);
    }
  }
  return file;
}

TEST(Mutations, GiveAValidMeshOrOneError) {
  constexpr int kPerSeed = 20000;
  Random random(2);
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (const auto& [name, file] : seeds()) {
    ASSERT_FALSE(refusal(name, file).refused) << refusal(name, file).message;
    for (int i = 0; i < kPerSeed; ++i) {
      const auto bytes = damaged(file, random);
      try {
        const io::Mesh mesh = read(name, bytes);
        validate(mesh.view());
        ++accepted;
      } catch (const Error& error) {
        ASSERT_NE(error.code(), ErrorCode::InvalidMesh) << name << ": read, but no mesh: " << error.what();
        ASSERT_EQ(std::string_view(error.what()).find_first_of("\n\r"), std::string_view::npos);
        ++refused;
      }
    }
  }
  std::printf("%zu damaged files: %zu read, %zu refused\n", accepted + refused, accepted, refused);
  EXPECT_GT(accepted, 0U);
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace meshhood::test
