// SPDX-License-Identifier: MIT
// A mesh in chunks is the mesh that `io::read_mesh` reads, and has the same faults.
#include "parts/chunked_mesh.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/families.h"
#include "support/parts_folder.h"
#include "support/refusal.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using parts::ChunkedMesh;
using parts::FaceChunk;

struct Content {
  std::vector<double> positions;
  std::vector<std::vector<std::uint64_t>> faces;

  friend bool operator==(const Content&, const Content&) = default;
};

Content read_all(ChunkedMesh& mesh, std::size_t vertices, std::size_t corners) {
  Content content;
  std::vector<Point> positions;
  for (std::uint64_t first = 0; first < mesh.vertex_count(); first += positions.size()) {
    positions.resize(static_cast<std::size_t>(std::min<std::uint64_t>(vertices, mesh.vertex_count() - first)));
    mesh.read_positions(first, positions);
    for (const Point& p : positions) content.positions.insert(content.positions.end(), {p.x, p.y, p.z});
  }
  FaceChunk chunk;
  mesh.rewind_faces();
  while (mesh.read_faces(corners, chunk)) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      content.faces.emplace_back(chunk.face(i).begin(), chunk.face(i).end());
    }
  }
  return content;
}

Content content_of(const TestMesh& mesh) {
  Content content{.positions = mesh.positions, .faces = {}};
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    content.faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  return content;
}

void expect_content(ChunkedMesh& mesh, const Content& expected) {
  for (const std::size_t size : {1U, 5U, 1000000U}) EXPECT_TRUE(read_all(mesh, size, size) == expected) << size;
}

template <class T>
std::string bytes_of(const std::vector<T>& values, bool swapped = false) {
  std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  if (!swapped) return bytes;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(T)) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                 bytes.begin() + static_cast<std::ptrdiff_t>(i + sizeof(T)));
  }
  return bytes;
}

template <class T>
std::string npy(const std::vector<T>& values, std::size_t columns, bool swapped = false) {
  std::string type = io::npy_type<T>();
  if (swapped) type[0] = '>';
  return io::npy_header(type, "(" + std::to_string(values.size() / columns) + ", " + std::to_string(columns) + ")") +
         bytes_of(values, swapped);
}

class ChunkedMeshes : public testing::Test {
 protected:
  Scratch scratch;
};

TEST_F(ChunkedMeshes, OfBinaryPlyFilesAreThoseOfTheReader) {
  for (const Family& family : families()) {
    const TestMesh mesh = make_mesh(family, 1, 60);
    SCOPED_TRACE(mesh.name);
    const auto file = scratch.path() / "mesh.ply";
    io::write_ply(file, mesh.view());
    const auto opened = parts::open_binary_ply(file);
    ASSERT_NE(opened, nullptr);
    EXPECT_EQ(opened->vertex_count(), mesh.size());
    EXPECT_EQ(opened->is_double(), !mesh.single_precision);
    expect_content(*opened, content_of(mesh));
  }
}

TEST_F(ChunkedMeshes, OfPlyFilesWithOtherPropertiesAreThoseOfTheReader) {
  const std::string header =
      "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty uchar flag\nproperty short z\nproperty float x\n"
      "property uchar y\nelement face 2\nproperty uchar flag\nproperty list uchar short vertex_index\n"
      "property list uchar uchar other\nend_header\n";
  const std::string vertices = std::string("\7\0\2", 3) + bytes_of(std::vector<float>{1.5F}, true) + "\5" +
                               std::string("\7\xff\xff", 3) + bytes_of(std::vector<float>{-4}, true) + "\6";
  const std::string faces = std::string("\1\2\0\1\0\0\1\11", 8) + std::string("\1\3\0\0\0\1\0\1\0", 9);
  const auto file = scratch.write("odd.ply", header + vertices + faces);
  const auto opened = parts::open_binary_ply(file);
  ASSERT_NE(opened, nullptr);
  EXPECT_FALSE(opened->is_double());
  expect_content(*opened, {.positions = {1.5, 5, 2, -4, 6, -1}, .faces = {{1, 0}, {0, 1, 1}}});
  const io::Mesh read = io::read_mesh(file);
  EXPECT_THAT(read.corners, testing::ElementsAre(1, 0, 0, 1, 1));
}

