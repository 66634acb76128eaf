// SPDX-License-Identifier: MIT
// Any bytes as two `.npy` files, of positions and faces. The first two bytes of an input give the size of the first.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "judge.h"
#include "parts/chunked_mesh.h"
#include "refusal.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

using parts::ChunkedMesh;

/// A regular file in memory, for functions that take a path.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("fuzz", 0)) {
    if (file_ < 0) fail("no file in memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(file_); }

  void replace(std::span<const std::byte> bytes) const {
    if (::ftruncate(file_, 0) != 0) fail("cannot empty a file in memory");
    if (::pwrite(file_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
      fail("cannot write a file in memory");
    }
  }

  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

/// In pieces of `size` vertices.
std::vector<Point> read_positions(ChunkedMesh& mesh, std::size_t size) {
  std::vector<Point> all(static_cast<std::size_t>(mesh.vertex_count()));
  for (std::size_t first = 0; first < all.size(); first += size) {
    mesh.read_positions(first, std::span(all).subspan(first, std::min(size, all.size() - first)));
  }
  return all;
}

struct Faces {
  std::vector<std::uint64_t> corners = {};
  std::vector<std::size_t> degrees = {};

  friend bool operator==(const Faces&, const Faces&) = default;
};

/// In chunks of `size` corners.
Faces read_faces(ChunkedMesh& mesh, std::size_t size) {
  Faces all;
  parts::FaceChunk chunk;
  mesh.rewind_faces();
  while (mesh.read_faces(size, chunk)) {
    for (std::size_t i = 0; i < chunk.size(); ++i) all.degrees.push_back(chunk.face(i).size());
    all.corners.insert(all.corners.end(), chunk.corners.begin(), chunk.corners.end());
  }
  return all;
}

bool is_same(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

void read_arrays(std::span<const std::byte> positions, std::span<const std::byte> faces) {
  static const MemoryFile positions_file;
  static const MemoryFile faces_file;
  positions_file.replace(positions);
  faces_file.replace(faces);
  try {
    const auto mesh = parts::open_arrays(positions_file.path(), faces_file.path());
    if (!std::ranges::equal(read_positions(*mesh, 7), read_positions(*mesh, 1000), is_same)) {
      fail("positions depend on the pieces in which they are read");
    }
    const Faces read = read_faces(*mesh, 5);
    if (read != read_faces(*mesh, 1000)) fail("faces depend on the chunks in which they are read");
    for (const std::uint64_t corner : read.corners) {
      if (corner >= mesh->vertex_count()) fail("a corner that is no vertex was accepted");
    }
  } catch (const Error& error) {
    expect_clear(error,
                 {ErrorCode::MalformedFile, ErrorCode::UnsupportedFormat, ErrorCode::InvalidMesh, ErrorCode::TooLarge},
                 "/proc/self/fd/");
  }
}

}  // namespace

void run(std::span<const std::byte> input) {
  constexpr std::size_t kHead = 2;
  if (input.size() < kHead) return;
  const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(input[i]); };
  const auto body = input.subspan(kHead);
  const std::size_t first = std::min(body.size(), byte(0) | byte(1) << 8U);
  read_arrays(body.first(first), body.subspan(first));
}

}  // namespace meshhood::fuzz
