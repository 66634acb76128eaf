// SPDX-License-Identifier: MIT
#include "parts/chunked_mesh.h"

#include <cmath>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "shared/text.h"

namespace meshhood::parts {
namespace {

class MeshInMemory final : public ChunkedMesh {
 public:
  MeshInMemory(io::Mesh mesh, const std::string& name)
      : ChunkedMesh(name, mesh.view().positions.size(), std::holds_alternative<std::vector<double>>(mesh.positions)),
        mesh_(std::move(mesh)) {}

  [[nodiscard]] const std::vector<io::Warning>* warnings() const override { return &mesh_.warnings; }

 private:
  void load_positions(std::uint64_t first, std::span<Point> out) override {
    mesh_.view().positions.visit([&](const auto& xyz) {
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = point(xyz, first + i);
    });
  }

  bool load_face(std::uint64_t face, std::vector<std::uint64_t>& corners) override {
    if (face == faces_.size()) return false;
    faces_.for_each(face, face + 1, [&](std::size_t, std::span<const VertexId> ids) {
      check_degree(ids.size());
      corners.insert(corners.end(), ids.begin(), ids.end());
    });
    return true;
  }

  io::Mesh mesh_;
  FacesView faces_ = mesh_.view().faces;
};

}  // namespace

void ChunkedMesh::read_positions(std::uint64_t first, std::span<Point> out) {
  load_positions(first, out);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Point& p = out[i];
    if (is_valid_position(p)) continue;
    if (std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z)) io::refuse_wall(first + i, name_);
    refuse_position(first + i, p, name_ + ": ");
  }
}

void ChunkedMesh::rewind_faces() {
  check_unchanged();
  load_first_face();
  next_face_ = 0;
}

bool ChunkedMesh::read_faces(std::size_t corners, FaceChunk& chunk) {
  chunk.corners.clear();
  chunk.ends.clear();
  while (chunk.corners.size() < corners && chunk.size() < corners) {
    const std::size_t begin = chunk.corners.size();
    if (!load_face(next_face_, chunk.corners)) {
      check_unchanged();
      break;
    }
    check_face(std::span(chunk.corners).subspan(begin));
    chunk.ends.push_back(chunk.corners.size());
    ++next_face_;
  }
  return chunk.size() != 0;
}

void ChunkedMesh::check_face(std::span<const std::uint64_t> corners) const {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < vertices_) [[likely]] {
      continue;
    }
    // As it was stored: negative ones are huge when read as unsigned.
    const auto stored = static_cast<std::int64_t>(corners[i]);
    raise_no_such_vertex(ErrorCode::InvalidMesh,
                         fmt::format("{}: face {}: corner {} is vertex ", name_of_faces(), next_face_, i),
                         std::to_string(stored), vertices_);
  }
}

void ChunkedMesh::check_degree(std::uint64_t corners) const {
  constexpr std::uint64_t kMostCorners = std::uint64_t{1} << 20;
  if (corners <= kMostCorners) return;
  raise(ErrorCode::TooLarge, fmt::format("{}: face {} has {} corners, but the limit of a partition is {}",
                                         name_of_faces(), next_face_, corners, kMostCorners));
}

std::unique_ptr<ChunkedMesh> open_mesh(const std::filesystem::path& path, std::uint64_t max_bytes,
                                       const Progress& progress) {
  if (auto mesh = open_binary_ply(path)) return mesh;
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
  const std::string name = io::printable_name(path.string());
  if (!unknown && bytes > max_bytes) {
    raise(ErrorCode::TooLarge,
          fmt::format("{}: a file of {} bytes in this format is read into memory, and --memory allows {}; a binary "
                      "PLY file or .npy files are read in chunks",
                      name, bytes, max_bytes));
  }
  return chunked(io::read_mesh(path, {.max_bytes = max_bytes, .progress = progress}), name);
}

std::unique_ptr<ChunkedMesh> chunked(io::Mesh mesh, const std::string& name) {
  io::refuse_walls(mesh, name);
  return std::make_unique<MeshInMemory>(std::move(mesh), name);
}

}  // namespace meshhood::parts