TEST_F(ChunkedMeshes, OfArraysOfEveryTypeAreTheArrays) {
  const TestMesh mesh = bumpy_grid(9);
  const Content expected = content_of(mesh);
  std::size_t combinations = 0;
  const auto check = [&](const std::string& positions, const std::string& faces) {
    const auto opened = parts::open_arrays(scratch.write("V.npy", positions), scratch.write("F.npy", faces));
    expect_content(*opened, expected);
    ++combinations;
  };
  const std::vector<std::int32_t> small(mesh.corners.begin(), mesh.corners.end());
  const std::vector<std::int64_t> large(mesh.corners.begin(), mesh.corners.end());
  const std::vector<std::uint64_t> unsigned_large(mesh.corners.begin(), mesh.corners.end());
  for (const bool swapped : {false, true}) {
    const std::vector<std::string> positions{npy(mesh.single_positions, 3, swapped), npy(mesh.positions, 3, swapped)};
    const std::vector<std::string> faces{npy(small, 3, swapped), npy(mesh.corners, 3, swapped), npy(large, 3, swapped),
                                         npy(unsigned_large, 3, swapped)};
    for (const auto& V : positions) {
      for (const auto& F : faces) check(V, F);
    }
  }
  EXPECT_EQ(combinations, 16U);
}

TEST_F(ChunkedMeshes, OfOtherFilesAreReadIntoMemory) {
  const auto file = scratch.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(parts::open_binary_ply(file), nullptr);
  expect_content(*parts::open_mesh(file, 1000), {.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0}, .faces = {{0, 1, 2}}});
  expect_refused(ErrorCode::TooLarge, "a binary PLY file or .npy files are read in chunks",
                 [&] { return parts::open_mesh(file, 10); });
}

TEST_F(ChunkedMeshes, CountFacesWithoutCornersInEachChunk) {
  io::Mesh mesh;
  mesh.positions = std::vector<float>{0, 0, 0};
  mesh.offsets.assign(1001, 0);
  const auto opened = parts::chunked(std::move(mesh), "empty faces");
  parts::FaceChunk chunk;
  std::size_t faces = 0;
  opened->rewind_faces();
  while (opened->read_faces(10, chunk)) {
    ASSERT_LE(chunk.size(), 10U);
    faces += chunk.size();
  }
  EXPECT_EQ(faces, 1000U);
}

TEST_F(ChunkedMeshes, NameTheFaultOfAFile) {
  const std::vector<float> V{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::int32_t> F{0, 1, 2};
  const auto refused = [&](ErrorCode code, const std::string& cause, const std::string& positions,
                           const std::string& faces) {
    expect_refused(code, cause, [&] {
      const auto mesh = parts::open_arrays(scratch.write("V.npy", positions), scratch.write("F.npy", faces));
      static_cast<void>(read_all(*mesh, 10, 10));
    });
  };
  const auto head = [](const std::string& type, const std::string& shape) { return io::npy_header(type, shape); };
  refused(ErrorCode::InvalidMesh, "V.npy: vertex 1: y is inf",
          npy(std::vector<float>{0, 0, 0, 1, std::numeric_limits<float>::infinity(), 0}, 3), npy(F, 3));
  refused(ErrorCode::InvalidMesh, "V.npy: vertex 1 has no position (NaN), which an index file cannot say; write the ",
          npy(std::vector<float>{0, 0, 0, 1, std::numeric_limits<float>::quiet_NaN(), 0}, 3), npy(F, 3));
  refused(ErrorCode::InvalidMesh, "F.npy: face 0: corner 2 is vertex 3, but the mesh has 3 vertices", npy(V, 3),
          npy(std::vector<std::int32_t>{0, 1, 3}, 3));
  refused(ErrorCode::InvalidMesh, "face 0: corner 0 is vertex -1", npy(V, 3),
          npy(std::vector<std::int64_t>{-1, 1, 2}, 3));
  refused(ErrorCode::InvalidMesh, "an array of shape (1, 9), expected three coordinates a vertex", npy(V, 9),
          npy(F, 3));
  refused(ErrorCode::MalformedFile, "the file is truncated", npy(V, 3).substr(0, 150), npy(F, 3));
  refused(ErrorCode::MalformedFile, "the file is truncated", npy(V, 3), head("<i4", "(18446744073709551615, 3)"));
  refused(ErrorCode::MalformedFile, "the file is truncated", npy(V, 3), head("<i4", "(3, 18446744073709551615)"));
  // No byte of the file bounds the number of these rows.
  refused(ErrorCode::MalformedFile, "shape (1000000000000, 0), expected values", npy(V, 3),
          head("<i4", "(1000000000000, 0)"));
  refused(ErrorCode::TooLarge, "F.npy: face 0 has 2000000 corners, but the limit of a partition is 1048576", npy(V, 3),
          npy(std::vector<std::int32_t>(2'000'000), 2'000'000));
  refused(ErrorCode::UnsupportedFormat, "expected (#V, 3) float32 or float64 in C order", npy(F, 3), npy(F, 3));
  refused(ErrorCode::UnsupportedFormat, "expected (#F, k) integers", npy(V, 3), npy(V, 3));
  refused(ErrorCode::UnsupportedFormat, "an array of shape (3)", npy(V, 3), head("<i4", "(3,)") + bytes_of(F));
  refused(ErrorCode::MalformedFile, "is not a .npy file", "text", npy(F, 3));
  refused(ErrorCode::MalformedFile, "has no valid 'shape'", head("<f4", "(x, 3)"), npy(F, 3));
  refused(ErrorCode::MalformedFile, "has no valid 'shape'", head("<f4", "3"), npy(F, 3));
  std::string version = npy(V, 3);
  version[6] = '\7';
  refused(ErrorCode::UnsupportedFormat, "version 7 of .npy", version, npy(F, 3));
  std::string length = npy(V, 3);
  length[9] = '\x7f';
  refused(ErrorCode::MalformedFile, "a header of", length, npy(F, 3));

  const auto folder = scratch.path() / "folder.ply";
  create_directory(folder);
  const std::string directory = "folder.ply: is a directory, expected a file";
  expect_refused(ErrorCode::IoFailure, directory, [&] { return parts::open_mesh(folder, 1); });
  expect_refused(ErrorCode::IoFailure, directory, [&] { return parts::open_arrays(folder, scratch.path() / "F.npy"); });
}

/// By a rename, as programs do, so that the open file is the old one. Not on Windows.
constexpr bool kOpenFilesCanBeReplaced = std::filesystem::path::preferred_separator == '/';

/// Opens a mesh, reads its positions, changes its files, and reads its faces.
template <class Open, class Change>
Content content_with_change(Open&& open, Change&& change) {
  const auto mesh = open();
  std::vector<Point> positions(mesh->vertex_count());
  mesh->read_positions(0, positions);
  change();
  return read_all(*mesh, 7, 50);
}

TEST_F(ChunkedMeshes, AreThoseOfTheFileThatWasOpened) {
  const TestMesh mesh = make_grid(20, 30, false);
  const TestMesh other = make_grid(30, 20, false);
  const auto file = scratch.path() / "mesh.ply";
  const auto open = [&] { return parts::open_mesh(file, 1); };
  io::write_ply(file, mesh.view());
  if (kOpenFilesCanBeReplaced) {
    EXPECT_TRUE(content_with_change(open, [&] { io::write_ply(file, other.view()); }) == content_of(mesh));
  }

  io::write_ply(file, mesh.view());
  const auto bytes = std::filesystem::file_size(file);
  for (const auto size : {bytes - 1, bytes / 2, std::uintmax_t{0}, bytes + 1, 2 * bytes}) {
    io::write_ply(file, mesh.view());
    expect_refused(ErrorCode::IoFailure, "",
                   [&] { return content_with_change(open, [&] { std::filesystem::resize_file(file, size); }); });
  }
  io::write_ply(file, mesh.view());
  expect_refused(ErrorCode::IoFailure, "was written to while it was read", [&] {
    return content_with_change(open, [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the clock of a file system is coarse
      std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(400).put('x');
    });
  });
}

TEST_F(ChunkedMeshes, OfArraysAreThoseOfTheFilesThatWereOpened) {
  const std::vector<float> positions(30, 1);
  const std::vector<std::int32_t> faces(9, 2);
  const auto write = [&](float x) {
    std::vector<float> moved = positions;
    moved[0] = x;
    static_cast<void>(scratch.write("other.npy", npy(moved, 3)));
    std::filesystem::rename(scratch.path() / "other.npy", scratch.path() / "v.npy");
    return scratch.path() / "v.npy";
  };
  const auto v = write(1);
  const auto f = scratch.write("f.npy", npy(faces, 3));
  const auto open = [&] { return parts::open_arrays(v, f); };
  if (kOpenFilesCanBeReplaced) {
    EXPECT_EQ(content_with_change(open, [&] { write(7); }).positions[0], 1);
  }
  for (const auto& array : {v, f}) {
    expect_refused(ErrorCode::IoFailure, array.string(), [&] {
      return content_with_change(open,
                                 [&] { std::filesystem::resize_file(array, std::filesystem::file_size(array) + 4); });
    });
  }
}

TEST_F(ChunkedMeshes, NameTheFaultOfATruncatedPlyFileAtEveryByte) {
  const TestMesh mesh = bumpy_grid(4);
  const auto file = scratch.path() / "mesh.ply";
  io::write_ply(file, mesh.view());
  const std::string whole = read_file(file);
  const std::size_t body = whole.find("end_header\n") + 11;
  for (std::size_t size = body; size < whole.size(); ++size) {
    const auto cut = scratch.write("cut.ply", whole.substr(0, size));
    expect_refused(ErrorCode::MalformedFile, "cut.ply", [&] {
      const auto opened = parts::open_binary_ply(cut);
      static_cast<void>(read_all(*opened, 10, 10));
    });
  }
  std::printf("%zu truncated files\n", whole.size() - body);
}

}  // namespace
}  // namespace meshhood::test
